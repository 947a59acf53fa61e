// A real meadow, from the template to the picture: what an eye would look for, measured.

#include "bake/bake.h"
#include "base/random.h"
#include "gpu/context.h"
#include "image/colour.h"
#include "project/project.h"
#include "render/renderer.h"
#include "scene/camera.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sward {
namespace {

constexpr int kTileTexels = 64;
constexpr int kTilesAcross = 14;
constexpr int kPixels = kTileTexels * kTilesAcross;

/// The meadow of the template, its blades and lights sampled coarsely so that it bakes in a few seconds.
project::Project coarseMeadow() {
  project::Project project = project::fromTemplate("meadow").value();
  project.sampling.bladeWidth = 256;
  project.sampling.bladeHeight = 32;
  project.sampling.blades = 8;
  project.sampling.visibilityDirections = 4;
  project.lights.count = 9;
  project.tiles.resolution = kTileTexels;
  project.tiles.mapWidth = project.tiles.mapHeight = 64;
  return project;
}

std::shared_ptr<const bake::GroundBake> meadowGround() {
  static const auto ground = [] {
    auto baked = bake::Baker().ground(coarseMeadow(), {});
    EXPECT_TRUE(baked.ok()) << baked.error().text();
    return baked.value();
  }();
  return ground;
}

/// The same tiles in an order that minds no edge.
std::shared_ptr<const bake::GroundBake> withUnmatchedTiles() {
  auto broken = std::make_shared<bake::GroundBake>(*meadowGround());
  base::Random random(3);
  for (std::uint8_t& tile : broken->map.tiles) {
    tile = static_cast<std::uint8_t>(random.index(static_cast<std::uint32_t>(broken->tiles.tiles.size())));
  }
  return broken;
}

image::Image draw(std::shared_ptr<const bake::GroundBake> ground, gpu::Device device, render::Frame frame,
                  const scene::Daylight& daylight) {
  auto context = gpu::Context::create(device);
  EXPECT_TRUE(context.ok()) << context.error().text();
  auto renderer = render::Renderer::create(**context);
  EXPECT_TRUE(renderer.ok()) << renderer.error().text();
  EXPECT_TRUE((*renderer)->setGround(std::move(ground)).ok());
  (*renderer)->setDaylight(daylight, 0.0);
  frame.exposure = daylight.autoExposure();
  auto picture = (*renderer)->drawLinear(frame);
  EXPECT_TRUE(picture.ok()) << picture.error().text();
  return std::move(picture).value();
}

/// Straight down from far above, one pixel a texel, tile borders on multiples of kTileTexels pixels.
image::Image drawPlan(std::shared_ptr<const bake::GroundBake> ground) {
  constexpr double kHeight = 400.0;
  const double side = ground->tileSideM() * kTilesAcross;
  scene::View view{"plan", {0.5 * side, 0.5 * side, kHeight}, {0.5 * side, 0.5 * side, 0.0}, 0.0, 0.0};
  view.focalLengthMm = scene::kSensorWidthMm * kHeight / side;
  render::Frame frame;
  frame.camera = scene::cameraFromView(view).value();
  frame.width = frame.height = kPixels;
  frame.options.samples = 16;
  frame.options.macroVariation = 0.0;
  frame.options.gridBendM = 0.0;
  return draw(std::move(ground), gpu::Device::Egl, frame,
              scene::Daylight(scene::directionFromAngles({230, 40}), {}, {}));
}

double grey(const image::Image& picture, int x, int y) {
  return static_cast<double>(image::luminance(picture.rgb(x, y)));
}

/// Mean step between neighbouring pixels by place within a tile, relative to their mean; the last place is the border.
std::vector<double> stepProfile(const image::Image& picture, bool vertical) {
  std::vector<double> steps(kTileTexels, 0.0), counts(kTileTexels, 0.0);
  for (int along = 0; along < kPixels; ++along) {
    for (int across = 0; across + 1 < kPixels; ++across) {
      const double a = vertical ? grey(picture, along, across) : grey(picture, across, along);
      const double b = vertical ? grey(picture, along, across + 1) : grey(picture, across + 1, along);
      steps[static_cast<std::size_t>(across % kTileTexels)] += std::abs(b - a);
      counts[static_cast<std::size_t>(across % kTileTexels)] += 1.0;
    }
  }
  double mean = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) mean += (steps[i] /= counts[i]) / kTileTexels;
  for (double& step : steps) step /= mean;
  return steps;
}

/// How many standard deviations of the other values the last one stands above their mean.
double lastStandsOut(std::vector<double> values) {
  const double last = values.back();
  values.pop_back();
  double mean = 0.0, square = 0.0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (const double value : values) square += (value - mean) * (value - mean) / static_cast<double>(values.size() - 1);
  return (last - mean) / std::sqrt(square);
}

TEST(Meadow, TileBordersCannotBeFound) {
  const image::Image matched = drawPlan(meadowGround());
  const image::Image unmatched = drawPlan(withUnmatchedTiles());
  double mean = 0.0;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) mean += grey(matched, x, y) / (kPixels * kPixels);
  }
  EXPECT_GT(mean, 0.01);  // there is a picture
  for (const bool vertical : {false, true}) {
    const std::vector<double> profile = stepProfile(matched, vertical);
    // A border is one place among 64, and places differ as plants happen to stand: three standard deviations.
    EXPECT_LT(lastStandsOut(profile), 3.0);
    // The same tiles without regard to their edges: only the borders change, and the measure sees it.
    std::vector<double> change = stepProfile(unmatched, vertical);
    for (std::size_t i = 0; i < change.size(); ++i) change[i] -= profile[i];
    RecordProperty(vertical ? "rows" : "columns", std::to_string(lastStandsOut(change)));
    EXPECT_GT(lastStandsOut(change), 4.0);
  }
}

render::Frame eyeHeightFrame() {
  render::Frame frame;
  frame.camera = scene::cameraFromView({"eye", {-3.0, -5.196, 1.3}, {0.0, 0.0, 0.8}, 35.0, 0.0}).value();
  frame.width = 320;
  frame.height = 180;
  frame.options.samples = 4;
  return frame;
}

TEST(Meadow, EglAndOsMesaDrawTheSamePicture) {
  const scene::Daylight daylight(scene::directionFromAngles({285, 34}), {}, {});
  const image::Image egl = draw(meadowGround(), gpu::Device::Egl, eyeHeightFrame(), daylight);
  const image::Image osmesa = draw(meadowGround(), gpu::Device::OsMesa, eyeHeightFrame(), daylight);
  ASSERT_EQ(egl.pixels.size(), osmesa.pixels.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < egl.pixels.size(); ++i) {
    sum += std::abs(static_cast<double>(egl.pixels[i]) - static_cast<double>(osmesa.pixels[i]));
  }
  // Both are Mesa's rasteriser, perhaps of another width: a ray at a texel's edge may round to its neighbour, which
  // moves a few samples in a hundred thousand.
  EXPECT_LT(sum / static_cast<double>(egl.pixels.size()), 1e-4);
}

TEST(Meadow, LeavesGlowAgainstTheLight) {
  // Looking north: a low sun ahead shines through the blades, which pass yellower light than they reflect.
  render::Frame frame = eyeHeightFrame();
  frame.camera = scene::cameraFromView({"north", {0.0, -5.0, 1.3}, {0.0, 0.0, 0.6}, 35.0, 0.0}).value();
  const auto meanGrass = [&](double azimuthDeg) {
    // Without the sky, whose blue share differs as the sun goes round.
    scene::SkyOptions dark;
    dark.intensity = 0.0;
    const scene::Daylight daylight(scene::directionFromAngles({azimuthDeg, 20}), {}, dark);
    const image::Image picture = draw(meadowGround(), gpu::Device::Egl, frame, daylight);
    glm::dvec3 sum(0.0);
    for (int y = picture.height * 2 / 3; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) sum += glm::dvec3(picture.rgb(x, y));
    }
    return sum;
  };
  const glm::dvec3 ahead = meanGrass(0.0);
  const glm::dvec3 behind = meanGrass(180.0);
  EXPECT_GT(ahead.g / ahead.b, 1.15 * behind.g / behind.b);
}

}  // namespace
}  // namespace sward
