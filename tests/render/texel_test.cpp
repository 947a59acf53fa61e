#include "render/fixture.h"
#include "render/texel_set.h"

#include "base/random.h"
#include "terrain/height_field.h"
#include "wither/extinction.h"
#include "wither/leaf_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

namespace sward {
namespace {

using testing::frameOf;
using testing::makeStage;

/// Level leaves in a block of 1 m of 16 voxels a side, as dense as `density` says, over white soil.
std::shared_ptr<const bake::GroundBake> blockOf(const std::function<float(glm::ivec3)>& density, glm::vec3 colour) {
  std::vector<wither::Texel::Entry> entries;
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        wither::Voxel voxel;
        voxel.density = density({x, y, z});
        voxel.normal = {0.0f, 0.0f, 1.0f};
        voxel.diffuse = colour;
        voxel.spread[5] = voxel.density;
        if (voxel.density > 0.0f) entries.push_back({{x, y, z}, voxel});
      }
  auto texels = std::make_shared<bake::TexelBake>();
  auto texel =
      std::make_shared<const wither::Texel>(wither::Texel::fromEntries({16, 16, 1.0, 1.0}, std::move(entries)).value());
  texels->levels.push_back({texel, wither::sweptSky(*texel, {}).value()});
  texels->soil.assign(256, glm::vec3(0.5f));
  auto ground = std::make_shared<bake::GroundBake>();
  ground->patchSideM = ground->heightM = 1.0;
  ground->tiles.resolution = ground->tiles.patchResolution = 1;
  ground->map.width = ground->map.height = 8;
  ground->map.tiles.assign(64, 0);
  ground->texels = std::move(texels);
  return ground;
}

/// In one layer.
std::shared_ptr<const bake::GroundBake> layerOf(int layer, float density, glm::vec3 colour) {
  return blockOf([&](const glm::ivec3& at) { return at.z == layer ? density : 0.0f; }, colour);
}

render::Frame downFrame(int samples) {
  render::Frame frame = frameOf({0.3, 0.2, 6.0}, {0.3, 0.21, 0.0}, 64, 48, samples, 200.0);
  frame.options.method = render::GroundMethod::Texels;
  return frame;
}

glm::dvec3 meanOf(const image::Image& picture) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sum += glm::dvec3(picture.rgb(x, y));
  return sum / static_cast<double>(picture.width * picture.height);
}

TEST(Texels, BareSoilShowsItsIrradiance) {
  auto stage = makeStage();
  const scene::Daylight daylight = testing::daylightAt(200.0, 50.0);
  stage.renderer->setDaylight(daylight, 0.0);
  ASSERT_TRUE(stage.renderer->setGround(layerOf(3, 0.0f, glm::vec3(0.0f))).ok());
  const glm::dvec3 seen = meanOf(stage.renderer->drawLinear(downFrame(4)).value());
  const glm::dvec3 lit =
      daylight.sunIrradiance() * (daylight.sunDirection().z / std::numbers::pi) + daylight.meanSkyRadiance();
  // Ten bits of a square root: half a step is 1 / 1023 of it, twice that of the value where it is largest.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], 0.5 * lit[c], 0.004 * lit[c]);
}

TEST(Texels, ALayerHidesAndShadesTheSoilByBeersLaw) {
  auto stage = makeStage();
  const scene::Daylight daylight = testing::daylightAt(0.0, 90.0);
  stage.renderer->setDaylight(daylight, 0.0);
  const double depth = 1.2;
  ASSERT_TRUE(stage.renderer->setGround(layerOf(7, static_cast<float>(16.0 * depth), glm::vec3(0.0f))).ok());
  const glm::dvec3 seen = meanOf(stage.renderer->drawLinear(downFrame(16)).value());
  // Black leaves: the soil, lit by the sun through the layer and by what the sky sends through it, seen through it.
  const wither::Texel texel = *layerOf(7, static_cast<float>(16.0 * depth), glm::vec3(0.0f))->texels->levels[0].texel;
  const double sky = wither::sweptSky(texel, {}).value().ground.front();
  const glm::dvec3 lit =
      daylight.sunIrradiance() * (std::exp(-depth) / std::numbers::pi) + daylight.meanSkyRadiance() * sky;
  // Density in 8 bits of a square root, a fitted exponential (1 %), a lens of some degrees.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / (0.5 * lit[c] * std::exp(-depth)), 1.0, 0.03);
}

TEST(Texels, OpaqueLeavesShowTheirLitSide) {
  auto stage = makeStage();
  const scene::Daylight daylight = testing::daylightAt(120.0, 60.0);
  stage.renderer->setDaylight(daylight, 0.0);
  const glm::vec3 green(0.2f, 0.4f, 0.1f);
  const auto ground = layerOf(12, 16.0f * 30.0f, green);
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  const glm::dvec3 seen = meanOf(stage.renderer->drawLinear(downFrame(4)).value());
  // Of the sky a leaf in the layer sees what the leaves beside it leave over.
  const double sky = static_cast<double>(ground->texels->levels[0].sky.front.front());
  const glm::dvec3 lit =
      daylight.sunIrradiance() * (daylight.sunDirection().z / std::numbers::pi) + daylight.meanSkyRadiance() * sky;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c] / (double{green[c]} * lit[c]), 1.0, 0.02);
}

/// A thin layer of leaves that face every way, over black soil: both eyes of the test look through as much of it.
std::shared_ptr<const bake::GroundBake> mossOf(glm::vec3 reflected, glm::vec3 passed) {
  auto ground = std::make_shared<bake::GroundBake>(*layerOf(12, 24.0f, reflected));
  auto texels = std::make_shared<bake::TexelBake>(*ground->texels);
  texels->soil.assign(256, glm::vec3(0.0f));
  std::vector<wither::Texel::Entry> entries;
  for (int i = 0; i < 256; ++i) {
    wither::Voxel voxel;
    voxel.density = 24.0f;
    for (const std::size_t k : {0u, 3u, 5u}) voxel.spread[k] = voxel.density / 3.0f;
    voxel.diffuse = reflected;
    voxel.transmitted = passed;
    entries.push_back({{i % 16, i / 16, 12}, voxel});
  }
  const wither::Texel moss = wither::Texel::fromEntries({16, 16, 1.0, 1.0}, std::move(entries)).value();
  texels->levels[0] = {std::make_shared<const wither::Texel>(moss), wither::sweptSky(moss, {}).value()};
  ground->texels = std::move(texels);
  return ground;
}

TEST(Texels, LeavesOfEveryDirectionAnswerToWhereTheEyeStands) {
  auto stage = makeStage();
  const scene::Daylight daylight = testing::daylightAt(90.0, 50.0);
  stage.renderer->setDaylight(daylight, 0.0);
  const auto ground = mossOf({0.3f, 0.3f, 0.3f}, {0.06f, 0.15f, 0.3f});
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  auto set = render::TexelSet::create(ground->texels);
  ASSERT_TRUE(set.ok());
  const glm::dvec3 toSun = daylight.sunDirection();
  ASSERT_TRUE(set->relight({toSun, daylight.sunIrradiance(), daylight.meanSkyRadiance()}, {}).ok());
  const wither::PhaseMeans means = set->phases().front();
  EXPECT_NEAR(means.unordered, 1.0, 1e-6);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(means.passed[c], 0.2 + 0.3 * c + (c == 2 ? 0.2 : 0.0), 1e-5);
  const glm::dvec3 target(0.3, 0.2, 0.8);
  const auto seenFrom = [&](const glm::dvec3& toEye) {
    render::Frame frame = frameOf(target + 6.0 * toEye, target, 64, 48, 16, 200.0);
    frame.options.method = render::GroundMethod::Texels;
    frame.options.macroVariation = 0.0;
    return meanOf(stage.renderer->drawLinear(frame).value());
  };
  const auto factor = [&](const glm::dvec3& toEye, int c) {
    return 1.0 + means.unordered * means.sun[c] * (wither::leafPhase(glm::dot(toEye, toSun), means.passed[c]) - 1.0);
  };
  const glm::dvec3 behind = toSun, against = glm::normalize(glm::dvec3(-toSun.x, -toSun.y, toSun.z));
  const glm::dvec3 first = seenFrom(behind), second = seenFrom(against);
  // Colours of 5 and 6 bits, dithered; a lens of some degrees.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(first[c] / second[c], factor(behind, c) / factor(against, c), 0.04 * first[c] / second[c]) << c;
  }
  EXPECT_GT(first.r / second.r, 1.3) << "leaves that let little through are darker against the sun";
}

/// Every direction of view is drawn without holes: neither NaN nor black, nor sky where ground must be.
TEST(Texels, CoverTheGroundFromEverySide) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(30.0, 40.0), 5.0);
  ASSERT_TRUE(stage.renderer->setGround(layerOf(4, 16.0f * 30.0f, glm::vec3(1.0f, 0.0f, 0.0f))).ok());
  for (int turn = 0; turn < 8; ++turn) {
    for (const double height : {0.1, 0.6, 1.5, 30.0}) {
      const double azimuth = turn * std::numbers::pi / 4.0;
      render::Frame frame =
          frameOf({0.0, 0.0, height}, {3.0 * std::cos(azimuth), 3.0 * std::sin(azimuth), -8.0}, 40, 30, 2);
      frame.options.method = render::GroundMethod::Texels;
      const image::Image picture = stage.renderer->drawLinear(frame).value();
      for (const float value : picture.pixels) ASSERT_TRUE(std::isfinite(value));
      if (height < 0.6) continue;
      const glm::dvec3 mean = meanOf(picture);
      EXPECT_GT(mean.r, 10.0 * std::max(mean.g, 1e-9)) << "turn " << turn << ", from " << height;
    }
  }
}

/// Correlation of a picture's green with itself `lag` pixels on.
double correlation(const image::Image& picture, int lag) {
  double mean = 0.0;
  for (std::size_t i = 1; i < picture.pixels.size(); i += 3) mean += static_cast<double>(picture.pixels[i]);
  mean /= static_cast<double>(picture.pixels.size() / 3);
  double product = 0.0, square = 0.0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x + lag < picture.width; ++x) {
      const double here = static_cast<double>(picture.rgb(x, y).g) - mean;
      product += here * (static_cast<double>(picture.rgb(x + lag, y).g) - mean);
      square += here * here;
    }
  return product / square;
}

TEST(Texels, DoNotRepeatInRowsWhereTheGridIsBent) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(0.0, 90.0), 0.0);
  // Black tufts on white soil, at places without order.
  const auto tufts = blockOf(
      [](const glm::ivec3& at) {
        const auto lot = base::mix64(7, static_cast<std::uint64_t>(at.x / 2), static_cast<std::uint64_t>(at.y / 2));
        return at.z == 0 && lot % 3 == 0 ? 400.0f : 0.0f;
      },
      glm::vec3(0.0f));
  ASSERT_TRUE(stage.renderer->setGround(tufts).ok());
  render::Frame frame = frameOf({0.0, 0.0, 40.0}, {0.0, 0.001, 0.0}, 256, 192, 4);
  // Sixteen pixels a metre of ground, so that the block's side is whole pixels.
  frame.camera.tanHalfWidth = 128.0 / 16.0 / 40.0;
  frame.options.method = render::GroundMethod::Texels;
  frame.options.macroVariation = 0.0;
  frame.options.gridBendM = 0.0;
  const double rows = correlation(stage.renderer->drawLinear(frame).value(), 16);
  frame.options.gridBendM = 0.7;
  const image::Image shifted = stage.renderer->drawLinear(frame).value();
  // What is left of 1 (less noise) is the share of places whose neighbour a side away has the same cell, near none; and
  // chance: 16 x 12 cells of some 20 tufts, of which the mean of 192 products strays by 0.1 at most.
  EXPECT_GT(rows, 0.8);
  EXPECT_LT(correlation(shifted, 16), 0.25 * rows);
  EXPECT_EQ(shifted.pixels, stage.renderer->drawLinear(frame).value().pixels);
}

/// Over narrow crests no ray may come through grass that hides everything: between the highest grass of a column of
/// pixels and its foot is grass alone, neither sky nor soil.
TEST(Texels, HideTheGroundAndTheSkyAtCrests) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(180.0, 50.0), 0.0);
  const auto dense = [](const glm::ivec3& at) { return at.z < 5 ? 60.0f : 0.0f; };
  ASSERT_TRUE(stage.renderer->setGround(blockOf(dense, glm::vec3(1.0f, 0.0f, 0.0f))).ok());
  terrain::HeightGrid grid;
  grid.columns = grid.rows = 129;
  grid.cellM = glm::dvec2(1.0);
  grid.origin = {-64.0, -64.0};
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x)
      grid.heights.push_back(static_cast<float>(4.0 * std::sin(0.5 * y) * std::cos(0.2 * x) + 0.1 * y));
  ASSERT_TRUE(stage.renderer->setTerrain(terrain::HeightField::create(std::move(grid)).value()).ok());
  render::Frame frame = frameOf({0.0, -60.0, 9.0}, {0.0, 0.0, 4.0}, 160, 120, 4);
  frame.options.method = render::GroundMethod::Texels;
  const image::Image picture = stage.renderer->drawLinear(frame).value();
  int grass = 0, through = 0;
  for (int x = 0; x < picture.width; ++x) {
    bool under = false;
    int edge = 0;  // pixels of an outline are part sky
    for (int y = 0; y < picture.height; ++y) {
      const glm::vec3 seen = picture.rgb(x, y);
      const bool red = seen.r > 6.0f * seen.g;
      under = under || red;
      edge = under ? edge + 1 : 0;
      grass += red ? 1 : 0;
      through += edge > 3 && !red ? 1 : 0;
    }
  }
  EXPECT_GT(grass, 6000);
  EXPECT_EQ(through, 0);
}

TEST(Texels, LightingThemEndsWhenItIsAskedTo) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(30.0, 40.0), 5.0);
  ASSERT_TRUE(stage.renderer->setGround(layerOf(4, 10.0f, glm::vec3(0.3f))).ok());
  std::stop_source stop;
  stop.request_stop();
  stage.renderer->setStop(stop.get_token());
  const auto drawn = stage.renderer->drawLinear(downFrame(1));
  ASSERT_FALSE(drawn.ok());
  EXPECT_EQ(drawn.error().kind, ErrorKind::Cancelled);
  stage.renderer->setStop({});
  EXPECT_TRUE(stage.renderer->drawLinear(downFrame(1)).ok());
}

TEST(Texels, SaySoWhenTheyAreAskedForWhatOnlyLayersHave) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(30.0, 40.0), 5.0);
  ASSERT_TRUE(stage.renderer->setGround(layerOf(4, 10.0f, glm::vec3(0.3f))).ok());
  render::Frame frame = downFrame(1);
  frame.mode.quantity = render::ViewQuantity::Coverage;
  EXPECT_FALSE(stage.renderer->drawLinear(frame).ok());
  render::Frame layers = downFrame(1);
  layers.options.method = render::GroundMethod::March;
  EXPECT_FALSE(stage.renderer->drawLinear(layers).ok());
  ASSERT_TRUE(stage.renderer->setGround(testing::makeGround(testing::smallOptions())).ok());
  EXPECT_FALSE(stage.renderer->drawLinear(downFrame(1)).ok());
  EXPECT_TRUE(stage.renderer->drawLinear(layers).ok());
}

}  // namespace
}  // namespace sward
