#include "wither/texel_light.h"

#include "wither/extinction.h"
#include "wither/test_texels.h"

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

Texel layers(std::initializer_list<int> at, float density, double heightM = 1.0) {
  std::vector<Texel::Entry> entries;
  for (const int z : at)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) entries.push_back({{x, y, z}, levelLeaf(density)});
  return Texel::fromEntries({16, 16, 1.0, heightM}, std::move(entries)).value();
}

TEST(TexelLight, ASingleLayerIsLitByTheWholeSunOnItsUpperSideAndLetsItThrough) {
  const Texel texel = layers({5}, 8.0f);
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  const SunReach reach = sunReach(texel, toSun, {}).value();
  ASSERT_EQ(reach.voxels.size(), 256u);
  const LeafShading shading({toSun, glm::dvec3(std::numbers::pi), glm::dvec3(0.0)});
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const Voxel& voxel = texel.voxels()[i];
    const LitVoxel lit = shading(voxel, static_cast<float>(normalShare(voxel)), 0.0f, 0.0f, reach.voxels[i]);
    // Irradiance pi cos, over pi; nothing stands above, and the voxel does not shade itself.
    EXPECT_NEAR(lit.front.g, 0.4 * toSun.z, 1e-6);
    EXPECT_NEAR(lit.back.g, 0.3 * toSun.z, 1e-6);
    EXPECT_FLOAT_EQ(reach.voxels[i], 1.0f);
  }
  // Level leaves of density rho in a layer 1/16 m thick hide rho / 16 of what comes from any direction.
  for (const float through : reach.ground) EXPECT_NEAR(through, std::exp(-8.0 / 16.0), 1e-6);
}

TEST(TexelLight, LeavesBelowAreShadedByBeersLaw) {
  const Texel texel = layers({2, 9}, 24.0f);
  const SunReach reach = sunReach(texel, glm::normalize(glm::dvec3(1.0, 0.4, 0.6)), {}).value();
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const double expected = texel.places()[i].z == 2 ? std::exp(-24.0 / 16.0) : 1.0;
    EXPECT_NEAR(reach.voxels[i], expected, 1e-6);
  }
}

TEST(TexelLight, ALeafInTheOpenSeesTheSkyThatItsSidesFace) {
  const Texel texel = layers({5}, 1e-6f);
  const TexelSky sky = sweptSky(texel, {}).value();
  // All of the cosine-weighted upper hemisphere comes to the upper side, and the ground sees it all.
  for (const float front : sky.front) EXPECT_NEAR(front, 1.0, 1e-4);
  for (const float back : sky.back) EXPECT_NEAR(back, 0.0, 1e-6);
  for (const float ground : sky.ground) EXPECT_NEAR(ground, 1.0, 1e-4);
  const LeafShading shading({{0.0, 0.0, 1.0}, glm::dvec3(0.0), glm::dvec3(2.0)});
  const LitVoxel lit = shading(texel.voxels()[0], 1.0f, sky.front[0], sky.back[0], 1.0f);
  EXPECT_NEAR(lit.front.g, 2.0 * 0.4, 1e-3);
  EXPECT_NEAR(lit.back.g, 2.0 * 0.3, 1e-3);
}

TEST(TexelLight, AnUprightLeafInTheOpenSeesAsMuchOfTheSkyWithEitherSide) {
  Voxel upright = levelLeaf(1e-6f);
  upright.normal = {1.0f, 0.0f, 0.0f};
  upright.spread = {1e-6f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  const Texel texel = Texel::fromEntries({16, 16, 1.0, 1.0}, {{{3, 4, 5}, upright}}).value();
  const TexelSky sky = sweptSky(texel, {}).value();
  // The mean of tan(angle to the zenith) / pi over the three rings; five directions a ring give the pi to 2 %. All of
  // the sky would be 1/2: what comes from under 24 degrees is counted too little, and grass hides it.
  double seen = 0.0;
  for (const double square : {1.0 / 6.0, 0.5, 5.0 / 6.0}) seen += std::sqrt(square / (1.0 - square)) / 3.0;
  EXPECT_NEAR(sky.front[0], seen / std::numbers::pi, 0.01);
  EXPECT_NEAR(sky.back[0], seen / std::numbers::pi, 0.01);
}

/// Sums of single precision over 15 directions: 1e-5.
TEST(TexelLight, TheSkyOfLayersIsTheSumOverItsDirections) {
  const float depth = 0.7f;
  // Half as high as they are wide, so that one voxel out is above a layer for every direction.
  const Texel texel = layers({2, 9}, 32.0f * depth, 0.5);
  const TexelSky sky = sweptSky(texel, {}).value();
  // From every direction a level layer of leaves lets exp(-rho h) through: what is seen of the sky is that of it.
  for (std::size_t i = 0; i < texel.size(); ++i) {
    EXPECT_NEAR(sky.front[i], texel.places()[i].z == 9 ? 1.0 : std::exp(-double{depth}), 1e-5);
    EXPECT_NEAR(sky.back[i], 0.0, 1e-6);
  }
  for (const float ground : sky.ground) EXPECT_NEAR(ground, std::exp(-2.0 * double{depth}), 1e-5);
}

TEST(TexelLight, ASunUnderTheHorizonLightsNothingAndDenseLeavesStayFinite) {
  const Texel texel = layers({0, 3, 15}, 3e7f);
  const TexelSky sky = sweptSky(texel, {}).value();
  for (const float front : sky.front) EXPECT_TRUE(std::isfinite(front));
  for (const glm::dvec3 toSun : {glm::dvec3(0.0, 0.6, -0.8), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)}) {
    const SunReach reach = sunReach(texel, toSun, {}).value();
    for (std::size_t i = 0; i < texel.size(); ++i) {
      const bool open = toSun.z > 0.0 && texel.places()[i].z == 15;
      EXPECT_NEAR(reach.voxels[i], open ? 1.0 : 0.0, 1e-30);
    }
    for (const float ground : reach.ground) EXPECT_NEAR(ground, 0.0, 1e-30);
  }
}

TEST(TexelLight, ThreadsGiveTheSameBytes) {
  const Blades blades = uprightBlades(120, 48, 0.8);
  JobContext one, four;
  one.threads = 1;
  four.threads = 4;
  const TexelSky a = sweptSky(blades.texel, one).value(), b = sweptSky(blades.texel, four).value();
  EXPECT_EQ(a.front, b.front);
  EXPECT_EQ(a.back, b.back);
  EXPECT_EQ(a.ground, b.ground);
  const glm::dvec3 toSun = glm::normalize(glm::dvec3(-2.0, 0.7, 0.5));
  const SunReach c = sunReach(blades.texel, toSun, one).value(), d = sunReach(blades.texel, toSun, four).value();
  EXPECT_EQ(c.voxels, d.voxels);
  EXPECT_EQ(c.ground, d.ground);
}

TEST(TexelLight, EndsWhenItIsAskedTo) {
  const Texel texel = layers({2, 9}, 5.0f);
  std::stop_source stop;
  stop.request_stop();
  const JobContext job{stop.get_token(), {}, 1};
  EXPECT_EQ(sweptSky(texel, job).error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(sunReach(texel, {0.0, 0.0, 1.0}, job).error().kind, ErrorKind::Cancelled);
}

TEST(TexelLight, LeavesOfEveryDirectionShadeOneAnother) {
  const TexelGrid grid{16, 16, 1.6, 1.6};  // voxels of a decimetre
  Voxel voxel;
  voxel.density = 12.0f;
  for (const std::size_t i : {0u, 3u, 5u}) voxel.spread[i] = 4.0f;
  const float share = static_cast<float>(normalShare(voxel));
  EXPECT_NEAR(share, 0.0f, 1e-6f);
  // Half of the area is turned to any light: 6 a metre over a voxel's length.
  EXPECT_NEAR(throughOwnLeaves(grid, voxel, share, {0.0f, 0.0f, 1.0f}), std::exp(-0.6), 1e-4);
  const glm::vec3 slanted = glm::normalize(glm::vec3(1.0f, 0.0f, 1.0f));
  EXPECT_NEAR(throughOwnLeaves(grid, voxel, share, slanted), std::exp(-0.6 * std::sqrt(2.0)), 1e-4);
  EXPECT_EQ(throughOwnLeaves(grid, voxel, 1.0f, {0.0f, 0.0f, 1.0f}), 1.0f) << "one leaf does not shade itself";
}

}  // namespace
}  // namespace sward::wither
