// Sampling by passes over the triangles, and the medium that lights it, held against rays.
#include "trace/canopy_light.h"
#include "trace/triangle_field.h"

#include "trace/test_patches.h"

#include "mesh/procedural.h"
#include "scene/lights.h"

#include <cmath>
#include <numeric>

namespace sward::trace {
namespace {

using namespace testing;

/// Tufts of grass all over a small patch, some across its borders, and one plant of half-transparent leaves.
std::shared_ptr<scene::Patch> tufts(bool alpha) {
  auto patch = std::make_shared<scene::Patch>();
  patch->sideM = 0.5;
  mesh::GrassShape shape;
  shape.heightM = 0.25;
  shape.widthM = 0.008;
  std::vector<scene::PlantScatter> plants(1);
  for (std::uint32_t i = 0; i < 3; ++i) {
    mesh::Model model = mesh::growGrass(shape, i);
    if (alpha && i == 1) {
      model.materials[0].alphaMode = mesh::AlphaMode::Blend;
      model.materials[0].baseColour.a = 0.5f;
    }
    patch->models.push_back(std::make_shared<const mesh::Model>(std::move(model)));
    plants[0].models.push_back(i);
  }
  plants[0].count = 120;
  plants[0].tiltDeg = 5.0;
  return std::make_shared<scene::Patch>(scene::scatter(patch->sideM, patch->models, plants, 7));
}

std::unique_ptr<TriangleField> fieldOf(const std::shared_ptr<scene::Patch>& patch) {
  auto field = TriangleField::create(patch, {});
  EXPECT_TRUE(field.ok()) << (field.ok() ? "" : field.error().text());
  return std::move(field).value();
}

SamplingOptions coarseOptions() {
  SamplingOptions options = smallOptions();
  options.sliceResolution = 32;
  options.bladeWidth = 32;
  options.bladeHeight = 16;
  options.slices = 8;
  return options;
}

double sum(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

class Passes : public ::testing::TestWithParam<bool> {};

TEST_P(Passes, FindWhatRaysFind) {
  const auto patch = tufts(GetParam());
  const auto scene = sceneOf(patch);
  const auto passed = passHits(*fieldOf(patch), coarseOptions(), {}).value();
  ASSERT_EQ(passed.size(), kAllLayerSets.size());
  for (const LayerSet set : kAllLayerSets) {
    const LayerHits rays = sampleHits(*scene, set, coarseOptions(), {}).value();
    const LayerHits& passes = passed[static_cast<std::size_t>(set)];
    ASSERT_GT(rays.hits.size(), 500u) << layerSetName(set);
    ASSERT_EQ(passes.columnStart, rays.columnStart) << layerSetName(set);
    ASSERT_EQ(passes.layer, rays.layer);
    ASSERT_EQ(passes.hitStart, rays.hitStart);
    for (std::size_t h = 0; h < rays.hits.size(); ++h) {
      ASSERT_EQ(passes.hits[h].instance, rays.hits[h].instance);
      ASSERT_EQ(passes.hits[h].triangle, rays.hits[h].triangle);
      ASSERT_LT(glm::distance(passes.hits[h].position, rays.hits[h].position), 1e-4f);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OpaqueAndBlended, Passes, ::testing::Bool());

TEST(Passes, GiveTheSameBytesOnAnyNumberOfThreads) {
  const auto patch = tufts(true);
  const auto field = fieldOf(patch);
  const auto lights = scene::fibonacciHemisphere(6);
  std::vector<Hit> first;
  std::vector<std::vector<float>> firstLight;
  for (const int threads : {1, 2, 4}) {
    const JobContext job{{}, {}, threads};
    const auto hits = passHits(*field, coarseOptions(), job).value();
    const auto light = CanopyLight(*field, 16, 8, lights, job).arriving(hits[0], job).share;
    if (first.empty()) {
      first = hits[0].hits;
      firstLight = light;
    }
    ASSERT_EQ(hits[0].hits.size(), first.size());
    for (std::size_t h = 0; h < first.size(); ++h) {
      ASSERT_EQ(hits[0].hits[h].position, first[h].position);
      ASSERT_EQ(hits[0].hits[h].triangle, first[h].triangle);
    }
    ASSERT_EQ(light, firstLight);
  }
}

TEST(Passes, ABarePatchIsNeverHit) {
  auto patch = std::make_shared<scene::Patch>();
  patch->sideM = 1.0;
  patch->heightM = 0.1;
  const auto field = fieldOf(patch);
  const auto hits = passHits(*field, coarseOptions(), {}).value();
  EXPECT_TRUE(hits[0].hits.empty());
  EXPECT_EQ(hits[0].columnStart.size(), static_cast<std::size_t>(hits[0].shape.columns()) + 1);
  EXPECT_EQ(hits[static_cast<std::size_t>(LayerSet::Ground)].texels(), 32u * 32u);
  const auto lights = scene::fibonacciHemisphere(4);
  const CanopyLight light(*field, 8, 4, lights, {});
  for (std::size_t d = 0; d < lights.size(); ++d)
    EXPECT_FLOAT_EQ(light.at(d, {0.3f, 0.4f, 0.0f}, LayerSet::Ground), 1.0f);
}

TEST(Passes, APlantThatIsNotFiniteIsAnError) {
  auto patch = patchOf(quad({0.1f, 0.1f, 0.1f}, {0.2f, 0.0f, 0.0f}, {0.0f, NAN, 0.0f}), 1.0, 0.5);
  const auto field = TriangleField::create(patch, {});
  ASSERT_FALSE(field.ok());
  EXPECT_EQ(field.error().kind, ErrorKind::BadInput);
}

TEST(CanopyLight, ALevelSheetAsLargeAsThePatchLetsOneOverEThrough) {
  // Its leaf area over ground area is 1, and seen along any direction so is the area across it: exp(-1) everywhere.
  mesh::Model sheet;
  constexpr int kCells = 16;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      addQuad(sheet, {(x + 0.01f) / kCells, (y + 0.01f) / kCells, 0.3f}, {0.9999f / kCells, 0.0f, 0.0f},
              {0.0f, 0.9999f / kCells, 0.0f});
    }
  }
  const auto field = fieldOf(patchOf(std::move(sheet), 1.0, 0.4));
  const auto lights = scene::fibonacciHemisphere(8);
  const CanopyLight light(*field, kCells, 4, lights, {});
  for (std::size_t d = 0; d < lights.size(); ++d) {
    EXPECT_NEAR(light.at(d, {0.37f, 0.61f, 0.0f}, LayerSet::Ground), std::exp(-1.0), 2e-3) << "direction " << d;
    EXPECT_FLOAT_EQ(light.at(d, {0.37f, 0.61f, 0.4f}, LayerSet::Slices), 1.0f);
  }
}

TEST(CanopyLight, AgreesWithRaysOnTheWhole) {
  const auto patch = tufts(false);
  const auto scene = sceneOf(patch);
  const auto field = fieldOf(patch);
  const SamplingOptions options = coarseOptions();
  const auto hits = passHits(*field, options, {}).value();
  const auto lights = scene::fibonacciHemisphere(8);
  const CanopyLight light(*field, options.sliceResolution / 2, options.slices, lights, {});
  for (const LayerHits& set : hits) {
    const auto arriving = light.arriving(set, {});
    ArrivingLight everything = arriving;
    for (auto& share : everything.share) std::fill(share.begin(), share.end(), 1.0f);
    double rays = 0.0, medium = 0.0, bare = 0.0;
    for (std::size_t d = 0; d < lights.size(); ++d) {
      const LayerLuminance traced = sampleLuminance(*scene, set, lights[d], {}).value();
      const LayerLuminance spread = luminanceOf(set, arriving, d);
      const LayerLuminance free = luminanceOf(set, everything, d);
      rays += sum(traced.reflected) + sum(traced.transmitted);
      medium += sum(spread.reflected) + sum(spread.transmitted);
      bare += sum(free.reflected) + sum(free.transmitted);
    }
    EXPECT_LT(rays, 0.75 * bare) << "there is shade to speak of";
    // In the dark under the grass a share of next to nothing does not show: there by the light without grass.
    EXPECT_NEAR(medium, rays, 0.1 * rays + 0.02 * bare) << layerSetName(set.set);
    SamplingOptions many = options;
    many.visibilityDirections = 64;
    const LayerVisibility traced = sampleVisibility(*scene, set, many, {}).value();
    const LayerVisibility spread = visibilityOf(set, arriving, lights);
    const double tracedSky = sum(traced.skyReflected) + sum(traced.skyTransmitted);
    EXPECT_NEAR(sum(spread.skyReflected) + sum(spread.skyTransmitted), tracedSky,
                0.1 * tracedSky + 0.02 * static_cast<double>(set.texels()))
        << layerSetName(set.set);
  }
}

}  // namespace
}  // namespace sward::trace
