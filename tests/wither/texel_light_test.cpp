#include "wither/texel_light.h"

#include "wither/extinction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sward::wither {
namespace {

/// A level leaf area of every voxel of one layer of a 16 x 16 x 16 block of 1 m, normal up, beside nothing.
Voxel levelLeaf(float density) {
  Voxel voxel;
  voxel.density = density;
  voxel.normal = {0.0f, 0.0f, 1.0f};
  voxel.tangent = {1.0f, 0.0f, 0.0f};
  voxel.diffuse = {0.3f, 0.4f, 0.1f};
  voxel.transmitted = {0.2f, 0.3f, 0.05f};
  voxel.spread = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, density};
  return voxel;
}

Texel layers(std::initializer_list<int> at, float density) {
  std::vector<Texel::Entry> entries;
  for (const int z : at)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) entries.push_back({{x, y, z}, levelLeaf(density)});
  return Texel::fromEntries({16, 16, 1.0, 1.0}, std::move(entries)).value();
}

TEST(TexelLight, ASingleLayerIsLitByTheWholeSunOnItsUpperSideAndLetsItThrough) {
  const Texel texel = layers({5}, 8.0f);
  const TexelSky dark{std::vector<float>(256, 0.0f), std::vector<float>(256, 0.0f), std::vector<float>(256, 0.0f)};
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  const LitTexel lit = lightTexel(texel, dark, {toSun, glm::dvec3(std::numbers::pi), glm::dvec3(0.0)}, {}).value();
  ASSERT_EQ(lit.voxels.size(), 256u);
  for (const LitVoxel& voxel : lit.voxels) {
    // Irradiance pi cos, over pi; nothing stands above, and the voxel does not shade itself.
    EXPECT_NEAR(voxel.front.g, 0.4 * toSun.z, 1e-6);
    EXPECT_NEAR(voxel.back.g, 0.3 * toSun.z, 1e-6);
    EXPECT_FLOAT_EQ(voxel.sun, 1.0f);
  }
  // Level leaves of density rho in a layer 1/16 m thick hide rho / 16 of what comes from any direction.
  for (const float through : lit.groundSun) EXPECT_NEAR(through, std::exp(-8.0 / 16.0), 1e-6);
}

TEST(TexelLight, LeavesBelowAreShadedByBeersLaw) {
  const Texel texel = layers({2, 9}, 24.0f);
  const TexelSky dark{std::vector<float>(512, 0.0f), std::vector<float>(512, 0.0f), std::vector<float>(256, 0.0f)};
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(1.0, 0.4, 0.6));
  const LitTexel lit = lightTexel(texel, dark, {toSun, glm::dvec3(1.0), glm::dvec3(0.0)}, {}).value();
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const double expected = texel.places()[i].z == 2 ? std::exp(-24.0 / 16.0) : 1.0;
    EXPECT_NEAR(lit.voxels[i].sun, expected, 1e-6);
  }
}

TEST(TexelLight, ALeafInTheOpenSeesTheSkyThatItsSidesFace) {
  const Texel texel = layers({5}, 1e-6f);
  const TexelSky sky = sweptSky(texel, {}).value();
  // All of the cosine-weighted upper hemisphere comes to the upper side, and the ground sees it all.
  for (const float front : sky.front) EXPECT_NEAR(front, 1.0, 1e-4);
  for (const float back : sky.back) EXPECT_NEAR(back, 0.0, 1e-6);
  for (const float ground : sky.ground) EXPECT_NEAR(ground, 1.0, 1e-4);
  const LitTexel lit = lightTexel(texel, sky, {{0.0, 0.0, 1.0}, glm::dvec3(0.0), glm::dvec3(2.0)}, {}).value();
  EXPECT_NEAR(lit.voxels.front().front.g, 2.0 * 0.4, 1e-3);
  EXPECT_NEAR(lit.voxels.front().back.g, 2.0 * 0.3, 1e-3);
}

TEST(TexelLight, ASunUnderTheHorizonLightsNothingAndDenseLeavesStayFinite) {
  const Texel texel = layers({0, 3, 15}, 3e7f);
  const TexelSky sky = sweptSky(texel, {}).value();
  for (const glm::dvec3 toSun : {glm::dvec3(0.0, 0.6, -0.8), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)}) {
    const LitTexel lit = lightTexel(texel, sky, {toSun, glm::dvec3(3.0), glm::dvec3(0.1)}, {}).value();
    for (const LitVoxel& voxel : lit.voxels) {
      EXPECT_TRUE(std::isfinite(voxel.front.r + voxel.front.g + voxel.back.b + voxel.sun));
      EXPECT_GE(voxel.front.g, 0.0f);
      if (toSun.z < 0.0) {
        EXPECT_EQ(voxel.sun, 0.0f);
      }
    }
  }
}

TEST(TexelLight, ThreadsGiveTheSameBytes) {
  const Texel texel = layers({2, 9, 11}, 5.0f);
  JobContext one, four;
  one.threads = 1;
  four.threads = 4;
  const TexelSky a = sweptSky(texel, one).value(), b = sweptSky(texel, four).value();
  EXPECT_EQ(a.front, b.front);
  EXPECT_EQ(a.back, b.back);
  EXPECT_EQ(a.ground, b.ground);
}

}  // namespace
}  // namespace sward::wither
