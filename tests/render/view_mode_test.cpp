// View modes against grounds whose quantities are known.
#include "render/fixture.h"

#include "image/bytes.h"
#include "image/colour.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace sward {
namespace {

using render::ViewMode;
using render::ViewQuantity;
using testing::frameOf;
using testing::makeStage;
using testing::smallOptions;

/// What a mode shows in the middle of a picture: the stored value (over its share of ground) and the colour.
struct Shown {
  glm::dvec3 value{0.0};
  glm::ivec3 colour{0};
};

class Modes : public ::testing::Test {
 protected:
  Modes() : m_stage(makeStage()) { setSun(150.0, 50.0); }

  void setSun(double azimuthDeg, double elevationDeg) {
    m_daylight = testing::daylightAt(azimuthDeg, elevationDeg);
    m_stage.renderer->setDaylight(*m_daylight, 0.0);
  }
  void setGround(const bake::GroundBake& ground) {
    m_ground = std::make_shared<const bake::GroundBake>(ground);
    ASSERT_TRUE(m_stage.renderer->setGround(m_ground).ok());
  }
  render::Renderer& renderer() { return *m_stage.renderer; }
  const bake::GroundBake& ground() const { return *m_ground; }
  lpt::Illumination light() const { return testing::illuminationOf(*m_daylight); }

  /// Straight down where slices are drawn, along y where blades are. Sub-pixel samples stay off, so that every pixel is
  /// one texel's.
  static render::Frame down() { return frameOf({0.3, 0.2, 20.0}, {0.3, 0.2, 0.0}, 32, 32, 1, 400.0); }
  static render::Frame across() { return frameOf({0.3, -6.0, 1.0}, {0.3, 0.2, 0.12}, 32, 32, 1, 400.0); }

  Shown show(render::Frame frame, const ViewMode& mode) {
    frame.mode = mode;
    Shown shown;
    const auto linear = renderer().drawLinear(frame);
    const auto display = renderer().drawDisplay(frame);
    EXPECT_TRUE(linear.ok() && display.ok()) << linear.error().text();
    if (!linear.ok() || !display.ok()) return shown;
    for (int c = 0; c < 3; ++c) {
      shown.value[c] = static_cast<double>(linear->at(16, 16, c));
      shown.colour[c] = image::toByte(display->at(16, 16, c));
    }
    return shown;
  }

 private:
  testing::Stage m_stage;
  std::optional<scene::Daylight> m_daylight;
  std::shared_ptr<const bake::GroundBake> m_ground;
};

ViewMode modeOf(ViewQuantity quantity) {
  ViewMode mode;
  mode.quantity = quantity;
  return mode;
}

/// So dense that nothing shines through.
testing::SyntheticOptions dense() {
  auto options = smallOptions();
  options.evenCoverage = 0.95;
  return options;
}

TEST_F(Modes, AlbedoIsTheReflectanceUnlit) {
  auto options = dense();
  setGround(testing::syntheticGround(options));
  const glm::dvec3 expected(0.2, 0.3, 0.1);  // of the synthetic medium
  for (const double elevation : {50.0, -20.0}) {
    setSun(150.0, elevation);
    for (render::Frame frame : {down(), across()}) {
      for (const auto method : {render::GroundMethod::March, render::GroundMethod::BlendedNormalised}) {
        frame.options.method = method;
        frame.exposure = 7.0;  // of no effect
        const Shown shown = show(frame, modeOf(ViewQuantity::Albedo));
        for (int c = 0; c < 3; ++c) {
          // Rounded to bytes of its root in the stack, and once more relit.
          EXPECT_NEAR(shown.value[c], expected[c], 2.0 * testing::storageBound(expected[c], 1.0)) << elevation;
          EXPECT_NEAR(shown.colour[c], image::srgbFromLinear(static_cast<float>(expected[c])) * 255.0f, 2.0);
        }
      }
    }
  }
}

/// Response of a texel to the sun, as the CPU relights white leaves that let nothing through.
double responseOf(lpt::LayerStack stack, int layer, const glm::dvec3& sun) {
  std::fill(stack.surface.begin(), stack.surface.end(), std::uint8_t{255});
  stack.transmission.clear();
  return static_cast<double>(
      lpt::relitTexel(stack, 0, layer, 12, 12, {sun, glm::dvec3(std::numbers::pi), glm::dvec3(0.0)}).g);
}

TEST_F(Modes, LuminanceIsTheResponseToTheSunWhateverTheColour) {
  for (const auto basis : {lpt::Basis::Lpt, lpt::Basis::Ptm, lpt::Basis::Constant}) {
    auto options = dense();
    options.basis = basis;
    setGround(testing::syntheticGround(options));
    for (const double azimuth : {30.0, 200.0}) {
      setSun(azimuth, 40.0);
      const double expected = responseOf(ground().slices, 0, light().sunDirection);
      EXPECT_GT(expected, 0.1);
      const Shown shown = show(down(), modeOf(ViewQuantity::Luminance));
      EXPECT_NEAR(shown.value.r, expected, testing::storageBound(expected, 1.0)) << azimuth;
      EXPECT_NEAR(shown.colour.r, image::srgbFromLinear(static_cast<float>(expected)) * 255.0f, 2.0);
      EXPECT_EQ(shown.colour.r, shown.colour.b);
    }
    setSun(30.0, -5.0);
    EXPECT_EQ(show(down(), modeOf(ViewQuantity::Luminance)).colour, glm::ivec3(0)) << "night";
  }
}

TEST_F(Modes, CoverageRunsFromBareGroundToNothingSeenThrough) {
  auto options = smallOptions();
  options.basis = lpt::Basis::Ptm;
  options.evenCoverage = 1e-6;
  setGround(testing::syntheticGround(options));
  EXPECT_EQ(show(down(), modeOf(ViewQuantity::Coverage)).colour, glm::ivec3(0));
  options.evenCoverage = 0.95;
  setGround(testing::syntheticGround(options));
  EXPECT_EQ(show(down(), modeOf(ViewQuantity::Coverage)).colour, glm::ivec3(255));
  options.evenCoverage = 20.0 / 255.0;
  setGround(testing::syntheticGround(options));
  // A texel of full coverage lets 1 - 0.985 through (shaders/include/layout.glsl).
  const double expected = 1.0 - std::pow(1.0 - 0.985 * options.evenCoverage, options.layers);
  const Shown shown = show(down(), modeOf(ViewQuantity::Coverage));
  EXPECT_NEAR(shown.value.r, expected, 0.01);
  EXPECT_NEAR(shown.colour.r, 255.0 * expected, 3.0);
}

/// Leaves one layer bare, and paints every layer in a grey of its own.
bake::GroundBake layered(int bareLayer) {
  auto options = smallOptions();
  options.evenCoverage = 0.6;
  auto ground = testing::syntheticGround(options);
  lpt::LayerStack& stack = ground.slices;
  const auto area = static_cast<std::size_t>(stack.width) * static_cast<std::size_t>(stack.height);
  for (std::size_t texel = 0; texel < stack.texelCount(); ++texel) {
    const int layer = static_cast<int>(texel / area) % stack.layers;
    for (std::size_t c = 0; c < 3; ++c) stack.surface[4 * texel + c] = static_cast<std::uint8_t>(100 + 15 * layer);
    if (layer == bareLayer) stack.surface[4 * texel + 3] = 0;
  }
  return ground;
}

TEST_F(Modes, OneLayerAloneHidesAllOthersAndTheSoil) {
  constexpr int kBare = 2;
  setGround(layered(kBare));
  for (const auto quantity : {ViewQuantity::Shaded, ViewQuantity::Albedo, ViewQuantity::Luminance}) {
    ViewMode mode = modeOf(quantity);
    mode.layer = kBare;
    const auto backdrop = render::backdropOf(mode);
    for (const render::Frame& frame : {down(), across()})
      EXPECT_EQ(show(frame, mode).colour, glm::ivec3(backdrop[0], backdrop[1], backdrop[2])) << "nothing is there";
  }
  for (const int layer : {0, 1, 3, 7}) {
    ViewMode mode = modeOf(ViewQuantity::Albedo);
    mode.layer = layer;
    const double root = (100 + 15 * layer) / 255.0;
    const double share = 0.985 * 0.6;
    const Shown shown = show(down(), mode);
    EXPECT_NEAR(shown.value.g, share * root * root, 0.015) << layer;
  }
}

TEST_F(Modes, CoefficientsShowTheirSign) {
  for (const auto basis : {lpt::Basis::Lpt, lpt::Basis::Ptm}) {
    auto options = dense();
    options.basis = basis;
    setGround(testing::syntheticGround(options));
    // The synthetic response: the first is -a / 10 of the reflected level a, the last a itself; a = 1/2 where lit
    // fully.
    const int last = lpt::stackCoefficients(basis) - 1;
    for (const auto channel : {render::ResponseChannel::Reflected, render::ResponseChannel::Transmitted}) {
      const double level = channel == render::ResponseChannel::Reflected ? 0.5 : 0.3;
      for (const auto& [coefficient, expected] : {std::pair{0, -0.05}, std::pair{last, level}}) {
        ViewMode mode = modeOf(ViewQuantity::Coefficient);
        mode.coefficient = coefficient;
        mode.channel = channel;
        const double range = render::coefficientRange(ground(), channel, coefficient);
        EXPECT_NEAR(range, std::abs(expected), 1e-3);
        const Shown shown = show(down(), mode);
        EXPECT_NEAR(shown.value.r, 0.5 + 0.5 * expected / range, testing::storageBound(1.0, 1.0) + 2e-3) << coefficient;
        const auto stops = render::legendOf(mode, ground()).stops;
        const auto& end = expected < 0.0 ? stops.front().colour : stops.back().colour;
        EXPECT_NEAR(shown.colour.r, end[0], 8) << coefficient;
        EXPECT_NEAR(shown.colour.b, end[2], 8) << coefficient;
      }
    }
    ViewMode beyond = modeOf(ViewQuantity::Coefficient);
    beyond.coefficient = last + 1;
    render::Frame frame = down();
    frame.mode = beyond;
    EXPECT_FALSE(renderer().drawDisplay(frame).ok());
  }
}

bake::StackInspection inspected(const lpt::LayerStack& stack, std::uint8_t condition, std::uint8_t visibility) {
  bake::StackInspection out;
  out.condition.assign(stack.columnCount(), condition);
  out.rank.assign(stack.columnCount(), 10);
  out.weight.assign(stack.columnCount(), 1.0f);
  out.visibility.assign(stack.texelCount(), visibility);
  return out;
}

TEST_F(Modes, VisibilityAndConditionComeFromTheInspection) {
  setGround(testing::syntheticGround(dense()));
  render::Frame frame = down();
  for (const auto quantity : {ViewQuantity::Visibility, ViewQuantity::Condition}) {
    frame.mode = modeOf(quantity);
    const auto refused = renderer().drawDisplay(frame);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().text().find("inspection"), std::string::npos);
  }
  bake::Inspection inspection;
  inspection.slices = inspected(ground().slices, 200, 90);
  inspection.soil = inspected(ground().soil, 1, 1);
  for (std::size_t side = 0; side < 4; ++side) inspection.blades[side] = inspected(ground().blades[side], 60, 230);
  ASSERT_TRUE(renderer().setInspection(inspection).ok());
  const auto expect = [&](const render::Frame& from, ViewQuantity quantity, double byte) {
    const double value = byte / 255.0;
    EXPECT_NEAR(show(from, modeOf(quantity)).value.r, value, testing::storageBound(value, 1.0));
  };
  expect(down(), ViewQuantity::Visibility, 90);
  expect(down(), ViewQuantity::Condition, 200);
  expect(across(), ViewQuantity::Visibility, 230);
  expect(across(), ViewQuantity::Condition, 60);
  inspection.slices.condition.pop_back();
  EXPECT_FALSE(renderer().setInspection(inspection).ok()) << "of another ground";
  setGround(testing::syntheticGround(dense()));
  frame.mode = modeOf(ViewQuantity::Visibility);
  EXPECT_FALSE(renderer().drawDisplay(frame).ok()) << "the inspection of the ground before";
}

struct Cell {
  int tile;
  glm::dvec2 within;  ///< of the cell, from its south-west
};

/// The cell that a pixel of a straight-down picture shows at a height.
Cell cellAt(const bake::GroundBake& ground, const render::Frame& frame, int x, int y, double heightM) {
  const double aspect = static_cast<double>(frame.width) / frame.height;
  const glm::dvec3 d = frame.camera.rayDirection((x + 0.5) / frame.width, (y + 0.5) / frame.height, aspect);
  const glm::dvec3 at = (frame.camera.position + d * ((frame.camera.position.z - heightM) / -d.z)) / ground.tileSideM();
  const glm::ivec2 cell(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
  const int column = (cell.x + ground.map.width / 2) % ground.map.width;
  const int row = (cell.y + ground.map.height / 2) % ground.map.height;
  return {ground.map.tiles[static_cast<std::size_t>(row * ground.map.width + column)],
          {at.x - std::floor(at.x), at.y - std::floor(at.y)}};
}

TEST_F(Modes, TilesHaveTheirColoursWhereTheyLie) {
  auto options = dense();
  setGround(testing::syntheticGround(options));
  render::Frame frame = frameOf({1.13, -0.57, 20.0}, {1.13, -0.57, 0.0}, 160, 120, 1, 360.0);
  frame.mode = modeOf(ViewQuantity::Tiles);
  const auto picture = renderer().drawDisplay(frame);
  ASSERT_TRUE(picture.ok());
  std::array<int, 4> seen{};
  int borders = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const auto [tile, within] = cellAt(ground(), frame, x, y, 0.5 * options.heightM);
      const double edge = std::min({within.x, within.y, 1.0 - within.x, 1.0 - within.y});
      const glm::vec3 linear = image::linearFromSrgb(glm::vec3(picture->rgb(x, y)));
      if (edge < 0.004) {
        EXPECT_GT(std::min({linear.r, linear.g, linear.b}), 0.5f) << "a border is white";
        ++borders;
      }
      const glm::dvec2 fromMiddle = glm::abs(within - 0.5);
      if (edge < 0.1 || std::max(fromMiddle.x, fromMiddle.y) < 0.3) continue;
      ++seen[static_cast<std::size_t>(tile)];
      const glm::vec3 expected = render::tileColour(tile);
      const float brightness =
          std::max({linear.r, linear.g, linear.b}) / std::max({expected.r, expected.g, expected.b});
      EXPECT_GT(brightness, 0.1f);
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(linear[c], brightness * expected[c], 0.02f) << tile;
    }
  }
  for (const int count : seen) EXPECT_GT(count, 100);
  EXPECT_GT(borders, 50);
}

/// Where a cell's number is white, on a raster of cells of its digits; asked pixel by pixel.
std::set<int> inkOf(const bake::GroundBake& ground, const render::Frame& frame, const image::Image& picture,
                    double heightM, const glm::ivec2& middle, double pixelsATile) {
  std::set<int> ink;
  const int reach = static_cast<int>(0.25 * pixelsATile);
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const glm::dvec2 within = cellAt(ground, frame, x, y, heightM).within - 0.5;
      if (std::min({picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2)}) < 0.9f) continue;
      // Fifths of the label's height (0.26 of a tile), counted from the middle.
      const double cell = 0.26 / 5.0;
      ink.insert(static_cast<int>(std::floor(within.y / cell + 2.5)) * 16 +
                 static_cast<int>(std::floor(within.x / cell + 1.5)));
    }
  }
  return ink;
}

TEST_F(Modes, TilesCarryTheirNumbers) {
  auto options = dense();
  setGround(testing::syntheticGround(options));
  const double height = 0.5 * options.heightM, side = ground().tileSideM();
  // Rows of the digits from the bottom, columns from the left.
  const std::array<std::set<int>, 4> expected{{{0, 1, 2, 16, 18, 32, 34, 48, 50, 64, 65, 66},
                                               {0, 1, 2, 17, 33, 48, 49, 65},
                                               {0, 1, 2, 16, 32, 33, 34, 50, 64, 65, 66},
                                               {0, 1, 2, 18, 32, 33, 34, 50, 64, 65, 66}}};
  std::array<int, 4> found{};
  for (int cell = 0; cell < 12; ++cell) {
    const glm::dvec3 middle((cell % 4 + 0.5) * side, (cell / 4 + 0.5) * side, height);
    render::Frame frame = frameOf(middle + glm::dvec3(0.0, 0.0, 8.0), middle, 121, 121, 1, 800.0);
    frame.mode = modeOf(ViewQuantity::Tiles);
    const auto picture = renderer().drawDisplay(frame);
    ASSERT_TRUE(picture.ok());
    const double pixelsATile = side / (2.0 * frame.camera.tanHalfWidth * 8.0) * 121.0;
    ASSERT_GT(pixelsATile, 60.0);
    const int tile = cellAt(ground(), frame, 60, 60, height).tile;
    ++found[static_cast<std::size_t>(tile)];
    EXPECT_EQ(inkOf(ground(), frame, *picture, height, {60, 60}, std::min(pixelsATile, 240.0)),
              expected[static_cast<std::size_t>(tile)])
        << tile;
  }
  for (const int count : found) EXPECT_GT(count, 0);
}

TEST_F(Modes, TheSkyIsBackdrop) {
  setGround(testing::syntheticGround(dense()));
  const render::Frame up = frameOf({0.0, 0.0, 2.0}, {0.0, 5.0, 4.0}, 32, 32, 3, 50.0);
  for (const auto quantity : {ViewQuantity::Albedo, ViewQuantity::Coverage, ViewQuantity::Tiles}) {
    const auto backdrop = render::backdropOf(modeOf(quantity));
    EXPECT_EQ(show(up, modeOf(quantity)).colour, glm::ivec3(backdrop[0], backdrop[1], backdrop[2]));
  }
}

TEST_F(Modes, GoingBackToShadedGivesTheSamePicture) {
  setGround(testing::syntheticGround(smallOptions()));
  render::Frame frame = frameOf({0.2, -2.5, 1.1}, {0.2, 0.5, 0.1}, 64, 48, 3);
  const auto before = renderer().drawDisplay(frame);
  for (const auto quantity : {ViewQuantity::Albedo, ViewQuantity::Tiles, ViewQuantity::Coefficient}) {
    frame.mode = modeOf(quantity);
    const auto other = renderer().drawDisplay(frame);
    ASSERT_TRUE(other.ok());
    EXPECT_NE(other->pixels, before->pixels);
  }
  frame.mode = {};
  EXPECT_EQ(renderer().drawDisplay(frame)->pixels, before->pixels);
}

TEST_F(Modes, LayersThatAreNotThereAreRefused) {
  setGround(testing::syntheticGround(smallOptions()));
  render::Frame frame = down();
  frame.mode.layer = smallOptions().layers;
  const auto refused = renderer().drawDisplay(frame);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("layer 8"), std::string::npos);
}

TEST(Legend, BarsRunFromEndToEnd) {
  const auto ground = testing::syntheticGround(smallOptions());
  bake::Inspection inspection;
  inspection.conditions = {0.5, 2.5};
  for (int q = 0; q <= static_cast<int>(ViewQuantity::Tiles); ++q) {
    const ViewMode mode = modeOf(static_cast<ViewQuantity>(q));
    const render::Legend legend = render::legendOf(mode, ground, &inspection);
    EXPECT_EQ(legend.title.empty(), mode.quantity == ViewQuantity::Shaded);
    EXPECT_EQ(legend.stops.empty(), !mode.scalar());
    EXPECT_EQ(legend.swatches.size(), mode.quantity == ViewQuantity::Tiles ? 4u : 0u);
    if (legend.stops.empty()) continue;
    EXPECT_EQ(legend.stops.front().at, 0.0);
    EXPECT_EQ(legend.stops.back().at, 1.0);
    for (std::size_t i = 1; i < legend.stops.size(); ++i) EXPECT_GT(legend.stops[i].at, legend.stops[i - 1].at);
    EXPECT_EQ(legend.ticks.size(), 5u);
    EXPECT_LT(legend.low, legend.high);
  }
  const auto condition = render::legendOf(modeOf(ViewQuantity::Condition), ground, &inspection);
  EXPECT_EQ(condition.ticks.front().text, "3.16");
  EXPECT_EQ(condition.ticks.back().text, "316");
}

}  // namespace
}  // namespace sward
