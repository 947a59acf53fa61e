#include "render/fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward {
namespace {

using testing::frameOf;
using testing::makeGround;
using testing::makeStage;
using testing::smallOptions;

glm::dvec3 meanOf(const image::Image& picture) {
  glm::dvec3 sum(0.0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) sum += glm::dvec3(picture.rgb(x, y));
  return sum / static_cast<double>(picture.width * picture.height);
}

/// Mean green of a picture of an even medium over grey soil.
double greenOver(render::Renderer& renderer, double coverage, double soil, const render::Frame& frame) {
  auto options = smallOptions();
  options.basis = lpt::Basis::Ptm;
  options.evenCoverage = coverage;
  options.soilReflectance = soil;
  EXPECT_TRUE(renderer.setGround(makeGround(options)).ok());
  const auto picture = renderer.drawLinear(frame);
  EXPECT_TRUE(picture.ok());
  return meanOf(*picture).g;
}

/// Transmittance of the medium: what soil shines through, against soil that lies bare.
double transmittance(render::Renderer& renderer, double coverage, const render::Frame& frame) {
  const double bare = greenOver(renderer, 1e-6, 0.6, frame) - greenOver(renderer, 1e-6, 0.1, frame);
  const double through = greenOver(renderer, coverage, 0.6, frame) - greenOver(renderer, coverage, 0.1, frame);
  EXPECT_GT(bare, 0.01);
  return through / bare;
}

double storedCoverage(double coverage) {
  return std::round(coverage * 255.0) / 255.0;
}

constexpr double kOpaque = 0.985;  // of shaders/include/layout.glsl

TEST(March, AnEvenMediumLetsThroughWhatBeerAndLambertSay) {
  auto stage = makeStage();
  stage.renderer->setDaylight(testing::daylightAt(180.0, 50.0), 0.0);
  const auto options = smallOptions();
  const double coverage = 20.0 / 255.0;
  const double slab = options.heightM / options.layers;
  const double perM = -std::log1p(-coverage) / slab;
  const double bladeSlab = options.patchSideM / options.blades;
  const double bladePerM = -std::log1p(-kOpaque * storedCoverage(-std::expm1(-perM * bladeSlab))) / bladeSlab;
  const double slicePerM = -std::log1p(-kOpaque * storedCoverage(coverage)) / slab;
  // Straight down slices, at 45 and 20 degrees blades. Narrow lenses, so that one angle stands for the picture; from
  // far enough that places differ, since whole slabs are crossed.
  const glm::dvec3 target(0.3, 0.2, 0.0);
  for (const double elevationDeg : {90.0, 45.0, 20.0}) {
    const double elevation = elevationDeg * 3.14159265358979 / 180.0;
    const glm::dvec3 toEye(0.3 * std::cos(elevation), -std::sqrt(0.91) * std::cos(elevation), std::sin(elevation));
    const auto frame = frameOf(target + 30.0 * toEye, target, 96, 96, 4, 400.0);
    const double expected =
        std::exp(-(elevationDeg > 80.0 ? slicePerM : bladePerM) * options.heightM / std::sin(elevation));
    // 8-bit soil: 2 x 0.5/255 of its root on either side; slabs cut whole and the quick power add to it.
    EXPECT_NEAR(transmittance(*stage.renderer, coverage, frame), expected, 0.03 * expected + 0.004) << elevationDeg;
  }
}

/// Paints every texel of a stack's image, fully covered.
void paint(lpt::LayerStack& stack, int image, const glm::ivec3& root) {
  const auto perImage = stack.surface.size() / static_cast<std::size_t>(stack.images);
  for (std::size_t i = 0; i < perImage; i += 4) {
    std::uint8_t* texel = stack.surface.data() + static_cast<std::size_t>(image) * perImage + i;
    for (int c = 0; c < 3; ++c) texel[c] = static_cast<std::uint8_t>(root[c]);
    texel[3] = 255;
  }
  for (std::uint8_t& byte : stack.transmission) byte = 0;
}

glm::ivec3 tileColour(int tile) {
  return {60 + 60 * (tile % 2), 60 + 60 * (tile / 2), 100};
}

TEST(March, StraightDownShowsTheMapsTilesWhereTheyBelong) {
  auto options = smallOptions();
  options.evenCoverage = 0.5;
  auto ground = testing::syntheticGround(options);
  for (int tile = 0; tile < 4; ++tile) paint(ground.slices, tile, tileColour(tile));
  auto stage = makeStage();
  const auto daylight = testing::daylightAt(150.0, 60.0);
  const auto shared = std::make_shared<const bake::GroundBake>(ground);
  ASSERT_TRUE(stage.renderer->setGround(shared).ok());
  stage.renderer->setDaylight(daylight, 0.0);
  const glm::dvec3 eye(1.13, -0.57, 20.0);
  const auto frame = frameOf(eye, {eye.x, eye.y, 0.0}, 128, 96, 1, 360.0);
  const auto picture = stage.renderer->drawLinear(frame);
  ASSERT_TRUE(picture.ok()) << picture.error().text();

  const double side = ground.tileSideM(), scale = stage.renderer->relightScale();
  const auto light = testing::illuminationOf(daylight);
  const double top = options.heightM * (1.0 - 0.5 / options.layers);  // the first slice's middle
  std::array<int, 4> seen{};
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const glm::dvec3 d = frame.camera.rayDirection((x + 0.5) / frame.width, (y + 0.5) / frame.height, 128.0 / 96.0);
      const glm::dvec3 at = (eye + d * ((eye.z - top) / -d.z)) / side;
      const glm::dvec2 within(at.x - std::floor(at.x), at.y - std::floor(at.y));
      // The filter may reach over a tile's edge.
      if (std::min({within.x, within.y, 1.0 - within.x, 1.0 - within.y}) < 0.1) continue;
      const int column = (static_cast<int>(std::floor(at.x)) + options.mapSide / 2) % options.mapSide;
      const int row = (static_cast<int>(std::floor(at.y)) + options.mapSide / 2) % options.mapSide;
      const int tile = ground.map.tiles[static_cast<std::size_t>(row * options.mapSide + column)];
      ++seen[static_cast<std::size_t>(tile)];
      const glm::vec4 expected = lpt::relitTexel(ground.slices, tile, 0, 20, 20, light);
      for (int c = 0; c < 3; ++c) {
        const double value = static_cast<double>(expected[c]);
        ASSERT_NEAR(static_cast<double>(picture->at(x, y, c)), value, testing::storageBound(value, scale))
            << x << ' ' << y << " tile " << tile;
      }
    }
  }
  for (const int count : seen) EXPECT_GT(count, 100);
}

TEST(March, BladesShowTheSideThatFacesTheEye) {
  auto options = smallOptions();
  options.evenCoverage = 0.5;
  auto ground = testing::syntheticGround(options);
  const std::array<glm::ivec3, 4> colours{{{160, 20, 20}, {20, 160, 20}, {20, 20, 160}, {160, 160, 20}}};
  for (std::size_t side = 0; side < 4; ++side) paint(ground.blades[side], 0, colours[side]);
  auto stage = makeStage();
  const auto daylight = testing::daylightAt(150.0, 60.0);
  ASSERT_TRUE(stage.renderer->setGround(std::make_shared<const bake::GroundBake>(ground)).ok());
  stage.renderer->setDaylight(daylight, 0.0);
  const std::array<glm::dvec3, 4> eyes{{{5, 0.4, 0.8}, {-5, 0.4, 0.8}, {0.4, 5, 0.8}, {0.4, -5, 0.8}}};
  for (std::size_t side = 0; side < 4; ++side) {
    // So long a lens that every ray is within the three degrees of the axis where the other family has no weight.
    const auto frame = frameOf(eyes[side], {0.4, 0.4, 0.1}, 48, 32, 2, 500.0);
    const auto picture = stage.renderer->drawLinear(frame);
    ASSERT_TRUE(picture.ok());
    const glm::dvec3 mean = meanOf(*picture);
    const glm::vec4 expected = lpt::relitTexel(ground.blades[side], 0, 1, 5, 5, testing::illuminationOf(daylight));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(mean[c], static_cast<double>(expected[c]), 0.05 * static_cast<double>(expected[c]) + 0.002)
          << side << ' ' << c;
  }
}

TEST(March, BladesStandOnTheGroundAndEndBelowTheTop) {
  // Blade texels covered in the lower half only: from the side, sky above half the height, grass below.
  auto options = smallOptions();
  options.evenCoverage = 0.5;
  auto ground = testing::syntheticGround(options);
  for (lpt::LayerStack& stack : ground.blades) {
    paint(stack, 0, {120, 120, 20});
    const std::size_t row = static_cast<std::size_t>(stack.width);
    for (std::size_t i = 0; i < stack.texelCount(); ++i)
      if (i / row % static_cast<std::size_t>(stack.height) >= static_cast<std::size_t>(stack.height) / 2)
        stack.surface[i * 4 + 3] = 0;
  }
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(std::make_shared<const bake::GroundBake>(ground)).ok());
  stage.renderer->setDaylight(testing::daylightAt(150.0, 60.0), 0.0);
  const double middle = 0.5 * options.heightM;
  const auto frame = frameOf({0.2, -3.0, middle}, {0.2, 0.0, middle}, 32, 32, 4, 60.0);
  const auto picture = stage.renderer->drawLinear(frame);
  ASSERT_TRUE(picture.ok());
  for (int x = 0; x < 32; ++x) {
    EXPECT_GT(picture->at(x, 2, 2), picture->at(x, 2, 1) * 0.8f) << "sky above";
    EXPECT_LT(picture->at(x, 30, 2), picture->at(x, 30, 1) * 0.3f) << "grass below";
  }
}

bool finite(const image::Image& picture) {
  return std::all_of(picture.pixels.begin(), picture.pixels.end(),
                     [](float v) { return std::isfinite(v) && v >= 0.0f; });
}

TEST(March, NoViewGivesAPixelThatIsNotANumber) {
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  const std::array<std::pair<glm::dvec3, glm::dvec3>, 9> views{{{{0, 0, 3}, {0, 0, 0}},
                                                                {{0, 0, 1.7}, {0, 9, 1.7}},
                                                                {{0, 0, 0.1}, {1, 1, 0.1}},
                                                                {{0, 0, 0.1}, {0, 0, 4}},
                                                                {{0, 0, 0}, {3, 0, 0}},
                                                                {{0, 0, -2}, {3, 0, 1}},
                                                                {{0, 0, 0.3}, {-4, 0, 0.3}},
                                                                {{1e5, -3e5, 500}, {1e5, -2e5, 0}},
                                                                {{0, 0, 2}, {0, 0, 9}}}};
  for (const double elevation : {35.0, 0.0, -10.0, 90.0}) {
    stage.renderer->setDaylight(testing::daylightAt(10.0, elevation));
    for (const auto& [eye, target] : views) {
      for (const auto method :
           {render::GroundMethod::March, render::GroundMethod::BlendedNormalised, render::GroundMethod::BlendedPaper}) {
        auto frame = frameOf(eye, target, 40, 30, 1, 14.0);
        frame.options.method = method;
        frame.options.macroVariation = 0.3;
        const auto picture = stage.renderer->drawDisplay(frame);
        ASSERT_TRUE(picture.ok()) << picture.error().text();
        EXPECT_TRUE(finite(*picture)) << eye.x << ' ' << eye.z << ' ' << elevation;
      }
    }
  }
}

TEST(March, SubPixelMotionFarAwayChangesNothing) {
  constexpr double kShimmer = 0.06;  // of the mean; texels of the finest level, unfiltered, give 0.3
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  stage.renderer->setDaylight(testing::daylightAt(120.0, 35.0));
  // From 100 m on, a pixel covers 7 cm and more: a quarter of a tile.
  const auto at = [&](double shift) {
    auto frame = frameOf({shift, -100.0, 12.0}, {shift, 0.0, 1.0}, 160, 96, 8, 50.0);
    const auto picture = stage.renderer->drawLinear(frame);
    EXPECT_TRUE(picture.ok());
    return *picture;
  };
  const image::Image still = at(0.0), moved = at(0.03);
  constexpr int kFirstRow = 48, kRows = 48;  // under the horizon
  double squares = 0.0, meanStill = 0.0, meanMoved = 0.0;
  for (int y = kFirstRow; y < kFirstRow + kRows; ++y) {
    for (int x = 0; x < still.width; ++x) {
      const double a = static_cast<double>(still.at(x, y, 1)), b = static_cast<double>(moved.at(x, y, 1));
      squares += (a - b) * (a - b);
      meanStill += a;
      meanMoved += b;
    }
  }
  const double pixels = static_cast<double>(kRows) * still.width;
  EXPECT_GT(meanStill, 0.0);
  EXPECT_NEAR(meanMoved / meanStill, 1.0, 0.003);
  // What is left is the noise of eight samples a pixel.
  EXPECT_LT(std::sqrt(squares / pixels) / (meanStill / pixels), kShimmer);
}

TEST(March, TheGroundReachesTheHorizonWithoutAnEdge) {
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  stage.renderer->setDaylight(testing::daylightAt(120.0, 35.0), 0.0);
  // The map is 16 m wide here: rows just under the horizon lie far beyond it, and are as green as those above the map.
  const auto frame = frameOf({0.0, 0.0, 4.0}, {0.0, 100.0, 0.0}, 64, 64, 8, 35.0);
  const auto picture = stage.renderer->drawLinear(frame);
  ASSERT_TRUE(picture.ok());
  const auto row = [&](int y) {
    double sum = 0.0;
    for (int x = 0; x < 64; ++x) sum += static_cast<double>(picture->at(x, y, 1));
    return sum / 64.0;
  };
  // The horizon lies 4 % of the distance, about 2.5 rows, above the middle.
  for (int y = 33; y < 44; ++y) EXPECT_NEAR(row(y) / row(y + 1), 1.0, 0.1) << y;
}

TEST(March, ContextsAgree) {
  const auto ground = makeGround(smallOptions());
  std::array<image::Image, 2> pictures;
  for (std::size_t i = 0; i < 2; ++i) {
    auto stage = makeStage(i == 0 ? gpu::Device::Egl : gpu::Device::OsMesa);
    ASSERT_TRUE(stage.renderer->setGround(ground).ok());
    stage.renderer->setDaylight(testing::daylightAt(230.0, 30.0));
    const auto picture = stage.renderer->drawDisplay(frameOf({0.1, -3.0, 1.5}, {0.1, 0.0, 0.2}, 160, 90, 4));
    ASSERT_TRUE(picture.ok()) << picture.error().text();
    pictures[i] = *picture;
  }
  // A rounding may send a few rays to another texel; all others agree to a step of 8 bits.
  std::size_t apart = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i) {
    const double difference = std::abs(static_cast<double>(pictures[0].pixels[i]) - pictures[1].pixels[i]);
    sum += difference;
    if (difference > 1.0 / 255.0) ++apart;
  }
  EXPECT_LT(sum / static_cast<double>(pictures[0].pixels.size()), 0.5 / 255.0);
  EXPECT_LT(apart, pictures[0].pixels.size() / 50);
}

TEST(March, PicturesAreTheSameEachTime) {
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  stage.renderer->setDaylight(testing::daylightAt(230.0, 30.0));
  const auto frame = frameOf({0.1, -3.0, 1.5}, {0.1, 0.0, 0.2}, 100, 70, 3);
  const auto first = stage.renderer->drawLinear(frame), second = stage.renderer->drawLinear(frame);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->pixels, second->pixels);
}

TEST(March, TheSunMakesThePictureBrighterAndItsDiscShows) {
  auto stage = makeStage();
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  const auto down = frameOf({0.1, 0.1, 3.0}, {0.1, 0.1, 0.0}, 40, 30, 2);
  stage.renderer->setDaylight(testing::daylightAt(180.0, 60.0), 0.0);
  const double day = meanOf(stage.renderer->drawLinear(down).value()).g;
  const auto toSun = scene::directionFromAngles({180.0, 30.0});
  stage.renderer->setDaylight(testing::daylightAt(180.0, 30.0), 0.0);
  const auto sky = stage.renderer->drawLinear(frameOf({0, 0, 2}, glm::dvec3(0, 0, 2) + toSun, 33, 33, 1, 200.0));
  ASSERT_TRUE(sky.ok());
  EXPECT_GT(sky->at(16, 16, 1), 20.0f * sky->at(2, 2, 1));
  stage.renderer->setDaylight(testing::daylightAt(180.0, -8.0), 0.0);
  const double night = meanOf(stage.renderer->drawLinear(down).value()).g;
  EXPECT_GT(day, 10.0 * night);
}

TEST(March, BadFramesAreRefused) {
  auto stage = makeStage();
  const auto good = frameOf({0, 0, 3}, {0, 0, 0}, 8, 8, 1);
  EXPECT_FALSE(stage.renderer->drawLinear(good).ok()) << "nothing to draw yet";
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  EXPECT_FALSE(stage.renderer->drawLinear(good).ok()) << "no daylight yet";
  stage.renderer->setDaylight(testing::daylightAt(180.0, 30.0));
  EXPECT_TRUE(stage.renderer->drawLinear(good).ok());
  auto frame = good;
  frame.width = 0;
  EXPECT_FALSE(stage.renderer->drawLinear(frame).ok());
  frame = good;
  frame.height = 1000000;
  EXPECT_FALSE(stage.renderer->drawLinear(frame).ok());
  frame = good;
  frame.options.samples = 0;
  EXPECT_FALSE(stage.renderer->drawLinear(frame).ok());
  frame = good;
  frame.camera.position.x = std::nan("");
  EXPECT_FALSE(stage.renderer->drawLinear(frame).ok());
  frame = good;
  frame.exposure = std::nan("");
  EXPECT_FALSE(stage.renderer->drawLinear(frame).ok());
}

}  // namespace
}  // namespace sward
