#include "render/fixture.h"
#include "terrain/hills.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sward {
namespace {

using testing::frameOf;
using testing::makeGround;
using testing::makeStage;
using testing::smallOptions;

using Field = std::shared_ptr<const terrain::HeightField>;

/// 256 m round the origin.
Field fieldOf(const std::function<double(double, double)>& height) {
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 65;
  grid.cellM = glm::dvec2(4.0);
  grid.origin = {-128.0, -128.0};
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      grid.heights.push_back(static_cast<float>(height(-128.0 + 4.0 * x, -128.0 + 4.0 * y)));
  return terrain::HeightField::create(std::move(grid)).value();
}

double meanGreen(const image::Image& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sum += static_cast<double>(picture.rgb(x, y).g);
  return sum / (picture.width * picture.height);
}

/// Mean absolute difference over the mean.
double difference(const image::Image& a, const image::Image& b) {
  double sum = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    sum += static_cast<double>(std::abs(a.pixels[i] - b.pixels[i]));
    mean += static_cast<double>(a.pixels[i]);
  }
  return sum / mean;
}

TEST(Terrain, LevelFieldsDrawAsLevelGround) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(200.0, 40.0), 3.0);
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  // Eye height, from above, and from within the grass.
  for (const double height : {1.6, 12.0, 0.2}) {
    const glm::dvec3 eye(0.3, -0.2, height), target(2.0, 14.0, 0.3 * height);
    ASSERT_TRUE(stage.renderer->setTerrain(nullptr).ok());
    const auto level = stage.renderer->drawLinear(frameOf(eye, target, 160, 90, 4)).value();
    for (const double lift : {0.0, 50.0}) {
      ASSERT_TRUE(stage.renderer->setTerrain(fieldOf([&](double, double) { return lift; })).ok());
      const glm::dvec3 up(0.0, 0.0, lift);
      const auto raised = stage.renderer->drawLinear(frameOf(eye + up, target + up, 160, 90, 4));
      ASSERT_TRUE(raised.ok()) << raised.error().text();
      // Distances come from the rasteriser, to some 1e-6: now and then another texel is the nearest.
      EXPECT_LT(difference(level, *raised), 0.015) << height << ' ' << lift;
    }
  }
}

TEST(Terrain, OnSlopesTheShellIsSheared) {
  // Plants stay vertical: a ray's way through the shell is height / |d_z - g . d_xy|, and the medium's extinction
  // stays.
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(180.0, 60.0), 0.0);
  auto options = smallOptions();
  options.basis = lpt::Basis::Ptm;
  const double coverage = 20.0 / 255.0;
  const glm::dvec2 g(0.35, -0.2);
  const Field slope = fieldOf([&](double x, double y) { return g.x * x + g.y * y; });
  const auto green = [&](double even, double soil, const render::Frame& frame) {
    options.evenCoverage = even;
    options.soilReflectance = soil;
    EXPECT_TRUE(stage.renderer->setGround(makeGround(options)).ok());
    EXPECT_TRUE(stage.renderer->setTerrain(slope).ok());
    return meanGreen(stage.renderer->drawLinear(frame).value());
  };
  const double slab = options.heightM / options.layers;
  const double perM = -std::log1p(-coverage) / slab;
  for (const glm::dvec3& toEye : {glm::dvec3(0.0, 0.0, 1.0), glm::normalize(glm::dvec3(0.5, -0.4, 0.6)),
                                  glm::normalize(glm::dvec3(-0.6, 0.1, 0.7))}) {
    const glm::dvec3 target(0.3, 0.2, slope->height({0.3, 0.2}));
    const auto frame = frameOf(target + 30.0 * toEye, target, 96, 96, 4, 400.0);
    const double bare = green(1e-6, 0.6, frame) - green(1e-6, 0.1, frame);
    const double through = (green(coverage, 0.6, frame) - green(coverage, 0.1, frame)) / bare;
    const double sink = toEye.z - glm::dot(g, glm::dvec2(toEye));
    const double expected = std::exp(-0.985 * perM * options.heightM / sink);
    // As on level ground (march_test.cpp), and the storage's 0.985 taken as a factor.
    EXPECT_NEAR(through, expected, 0.04 * expected + 0.008) << toEye.x;
  }
}

TEST(Terrain, HillsHaveNoHoles) {
  // Bare soil of one grey, unlit: every pixel must show it once.
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(180.0, 60.0), 0.0);
  auto options = smallOptions();
  options.evenCoverage = 1e-6;
  options.soilReflectance = 0.5;
  ASSERT_TRUE(stage.renderer->setGround(makeGround(options)).ok());
  terrain::HillOptions hills;
  hills.amplitudeM = 40.0;
  hills.featureSizeM = 80.0;
  ASSERT_TRUE(stage.renderer->setTerrain(terrain::HeightField::create(terrain::makeHills(hills).value()).value()).ok());
  for (const glm::dvec3& eye :
       {glm::dvec3(0.0, 0.0, 60.0), glm::dvec3(40.0, -900.0, 90.0), glm::dvec3(7.0, 3.0, 2000.0)}) {
    auto frame = frameOf(eye, {eye.x + 30.0, eye.y + 150.0, eye.z - 90.0}, 320, 200, 2);
    frame.mode.quantity = render::ViewQuantity::Albedo;
    const auto picture = stage.renderer->drawLinear(frame);
    ASSERT_TRUE(picture.ok()) << picture.error().text();
    int wrong = 0;
    for (int y = 0; y < picture->height; ++y)
      for (int x = 0; x < picture->width; ++x) wrong += std::abs(picture->rgb(x, y).g - 0.5f) > 0.02f ? 1 : 0;
    EXPECT_EQ(wrong, 0) << eye.z;
  }
}

TEST(Terrain, SlopesTowardTheSunAreBrighterAndShadowsDarken) {
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  // A ridge along y, 40 m high, with the sun 20 degrees over the west.
  ASSERT_TRUE(
      stage.renderer->setTerrain(fieldOf([](double x, double) { return 40.0 * std::exp(-x * x / 800.0); })).ok());
  stage.renderer->setDaylight(testing::daylightAt(270.0, 20.0), 0.0);
  const auto seen = [&](double x) {
    const double z = 40.0 * std::exp(-x * x / 800.0);
    return meanGreen(stage.renderer->drawLinear(frameOf({x, -0.1, z + 25.0}, {x, 0.0, z}, 48, 48, 2, 200.0)).value());
  };
  const double toward = seen(-20.0), level = seen(-110.0), away = seen(20.0), shadow = seen(50.0), beyond = seen(115.0);
  EXPECT_GT(toward, 1.1 * level);
  EXPECT_LT(away, 0.7 * level);
  EXPECT_LT(shadow, 0.7 * level);
  EXPECT_GT(shadow, 0.02 * level);           // the sky is left
  EXPECT_NEAR(beyond, level, 0.25 * level);  // the shadow is 110 m long at its middle
}

TEST(Terrain, HardCases) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(180.0, -3.0), 0.0);
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  ASSERT_TRUE(stage.renderer->setTerrain(fieldOf([](double x, double) { return std::max(x, 0.0) * 5.0; })).ok());
  // Far under the ground, at its border, far outside, straight down and up.
  const glm::dvec3 targets[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0.01}, {-1, 0.3, -0.2}};
  for (const glm::dvec3& eye :
       {glm::dvec3(20, 0, -500), glm::dvec3(128, 0, 641), glm::dvec3(1e5, -1e5, 700), glm::dvec3(0, 0, 1)}) {
    for (const glm::dvec3& way : targets) {
      const auto picture = stage.renderer->drawLinear(frameOf(eye, eye + way, 64, 48, 1));
      ASSERT_TRUE(picture.ok()) << picture.error().text();
      EXPECT_TRUE(std::all_of(picture->pixels.begin(), picture->pixels.end(),
                              [](float v) { return std::isfinite(v) && v >= 0.0f; }));
    }
  }
  // Back to level ground.
  ASSERT_TRUE(stage.renderer->setTerrain(nullptr).ok());
  EXPECT_TRUE(stage.renderer->drawLinear(frameOf({0, 0, 2}, {0, 5, 0}, 64, 48, 1)).ok());
}

}  // namespace
}  // namespace sward
