#include "wither/withered_model.h"

#include "mesh/procedural.h"
#include "wither/test_blades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace sward::wither {
namespace {

/// A stand-in for leaf colour: toward straw as chlorophyll goes.
void toStraw(glm::vec3& diffuse, glm::vec3& transmitted, const Season::Shares& shares) {
  const auto left = static_cast<float>(shares.chlorophyll);
  diffuse = glm::mix(glm::vec3(0.5f, 0.4f, 0.2f), diffuse, left);
  transmitted = glm::mix(glm::vec3(0.2f, 0.15f, 0.05f), transmitted, left);
}

struct Sward {
  mesh::Model plant = mesh::growGrass({}, 4);
  Season season = Season::create({}, {}).value();
  Strands strands = strandsOf(plant, AgeingOptions{}, BodyOptions{}, 8).value();
  mesh::Model at(double weathering, std::span<const MingleSample> samples = {}) const {
    return withered(plant, strands, season, samples, weathering, toStraw).value();
  }
};

TEST(WitheredModel, IsTheMeshItselfAtRest) {
  const Sward sward;
  const mesh::Model model = sward.at(0.0);
  EXPECT_EQ(model.positions, sward.plant.positions);
  EXPECT_EQ(model.normals, sward.plant.normals);
  EXPECT_EQ(model.colours, sward.plant.colours);
}

TEST(WitheredModel, SinksTurnsAndYellows) {
  const Sward sward;
  double lastHeight = 1e9, lastGreen = 1e9;
  for (const double degree : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const mesh::Model model = sward.at(degree);
    double height = 0.0, green = 0.0;
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
      ASSERT_TRUE(std::isfinite(model.positions[i].x) && std::isfinite(model.colours[i].r));
      EXPECT_GE(model.positions[i].z, 0.0f);
      EXPECT_NEAR(glm::length(model.normals[i]), 1.0, 1e-5);
      height += static_cast<double>(model.positions[i].z);
      green += static_cast<double>(model.colours[i].g) / static_cast<double>(model.colours[i].r);
    }
    EXPECT_LT(height, lastHeight) << degree;
    EXPECT_LT(green, lastGreen) << degree;
    lastHeight = height;
    lastGreen = green;
  }
}

TEST(WitheredModel, SamplesAgeByTheirOwnCurves) {
  Sward sward;
  const std::vector<MingleSample> samples{{"fresh", 1.0, 1.0, base::Curve::constant(0.0)},
                                          {"old", 1.0, 1.0, base::Curve::constant(1.0)}};
  for (Strand& strand : sward.strands.strands) strand.sample = 0;
  EXPECT_EQ(sward.at(1.0, samples).positions, sward.plant.positions);
  for (Strand& strand : sward.strands.strands) strand.sample = 1;
  EXPECT_EQ(sward.at(0.5, samples).positions, sward.at(1.0).positions);
}

/// A textured card of a mean colour: the texture times the aged vertex colour has the aged mean.
TEST(WitheredModel, TexturesAgeAsTheirMean) {
  Sward sward;
  sward.plant = flatBlade(4, 0.3, 0.02);
  image::Image texture(2, 1, 4, 1.0f);
  const float green[] = {0.1f, 0.3f, 0.0f, 1.0f}, hidden[] = {0.9f, 0.9f, 0.9f, 0.0f};
  std::copy(green, green + 4, texture.pixels.begin());
  std::copy(hidden, hidden + 4, texture.pixels.begin() + 4);
  sward.plant.textures.push_back(texture);
  sward.plant.materials[0].texture = 0;
  for (glm::vec4& c : sward.plant.colours) c = glm::vec4(1.0f);
  sward.strands = strandsOf(sward.plant, AgeingOptions{}, BodyOptions{}, 8).value();
  const mesh::Model model = sward.at(1.0);
  for (std::size_t i = 0; i < model.colours.size(); ++i) {
    const Attachment& at = sward.strands.attachments[i];
    glm::vec3 expected(0.1f, 0.3f, 0.0f), through(0.0f);
    toStraw(expected, through, sward.season.shares(1.0, sward.strands.strands[0].delay, static_cast<double>(at.s)));
    EXPECT_NEAR(model.colours[i].r * 0.1f, expected.r, 1e-5f);
    EXPECT_NEAR(model.colours[i].g * 0.3f, expected.g, 1e-5f);
    EXPECT_EQ(model.colours[i].b, 1.0f);  // black stays black
    EXPECT_EQ(model.colours[i].a, 1.0f);
  }
}

TEST(WitheredModel, PatchKeepsItsPlantsAtRest) {
  std::vector<std::shared_ptr<const mesh::Model>> models{std::make_shared<mesh::Model>(mesh::growGrass({}, 1)),
                                                         std::make_shared<mesh::Model>(mesh::growClover({}, 2))};
  scene::PlantScatter plants;
  plants.count = 30;
  plants.models = {0, 1};
  const scene::Patch patch = scene::scatter(1.0, models, {plants}, 5);
  const PatchStrands strands = strandsOf(patch, {}, 3).value();
  const Season season = Season::create({}, {}).value();
  const scene::Patch rest = withered(patch, strands, season, {}, 0.0, toStraw).value();
  ASSERT_EQ(rest.models.size(), 2u);
  std::size_t triangles = 0;
  for (const scene::Instance& instance : patch.instances) triangles += patch.models[instance.model]->triangles.size();
  EXPECT_EQ(rest.models[0]->triangles.size() + rest.models[1]->triangles.size(), triangles);
  EXPECT_NEAR(rest.heightM, patch.heightM, 1e-5);
  const scene::Instance& first = patch.instances[0];
  const mesh::Model& model = *patch.models[first.model];
  EXPECT_EQ(rest.models[first.model]->positions[5], first.worldFromModel * glm::vec4(model.positions[5], 1.0f));
  const scene::Patch dry = withered(patch, strands, season, {}, 1.0, toStraw).value();
  EXPECT_LT(dry.heightM, 0.9 * rest.heightM);
}

TEST(WitheredModel, RefusesOtherStrands) {
  const Sward sward;
  EXPECT_FALSE(withered(flatBlade(3, 0.2, 0.01), sward.strands, sward.season, {}, 0.5, {}).ok());
}

}  // namespace
}  // namespace sward::wither
