#include "render/fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace sward {
namespace {

using testing::makeGround;
using testing::makeStage;
using testing::smallOptions;
using testing::storageBound;

class RelitTexels : public ::testing::TestWithParam<std::tuple<lpt::Basis, int>> {};
INSTANTIATE_TEST_SUITE_P(Bases, RelitTexels,
                         ::testing::Combine(::testing::Values(lpt::Basis::Lpt, lpt::Basis::Ptm, lpt::Basis::Constant),
                                            ::testing::Values(8, 16)));

void expectSameAsOnTheCpu(render::Renderer& renderer, const bake::GroundBake& ground, const lpt::LayerStack& stack,
                          int firstLayer, const lpt::Illumination& light) {
  const double scale = renderer.relightScale();
  const int side = ground.tiles.resolution, apron = ground.tiles.apron;
  for (int tile = 0; tile < stack.images; ++tile) {
    for (int layer = 0; layer < stack.layers; ++layer) {
      const auto relit = renderer.readRelitSlices(tile, firstLayer + layer, 0);
      ASSERT_TRUE(relit.ok()) << relit.error().text();
      ASSERT_EQ(relit->size(), static_cast<std::size_t>(side * side));
      for (int i = 0; i < side * side; ++i) {
        const glm::vec4 expected = lpt::relitTexel(stack, tile, layer, apron + i % side, apron + i / side, light);
        const glm::vec4 got = (*relit)[static_cast<std::size_t>(i)];
        ASSERT_NEAR(got.a, expected.a, 1.02 * testing::coverageBound(static_cast<double>(expected.a)))
            << tile << ' ' << layer << ' ' << i;
        for (int c = 0; c < 3; ++c) {
          const double value = static_cast<double>(expected[c]);
          ASSERT_LE(value, scale);
          ASSERT_NEAR(static_cast<double>(got[c]) * scale, value, storageBound(value, scale))
              << tile << ' ' << layer << ' ' << i;
        }
      }
    }
  }
}

TEST_P(RelitTexels, EqualTheCpusAtTheFinestLevel) {
  auto options = smallOptions();
  std::tie(options.basis, options.bits) = GetParam();
  const auto ground = makeGround(options);
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  for (const double azimuth : {30.0, 250.0}) {
    const auto daylight = testing::daylightAt(azimuth, 25.0);
    stage.renderer->setDaylight(daylight);
    const auto light = testing::illuminationOf(daylight);
    expectSameAsOnTheCpu(*stage.renderer, *ground, ground->slices, 0, light);
    expectSameAsOnTheCpu(*stage.renderer, *ground, ground->soil, ground->slices.layers, light);
  }
}

TEST(Relight, OnACommonResponseEqualsTheCpus) {
  for (const double evenCoverage : {0.0, 0.3}) {
    for (const int bits : {8, 16}) {
      auto options = smallOptions();
      options.common = true;
      options.bits = bits;
      options.evenCoverage = evenCoverage;
      const auto ground = makeGround(options);
      ASSERT_FALSE(ground->slices.common.empty());
      auto stage = makeStage();
      ASSERT_TRUE(stage.renderer->setGround(ground).ok());
      const auto daylight = testing::daylightAt(250.0, 25.0);
      stage.renderer->setDaylight(daylight);
      expectSameAsOnTheCpu(*stage.renderer, *ground, ground->slices, 0, testing::illuminationOf(daylight));
    }
  }
}

TEST(Relight, FollowsTheSun) {
  const auto ground = makeGround(smallOptions());
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  stage.renderer->setDaylight(testing::daylightAt(90.0, 30.0));
  const auto east = stage.renderer->readRelitSlices(0, 4, 0);
  stage.renderer->setDaylight(testing::daylightAt(270.0, 30.0));
  const auto west = stage.renderer->readRelitSlices(0, 4, 0);
  ASSERT_TRUE(east.ok() && west.ok());
  EXPECT_NE(*east, *west);
}

TEST(Relight, ASunBelowTheHorizonAddsNothing) {
  const auto ground = makeGround(smallOptions());
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  const auto night = testing::daylightAt(200.0, -4.0);
  stage.renderer->setDaylight(night);
  lpt::Illumination skyAlone = testing::illuminationOf(night);
  skyAlone.sunIrradiance = glm::dvec3(0.0);
  expectSameAsOnTheCpu(*stage.renderer, *ground, ground->slices, 0, skyAlone);
}

struct Premultiplied {
  glm::dvec3 colour{0.0};
  double alpha = 0.0;
};

Premultiplied premultiply(const glm::vec4& texel) {
  const glm::dvec4 t(texel);
  return {glm::dvec3(t) * t.a, t.a};
}

TEST(Relight, MipsAreCoverageWeightedMeansOfTheLevelAbove) {
  const auto ground = makeGround(smallOptions());
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  stage.renderer->setDaylight(testing::daylightAt(120.0, 40.0));
  double mostColour = 0.0;
  for (int mip = 1; mip <= 5; ++mip) {
    const int side = 32 >> mip;
    for (const int layer : {2, 5, 8}) {
      const auto fine = stage.renderer->readRelitSlices(1, layer, mip - 1);
      const auto coarse = stage.renderer->readRelitSlices(1, layer, mip);
      ASSERT_TRUE(fine.ok() && coarse.ok());
      ASSERT_EQ(coarse->size(), static_cast<std::size_t>(side * side));
      for (int i = 0; i < side * side; ++i) {
        Premultiplied mean;
        for (int k = 0; k < 4; ++k) {
          const int at = (2 * (i / side) + k / 2) * 2 * side + 2 * (i % side) + k % 2;
          const Premultiplied part = premultiply((*fine)[static_cast<std::size_t>(at)]);
          mean.colour += part.colour / 4.0;
          mean.alpha += part.alpha / 4.0;
        }
        const glm::vec4 got = (*coarse)[static_cast<std::size_t>(i)];
        // Level 1 is made from values before rounding, so half a step of the finer level comes on top.
        ASSERT_NEAR(static_cast<double>(got.a), mean.alpha, 2.1 * testing::coverageBound(mean.alpha) + 2e-4);
        if (mean.alpha < 0.05) continue;
        for (int c = 0; c < 3; ++c) {
          const double straight = mean.colour[c] / mean.alpha;
          ASSERT_NEAR(static_cast<double>(got[c]), straight, 2.5 * storageBound(straight, 1.0)) << mip << ' ' << i;
          mostColour = std::max(mostColour, straight);
        }
      }
    }
  }
  EXPECT_GT(mostColour, 0.02);
}

TEST(Relight, TheCoarsestLevelOfTheLastImageIsTheMeanOfAllTiles) {
  const auto ground = makeGround(smallOptions());
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  stage.renderer->setDaylight(testing::daylightAt(120.0, 40.0));
  for (const int layer : {3, 6, 8}) {
    Premultiplied mean;
    for (int tile = 0; tile < 4; ++tile) {
      const auto part = premultiply(stage.renderer->readRelitSlices(tile, layer, 5).value().at(0));
      mean.colour += part.colour / 4.0;
      mean.alpha += part.alpha / 4.0;
    }
    const glm::vec4 got = stage.renderer->readRelitSlices(4, layer, 5).value().at(0);
    EXPECT_GT(mean.alpha, 0.0);
    EXPECT_NEAR(static_cast<double>(got.a), mean.alpha, 1.02 * testing::coverageBound(mean.alpha));
    for (int c = 0; c < 3; ++c) {
      const double straight = mean.colour[c] / mean.alpha;
      EXPECT_NEAR(static_cast<double>(got[c]), straight, storageBound(straight, 1.0));
    }
  }
}

TEST(Relight, RefusesGroundsThatDoNotFitTogether) {
  auto stage = makeStage();
  const auto good = testing::syntheticGround(smallOptions());
  const auto refused = [&](auto&& breakIt) {
    auto broken = good;
    breakIt(broken);
    return !stage.renderer->setGround(std::make_shared<const bake::GroundBake>(std::move(broken))).ok();
  };
  EXPECT_TRUE(refused([](auto& g) { g.slices.surface.pop_back(); }));
  EXPECT_TRUE(refused([](auto& g) { g.slices = {}; }));
  EXPECT_TRUE(refused([](auto& g) { g.map.tiles[5] = 200; }));
  EXPECT_TRUE(refused([](auto& g) { g.map = {}; }));
  EXPECT_TRUE(refused([](auto& g) { g.bladeOwners.pop_back(); }));
  EXPECT_TRUE(refused([](auto& g) { g.bladeOwners[3].slab = 99; }));
  EXPECT_TRUE(refused([](auto& g) { g.bladesPerPatch = 3; }));
  EXPECT_TRUE(refused([](auto& g) { g.tiles.resolution = 30; }));
  EXPECT_FALSE(refused([](auto&) {}));
  EXPECT_FALSE(stage.renderer->setGround(nullptr).ok());
}

}  // namespace
}  // namespace sward
