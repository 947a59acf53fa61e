#include "trace/layers.h"
#include "trace/scene_builder.h"

#include "trace/test_patches.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sward::trace {
namespace {

using testing::hitsOf;
using testing::lightOn;
using testing::patchOf;
using testing::quad;
using testing::sceneOf;
using testing::smallOptions;

/// A wall over all y, height h, at x = place.
mesh::Model wallAt(float place, float h) {
  return quad({place, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, h});
}

/// Lit fraction of each column of ground texels, mean over y.
std::vector<double> litByColumn(const PatchScene& scene, const glm::dvec3& light, int resolution) {
  SamplingOptions options = smallOptions();
  options.sliceResolution = resolution;
  const LayerHits hits = hitsOf(scene, LayerSet::Ground, options);
  const LayerLuminance luminance = lightOn(scene, hits, light);
  std::vector<double> lit(static_cast<std::size_t>(resolution), 0.0);
  const double cosine = glm::normalize(light).z;
  for (std::size_t t = 0; t < hits.texels(); ++t) {
    lit[t % lit.size()] += static_cast<double>(luminance.reflected[t]) / (cosine * resolution);
  }
  return lit;
}

TEST(Periodicity, AWallsShadowGoesOnOverTheBorder) {
  // Light from +x: the shadow of a wall of height 0.1 at x = 0.125 is 0.1 / tan(e) = 0.5 long, over [-0.375, 0.125],
  // which is [0, 0.125] and [0.625, 1].
  const auto scene = sceneOf(patchOf(wallAt(0.125f, 0.1f), 1.0, 0.1));
  const std::vector<double> lit = litByColumn(*scene, {0.5, 0.0, 0.1}, 32);
  for (int x = 0; x < 32; ++x) {
    const bool shadow = x < 4 || x >= 20;
    EXPECT_NEAR(lit[static_cast<std::size_t>(x)], shadow ? 0.0 : 1.0, 1e-3) << x;
  }
}

TEST(Periodicity, LowSunsReachThroughManyPatches) {
  // A quarter-wide gap-free wall casts 20.5 patches of shadow: nothing is lit. A short wall of width 1/4 in y under
  // light straight along x darkens exactly its own rows.
  const auto dark = sceneOf(patchOf(wallAt(0.5f, 0.1f), 1.0, 0.1));
  for (const double lit : litByColumn(*dark, {20.5, 0.0, 0.1}, 16)) EXPECT_EQ(lit, 0.0);
  const auto strip = sceneOf(patchOf(quad({0.5f, 0.25f, 0.0f}, {0.0f, 0.25f, 0.0f}, {0.0f, 0.0f, 0.1f}), 1.0, 0.1));
  for (const double lit : litByColumn(*strip, {20.5, 0.0, 0.1}, 16)) EXPECT_NEAR(lit, 0.75, 1e-6);
}

TEST(Periodicity, ADiagonalSunMeetsWallsAroundTheCorner) {
  // The wall x = 0.9 seen from light (-1, -1): its shadow of length 0.3 in x lies at [0.9, 1.2]; the light's y
  // component moves along the wall, which has no end.
  const auto scene = sceneOf(patchOf(wallAt(0.90625f, 0.3f), 1.0, 0.3));
  const std::vector<double> lit = litByColumn(*scene, {-1.0, -1.0, 1.0}, 32);
  for (int x = 0; x < 32; ++x) {
    const double low = x / 32.0, high = (x + 1) / 32.0;
    const double value = lit[static_cast<std::size_t>(x)];
    if (high <= 0.2 || low >= 0.90625) {
      EXPECT_NEAR(value, 0.0, 1e-3) << x;
    } else if (low >= 0.21) {
      EXPECT_NEAR(value, 1.0, 1e-3) << x;
    }
  }
}

TEST(Periodicity, ShiftingAllInstancesShiftsTheResult) {
  // Plants at texel steps: every offset moves the lit pattern by whole texels, over the border and out of the square.
  const int n = 32;
  const mesh::Model plant = quad({-0.25f, -0.03125f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0625f, 0.25f});
  const std::vector<glm::vec3> feet{{0.25f, 0.5f, 0.0f}, {0.75f, 0.125f, 0.0f}};
  const glm::dvec3 light(0.6, 0.35, 0.4);
  SamplingOptions options = smallOptions();
  options.sliceResolution = n;
  options.sliceSubSamples = 64;
  const auto pattern = [&](int dx, int dy) {
    std::vector<glm::vec3> moved;
    for (const glm::vec3& foot : feet) {
      const float x = foot.x + static_cast<float>(dx) / n, y = foot.y + static_cast<float>(dy) / n;
      moved.emplace_back(x - std::floor(x), y - std::floor(y), 0.0f);
    }
    const auto scene = sceneOf(patchOf(plant, 1.0, 0.25, moved));
    return lightOn(*scene, hitsOf(*scene, LayerSet::Ground, options), light).reflected;
  };
  const std::vector<float> still = pattern(0, 0);
  double dark = 0.0;
  for (const float value : still) dark += value < 0.1f ? 1.0 : 0.0;
  ASSERT_GT(dark, 50.0);
  for (const glm::ivec2 offset : {glm::ivec2(1, 0), glm::ivec2(13, 7), glm::ivec2(31, 31), glm::ivec2(8, 16)}) {
    const std::vector<float> moved = pattern(offset.x, offset.y);
    double worst = 0.0, sum = 0.0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const auto from = static_cast<std::size_t>(y * n + x);
        const auto to = static_cast<std::size_t>((y + offset.y) % n * n + (x + offset.x) % n);
        const double difference = static_cast<double>(moved[to]) - static_cast<double>(still[from]);
        worst = std::max(worst, std::abs(difference));
        sum += difference;
      }
    }
    // Jitter differs from column to column: only texels on a shadow's edge may move, each by its strata on the edge.
    EXPECT_LT(worst, 0.35) << offset.x << ' ' << offset.y;
    EXPECT_LT(std::abs(sum) / (n * n), 2e-3);
  }
}

TEST(Periodicity, AVerticalSunIsExactlyTheSlicesView) {
  const auto scene = sceneOf(patchOf(quad({0.75f, 0.75f, 0.1f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.0f}), 1.0, 0.1));
  SamplingOptions options = smallOptions();
  const LayerHits hits = hitsOf(*scene, LayerSet::Ground, options);
  const LayerLuminance luminance = lightOn(*scene, hits, {0.0, 0.0, 1.0});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool under = (x < 4 || x >= 12) && (y < 4 || y >= 12);
      EXPECT_EQ(luminance.reflected[static_cast<std::size_t>(y * 16 + x)], under ? 0.0f : 1.0f) << x << ' ' << y;
    }
  }
}

TEST(Periodicity, HorizontalLightEnds) {
  // One small plate: most rays meet nothing, ever.
  const auto scene = sceneOf(patchOf(quad({0.5f, 0.5f, 0.2f}, {0.05f, 0.0f, 0.0f}, {0.0f, 0.05f, 0.1f}), 1.0, 0.5));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  ASSERT_GT(hits.texels(), 0u);
  for (const glm::dvec3 light : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.7, 0.7, 1e-7),
                                 glm::dvec3(-0.3, 0.2, 1e-9), glm::dvec3(1, 1e-30, 0)}) {
    const LayerLuminance luminance = lightOn(*scene, hits, light);
    for (const float value : luminance.reflected) EXPECT_TRUE(value >= 0.0f && value <= 1.0f);
  }
}

/// The same scene at any scale gives the same picture: nothing absolute hides in the offsets.
class Scale : public ::testing::TestWithParam<double> {};

TEST_P(Scale, GivesTheSameShadowsAndSlabs) {
  const auto scaled = [&](double side) {
    const auto s = static_cast<float>(side);
    return sceneOf(patchOf(quad({0.125f * s, 0.0f, 0.0f}, {0.0f, s, 0.0f}, {0.0f, 0.0f, 0.1f * s}), side, 0.1 * side));
  };
  const auto scene = scaled(GetParam());
  const std::vector<double> lit = litByColumn(*scene, {0.5, 0.0, 0.1}, 32);
  for (int x = 0; x < 32; ++x) {
    EXPECT_NEAR(lit[static_cast<std::size_t>(x)], x < 4 || x >= 20 ? 0.0 : 1.0, 1e-3) << x;
  }
  const LayerHits hits = hitsOf(*scene, LayerSet::BladesPosX, smallOptions());
  ASSERT_EQ(hits.texels(), 16u * 8u);
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, 0.2, 1.0));
  const LayerLuminance luminance = lightOn(*scene, hits, light);
  for (const float value : luminance.reflected) EXPECT_NEAR(value, light.x, 1e-4);
}
INSTANTIATE_TEST_SUITE_P(FromAMillimetreToAKilometre, Scale, ::testing::Values(1e-3, 1.0, 1e3));

TEST(Instancing, ManyTrianglesGiveTheSameHitsAsFew) {
  // A plant of a wall in 20 strips; enough plants to pass the limit of the flat tree, all but one out of the way
  // inside the ground, where no slab reaches.
  const int strips = 2000;
  mesh::Model wall;
  for (int i = 0; i < strips; ++i) {
    const float y = static_cast<float>(i) / strips;
    testing::addQuad(wall, {0.0f, y, 0.0f}, {0.0f, 1.0f / strips, 0.0f}, {0.0f, 0.0f, 0.1f});
  }
  std::vector<glm::vec3> feet{{0.125f, 0.0f, 0.0f}};
  const auto flat = sceneOf(patchOf(wall, 1.0, 0.1, feet));
  while (feet.size() * wall.triangles.size() <= kMaxFlatTriangles) feet.emplace_back(0.5f, 0.0f, -10.0f);
  const auto instanced = sceneOf(patchOf(wall, 1.0, 0.1, feet));
  EXPECT_EQ(flat->impl().modelScenes.size(), 0u);
  ASSERT_EQ(instanced->impl().modelScenes.size(), 1u);
  EXPECT_EQ(litByColumn(*flat, {0.5, 0.0, 0.1}, 32), litByColumn(*instanced, {0.5, 0.0, 0.1}, 32));
  const LayerHits a = hitsOf(*flat, LayerSet::BladesPosX, smallOptions());
  const LayerHits b = hitsOf(*instanced, LayerSet::BladesPosX, smallOptions());
  ASSERT_EQ(a.hits.size(), b.hits.size());
  for (std::size_t i = 0; i < a.hits.size(); ++i) {
    EXPECT_EQ(a.hits[i].instance, 0u);
    EXPECT_EQ(b.hits[i].instance, 0u);
    EXPECT_EQ(a.hits[i].triangle, b.hits[i].triangle);
    EXPECT_EQ(a.hits[i].normal, b.hits[i].normal);
  }
}

TEST(PatchSceneCreate, RefusesWhatItCannotTrace) {
  mesh::Model broken = wallAt(0.5f, 0.1f);
  broken.positions[1].x = NAN;
  const auto nan = PatchScene::create(patchOf(broken, 1.0, 0.1));
  ASSERT_FALSE(nan.ok());
  EXPECT_EQ(nan.error().kind, ErrorKind::BadInput);
  EXPECT_FALSE(PatchScene::create(patchOf(wallAt(100.0f, 0.1f), 1.0, 0.1)).ok());
  EXPECT_FALSE(PatchScene::create(patchOf(wallAt(0.5f, 0.1f), 0.0, 0.1)).ok());
  EXPECT_FALSE(PatchScene::create(patchOf(wallAt(0.5f, 0.1f), INFINITY, 0.1)).ok());
  EXPECT_TRUE(PatchScene::create(patchOf(mesh::Model{}, 1.0, 0.0)).ok());
}

TEST(PatchSceneCreate, TakesInPlantsWiderThanThePatch) {
  // A plate of 3 x 3 patches covers the square three times three over; from above it is covered once.
  const auto scene = sceneOf(patchOf(quad({-1.0f, -1.0f, 0.5f}, {3.0f, 0.0f, 0.0f}, {0.0f, 3.0f, 0.0f}), 1.0, 1.0));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  EXPECT_EQ(hits.texels(), 256u);
  EXPECT_EQ(scene->impl().copies.size(), 25u);
}

TEST(RayCounts, GrowByTheRaysTraced) {
  const auto scene = sceneOf(patchOf(wallAt(0.5f, 0.1f), 1.0, 0.1));
  EXPECT_EQ(scene->rayCounts().nearest, 0u);
  (void)hitsOf(*scene, LayerSet::Slices, smallOptions());
  EXPECT_EQ(scene->rayCounts().nearest, 16u * 16u * 4u * 4u);
  EXPECT_EQ(scene->rayCounts().occlusion, 0u);
}

}  // namespace
}  // namespace sward::trace
