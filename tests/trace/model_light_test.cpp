#include "trace/model_light.h"

#include "mesh/tree.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <stop_token>

#include <gtest/gtest.h>

namespace sward::trace {
namespace {

/// A level square of side 2 at a height, about the axis, normals up.
void addSquare(mesh::Model& model, float z, float half = 1.0f) {
  if (model.materials.empty()) model.materials.emplace_back();
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    model.positions.emplace_back(half * static_cast<float>(x), half * static_cast<float>(y), z);
    model.normals.emplace_back(0, 0, 1);
    model.uvs.emplace_back(0.0f);
    model.colours.emplace_back(1.0f);
  }
  model.triangles.emplace_back(first, first + 1, first + 2);
  model.triangles.emplace_back(first, first + 2, first + 3);
  model.triangleMaterial.insert(model.triangleMaterial.end(), 2, 0u);
}

ModelScene sceneOf(const mesh::Model& model) {
  auto made = ModelScene::create(model);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

TEST(ModelLight, AShadeHidesTheSunWhereItStandsBefore) {
  mesh::Model model;
  addSquare(model, 0.0f, 0.5f);
  addSquare(model, 1.0f, 1.0f);
  const ModelScene scene = sceneOf(model);
  const auto noon = sunOnVertices(scene, {0, 0, 1}, {});
  ASSERT_TRUE(noon.ok());
  for (std::size_t v = 0; v < 4; ++v) EXPECT_EQ((*noon)[v], 0.0f);
  for (std::size_t v = 4; v < 8; ++v) EXPECT_EQ((*noon)[v], 1.0f) << "a surface does not shade itself";
  // From x = 0.5 the shade's edge at x = 1 is 0.5 away and 1 up.
  const auto at = [&](double x, double z) { return sunOnVertices(scene, glm::normalize(glm::dvec3(x, 0, z)), {}); };
  EXPECT_EQ((*at(0.6, 1.0))[1], 1.0f);
  EXPECT_EQ((*at(0.4, 1.0))[1], 0.0f);
  EXPECT_EQ((*at(1.0, 0.0))[1], 0.0f) << "at the horizon";
  EXPECT_EQ((*at(1.0, -0.5))[4], 0.0f) << "under it";
}

TEST(ModelLight, ALeafInTheOpenSeesTheSkyOfItsSides) {
  for (const double tilt : {0.0, 40.0, 90.0, 140.0}) {
    mesh::Model model;
    addSquare(model, 0.0f, 1e-3f);
    const double angle = glm::radians(tilt);
    for (glm::vec3& n : model.normals) n = glm::vec3(glm::dvec3(std::sin(angle), 0.0, std::cos(angle)));
    const ModelScene scene = sceneOf(model);
    const auto sky = skyOnVertices(scene, 1024, {});
    ASSERT_TRUE(sky.ok());
    // Closed form: half of 1 + cos and 1 - cos; a lattice of 1024 is good to about its spacing's square.
    EXPECT_NEAR(sky->front[0], 0.5 * (1.0 + std::cos(angle)), 0.01) << tilt;
    EXPECT_NEAR(sky->back[0], 0.5 * (1.0 - std::cos(angle)), 0.01) << tilt;
  }
}

TEST(ModelLight, AWideRoofLeavesTheSkyBesideIt) {
  // Under the middle of a disc seen under the half angle a the share sin^2 a is hidden; of a square roughly so.
  mesh::Model model;
  addSquare(model, 0.0f, 1e-3f);
  addSquare(model, 1.0f, 1.0f);
  const ModelScene scene = sceneOf(model);
  const auto sky = skyOnVertices(scene, 1024, {});
  ASSERT_TRUE(sky.ok());
  // Form factor of a square of half side 1 at height 1 (sum of four corners' view factors).
  const double corner = 1.0 / std::sqrt(2.0);
  const double hidden = 4.0 / (2.0 * M_PI) * 2.0 * corner * std::atan(corner);
  EXPECT_NEAR(sky->front[0], 1.0 - hidden, 0.015);
  EXPECT_NEAR(sky->front[4], 1.0, 0.01);
}

TEST(ModelLight, CrownsAreDarkerInside) {
  const mesh::Model tree = mesh::growTree(mesh::treePresets()[0].shape, 2);
  const ModelScene scene = sceneOf(tree);
  const auto sky = skyOnVertices(scene, 16, {});
  const auto sun = sunOnVertices(scene, glm::normalize(glm::dvec3(0.3, 0.2, 1.0)), {});
  ASSERT_TRUE(sky.ok() && sun.ok());
  double top = 0.0, low = 0.0;
  int tops = 0, lows = 0;
  const mesh::Bounds box = mesh::bounds(tree);
  for (std::size_t v = 0; v < tree.positions.size(); ++v) {
    const float h = tree.positions[v].z / box.high.z;
    const double open = static_cast<double>(sky->front[v] + sky->back[v]);
    EXPECT_GE(open, 0.0);
    EXPECT_LE(open, 1.6);
    if (h > 0.95f) top += open, ++tops;
    if (h > 0.45f && h < 0.55f) low += open, ++lows;
  }
  EXPECT_GT(top / tops, 1.2 * low / lows);
}

TEST(ModelLight, ThreadsGiveTheSameBytes) {
  const mesh::Model tree = mesh::growTree(mesh::treePresets()[0].shape, 2);
  const ModelScene scene = sceneOf(tree);
  JobContext one;
  one.threads = 1;
  EXPECT_EQ(*sunOnVertices(scene, glm::normalize(glm::dvec3(1, 1, 1)), one),
            *sunOnVertices(scene, glm::normalize(glm::dvec3(1, 1, 1)), {}));
  EXPECT_EQ(skyOnVertices(scene, 4, one)->front, skyOnVertices(scene, 4, {})->front);
}

TEST(ModelLight, EmptyModelsBadVerticesAndCancelling) {
  const mesh::Model nothing;
  const ModelScene empty = sceneOf(nothing);
  EXPECT_TRUE(sunOnVertices(empty, {0, 0, 1}, {})->empty());
  EXPECT_FALSE(empty.occluded({0, 0, 0}, {0, 0, 1}, 0.0f, 0.0f));
  mesh::Model bad;
  addSquare(bad, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(ModelScene::create(bad).ok());
  mesh::Model fine;
  addSquare(fine, 1.0f);
  const ModelScene scene = sceneOf(fine);
  JobContext job;
  std::stop_source stop;
  stop.request_stop();
  job.stop = stop.get_token();
  EXPECT_FALSE(sunOnVertices(scene, {0, 0, 1}, job).ok());
  EXPECT_FALSE(skyOnVertices(scene, 4, job).ok());
}

}  // namespace
}  // namespace sward::trace
