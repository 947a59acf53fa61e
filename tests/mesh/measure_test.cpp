#include "mesh/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace sward::mesh {
namespace {

Model withGrey(float grey) {
  Model model;
  Material material;
  material.baseColour = glm::vec4(glm::vec3(grey), 1.0f);
  material.optics.translucency = 0.0;
  model.materials = {material};
  return model;
}

/// Each corner a vertex of its own, as files have them where normals differ.
void addTriangle(Model& model, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), {a, b, c});
  model.normals.resize(model.positions.size(), {0, 0, 1});
  model.uvs.resize(model.positions.size());
  model.colours.resize(model.positions.size(), glm::vec4(1.0f));
  model.triangles.push_back({first, first + 1, first + 2});
  model.triangleMaterial.push_back(0);
}

void addQuad(Model& model, const glm::vec3& origin, const glm::vec3& u, const glm::vec3& v) {
  addTriangle(model, origin, origin + u, origin + u + v);
  addTriangle(model, origin, origin + u + v, origin + v);
}

void addBox(Model& model, const glm::vec3& low, const glm::vec3& size) {
  const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  addQuad(model, low, y, x);
  addQuad(model, low, x, z);
  addQuad(model, low, z, y);
  addQuad(model, low + size, -x, -y);
  addQuad(model, low + size, -z, -x);
  addQuad(model, low + size, -y, -z);
}

TEST(Measure, ALeafHasItsAreaAndABoxHalfItsSurface) {
  Model leaf = withGrey(0.1f);
  addQuad(leaf, {0, 0, 0}, {0.02f, 0, 0}, {0, 0, 0.4f});
  const Measure open = measure(leaf);
  EXPECT_NEAR(open.leafAreaM2, 0.008, 1e-8);
  EXPECT_EQ(open.solidShare, 0.0);
  EXPECT_NEAR(open.partWidthM, 0.008 / std::sqrt(0.02 * 0.02 + 0.4 * 0.4), 1e-7);
  EXPECT_NEAR(open.luminance, 0.1, 1e-6);

  Model box = withGrey(0.3f);
  addBox(box, {0, 0, 0}, {0.1f, 0.2f, 0.3f});
  const Measure solid = measure(box);
  EXPECT_NEAR(solid.leafAreaM2, 0.02 + 0.03 + 0.06, 1e-7);
  EXPECT_EQ(solid.solidShare, 1.0);
  EXPECT_NEAR(solid.luminance, 0.3, 1e-6);
}

TEST(Measure, PartsAreJudgedOneByOne) {
  Model model = withGrey(0.2f);
  addBox(model, {0, 0, 0}, {0.1f, 0.1f, 0.1f});
  addQuad(model, {1, 0, 0}, {0.1f, 0, 0}, {0, 0, 0.6f});
  const Measure both = measure(model);
  EXPECT_NEAR(both.leafAreaM2, 0.03 + 0.06, 1e-7);
  EXPECT_NEAR(both.solidShare, 0.5, 1e-6);
  // A box without its lid is open.
  Model tray = withGrey(0.2f);
  addBox(tray, {0, 0, 0}, {0.1f, 0.1f, 0.1f});
  tray.triangles.pop_back();
  tray.triangleMaterial.pop_back();
  EXPECT_EQ(measure(tray).solidShare, 0.0);
}

TEST(Measure, HolesOfAlphaDoNotCount) {
  Model model = withGrey(0.4f);
  addQuad(model, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  model.materials[0].alphaMode = AlphaMode::Blend;
  model.materials[0].baseColour.a = 0.25f;
  const Measure thin = measure(model);
  EXPECT_NEAR(thin.leafAreaM2, 0.25, 1e-6);
  EXPECT_NEAR(thin.luminance, 0.4, 1e-6);
}

TEST(Measure, NothingAndDegenerateTrianglesAreNothing) {
  EXPECT_EQ(measure(Model{}).leafAreaM2, 0.0);
  Model model = withGrey(0.4f);
  addTriangle(model, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  const Measure none = measure(model);
  EXPECT_EQ(none.leafAreaM2, 0.0);
  EXPECT_EQ(none.partWidthM, 0.0);
  EXPECT_EQ(none.luminance, 0.0);
}

TEST(TriangleSides, TellSolidsFromLeaves) {
  Model model = withGrey(0.1f);
  addQuad(model, {0, 0, 0}, {0.02f, 0, 0}, {0, 0, 0.4f});           // open: triangles 0, 1
  addBox(model, {1, 0, 0}, {0.1f, 0.2f, 0.3f});                    // wound outward: 2 to 13
  addQuad(model, {2, 0, 0}, {0.02f, 0, 0}, {0, 0, 0.4f});          // a leaf for each side: 14 to 17
  addQuad(model, {2, 0, 0}, {0, 0, 0.4f}, {0.02f, 0, 0});
  Model inverted = withGrey(0.1f);
  addBox(inverted, {0, 0, 0}, {0.1f, 0.2f, 0.3f});
  for (glm::uvec3& triangle : inverted.triangles) std::swap(triangle.y, triangle.z);

  const std::vector<Side> sides = triangleSides(model);
  ASSERT_EQ(sides.size(), 18u);
  const auto box = sides[2];
  for (std::size_t t = 0; t < 18; ++t) {
    EXPECT_EQ(sides[t], t < 2 ? Side::Open : t < 14 ? box : Side::Flat) << t;
  }
  // addBox's quads: low, y x x = -z, so its normals lead out.
  EXPECT_EQ(box, Side::Out);
  for (const Side side : triangleSides(inverted)) EXPECT_EQ(side, Side::Into);
}

TEST(TriangleSides, AThinLeafWithTwoSidesIsASolidAtAnyScale) {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    Model leaf = withGrey(0.1f);
    addBox(leaf, scale * glm::vec3(3, 1, 0), scale * glm::vec3(0.01f, 1e-4f, 0.1f));
    for (const Side side : triangleSides(leaf)) EXPECT_EQ(side, Side::Out) << scale;
  }
}

}  // namespace
}  // namespace sward::mesh
