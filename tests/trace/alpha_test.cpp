#include "trace/layers.h"

#include "trace/test_patches.h"
#include "trace/patch_scene_impl.h"

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

/// A plate over the whole square with this alpha.
std::shared_ptr<scene::Patch> sheet(float alpha, mesh::AlphaMode mode) {
  mesh::Model model = quad({0.0f, 0.0f, 0.6f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  model.materials[0].baseColour.a = alpha;
  model.materials[0].alphaMode = mode;
  return patchOf(std::move(model), 1.0, 1.0);
}

double coverageFromAbove(const PatchScene& scene) {
  SamplingOptions options = smallOptions();
  options.sliceResolution = 64;
  const LayerHits hits = hitsOf(scene, LayerSet::Slices, options);
  return static_cast<double>(hits.hits.size()) / (64.0 * 64.0 * 4.0);
}

double lightBelow(const PatchScene& scene, const glm::dvec3& light) {
  SamplingOptions options = smallOptions();
  options.sliceResolution = 64;
  const LayerLuminance luminance = lightOn(scene, hitsOf(scene, LayerSet::Ground, options), light);
  double sum = 0.0;
  for (const float value : luminance.reflected) sum += static_cast<double>(value);
  return sum / (64.0 * 64.0 * glm::normalize(light).z);
}

TEST(Alpha, OpaqueMaterialsIgnoreTheirAlpha) {
  const auto scene = sceneOf(sheet(0.3f, mesh::AlphaMode::Opaque));
  EXPECT_EQ(coverageFromAbove(*scene), 1.0);
  EXPECT_TRUE(scene->impl().alpha.empty());
}

TEST(Alpha, MasksAreAllOrNothing) {
  const auto open = sceneOf(sheet(0.4f, mesh::AlphaMode::Mask)), closed = sceneOf(sheet(0.6f, mesh::AlphaMode::Mask));
  EXPECT_EQ(coverageFromAbove(*open), 0.0);
  EXPECT_EQ(coverageFromAbove(*closed), 1.0);
  EXPECT_NEAR(lightBelow(*open, {0.2, 0.1, 1.0}), 1.0, 1e-5);
  EXPECT_EQ(lightBelow(*closed, {0.2, 0.1, 1.0}), 0.0);
}

TEST(Alpha, BlendIsAFractionOfTheRays) {
  for (const float alpha : {0.0f, 0.25f, 0.6f, 1.0f}) {
    const auto scene = sceneOf(sheet(alpha, mesh::AlphaMode::Blend));
    // 16384 independent chances: five standard deviations.
    const double tolerance = 5.0 * std::sqrt(static_cast<double>(alpha * (1.0f - alpha)) / 16384.0) + 1e-6;
    EXPECT_NEAR(coverageFromAbove(*scene), static_cast<double>(alpha), tolerance);
    EXPECT_NEAR(lightBelow(*scene, {0.2, 0.1, 1.0}), 1.0 - static_cast<double>(alpha), tolerance);
  }
}

TEST(Alpha, TwoSheetsActIndependently) {
  mesh::Model model = quad({0.0f, 0.0f, 0.6f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  testing::addQuad(model, {0.0f, 0.0f, 0.3f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  model.materials[0].baseColour.a = 0.5f;
  model.materials[0].alphaMode = mesh::AlphaMode::Blend;
  const auto scene = sceneOf(patchOf(std::move(model), 1.0, 1.0));
  EXPECT_NEAR(lightBelow(*scene, {0.2, 0.1, 1.0}), 0.25, 5.0 * std::sqrt(0.1875 / 16384.0));
  // A low sun crosses into other patches, whose sheets are others.
  EXPECT_NEAR(lightBelow(*scene, {5.0, 0.1, 1.0}), 0.25, 5.0 * std::sqrt(0.1875 / 16384.0));
}

}  // namespace
}  // namespace sward::trace
