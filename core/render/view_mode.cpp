#include "render/view_mode.h"

#include "bake/inspection.h"
#include "image/bytes.h"
#include "image/colour.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace sward::render {
namespace {

using Stops = std::vector<Legend::Stop>;

/// Grey by linear light, with enough stops that straight lines in sRGB follow its curve.
Stops lightStops() {
  Stops stops;
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i) {
    const double at = static_cast<double>(i * i) / (kSteps * kSteps);
    const std::uint8_t grey = image::toByte(image::srgbFromLinear(static_cast<float>(at)));
    stops.push_back({at, {grey, grey, grey}});
  }
  return stops;
}

/// Moreland's cool to warm (2009), made lighter in the middle: 0 is near white.
Stops divergingStops() {
  return {{0.0, {33, 62, 148}},     {0.125, {62, 108, 186}}, {0.25, {104, 154, 212}},
          {0.375, {163, 196, 228}}, {0.5, {244, 243, 240}},  {0.625, {240, 186, 156}},
          {0.75, {222, 127, 96}},   {0.875, {193, 65, 58}},  {1.0, {134, 16, 40}}};
}

/// After viridis (van der Walt and Smith 2015): lightness rises evenly.
Stops viridisStops() {
  return {{0.0, {68, 1, 84}},      {0.125, {71, 45, 123}},  {0.25, {59, 82, 139}},
          {0.375, {44, 114, 142}}, {0.5, {33, 145, 140}},   {0.625, {40, 174, 128}},
          {0.75, {94, 201, 98}},   {0.875, {173, 220, 48}}, {1.0, {253, 231, 37}}};
}

/// After inferno (the same): dark is well conditioned, glowing is not.
Stops infernoStops() {
  return {{0.0, {0, 0, 4}},        {0.125, {31, 12, 72}},   {0.25, {85, 15, 109}},
          {0.375, {136, 34, 106}}, {0.5, {186, 54, 85}},    {0.625, {227, 89, 51}},
          {0.75, {249, 140, 10}},  {0.875, {249, 201, 50}}, {1.0, {252, 255, 164}}};
}

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::vector<Legend::Tick> evenTicks(double low, double high, int count) {
  std::vector<Legend::Tick> ticks;
  for (int i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) / (count - 1);
    ticks.push_back({at, numberText(low + (high - low) * at)});
  }
  return ticks;
}

const char* channelName(ResponseChannel channel) {
  return channel == ResponseChannel::Reflected ? "reflected" : "transmitted";
}

Legend conditionLegend() {
  Legend legend{"Condition number of the fit", 0.0, bake::kConditionDecades, infernoStops(), {}, {}};
  for (int decade = 0; decade <= static_cast<int>(bake::kConditionDecades); ++decade)
    legend.ticks.push_back({decade / bake::kConditionDecades, numberText(std::pow(10.0, decade))});
  legend.ticks.back().text += " or more";
  return legend;
}

Legend tilesLegend(const bake::GroundBake& ground) {
  Legend legend;
  legend.title = "Tiles";
  for (int tile = 0; tile < static_cast<int>(ground.tiles.tiles.size()); ++tile) {
    const glm::vec3 colour = image::srgbFromLinear(tileColour(tile));
    legend.swatches.push_back(
        {std::to_string(tile), {image::toByte(colour.r), image::toByte(colour.g), image::toByte(colour.b)}});
  }
  return legend;
}

Legend quantityLegend(const ViewMode& mode, const bake::GroundBake& ground) {
  const auto bar = [](std::string title, double low, double high, Stops stops) {
    return Legend{std::move(title), low, high, std::move(stops), evenTicks(low, high, 5), {}};
  };
  switch (mode.quantity) {
    case ViewQuantity::Shaded:
      return {};
    case ViewQuantity::Albedo:
      return {"Albedo (linear reflectance)", 0.0, 1.0, {}, {}, {}};
    case ViewQuantity::Luminance:
      return bar(std::string("Luminance, ") + channelName(mode.channel), 0.0, 1.0, lightStops());
    case ViewQuantity::Coverage:
      return bar("Coverage", 0.0, 1.0, {{0.0, {0, 0, 0}}, {1.0, {255, 255, 255}}});
    case ViewQuantity::Coefficient: {
      const double range = coefficientRange(ground, mode.channel, mode.coefficient);
      return bar("Coefficient " + std::to_string(mode.coefficient) + ", " + channelName(mode.channel), -range, range,
                 divergingStops());
    }
    case ViewQuantity::Visibility:
      return bar("Visibility", 0.0, 1.0, viridisStops());
    case ViewQuantity::Condition:
      return conditionLegend();
    case ViewQuantity::Tiles:
      return tilesLegend(ground);
  }
  return {};
}

/// Largest absolute value that quantised coefficients may be read back as.
double largest(const lpt::CoefficientRange& range, int bits) {
  const double low = -static_cast<double>(range.base);
  const double high = range.scale > 0.0f ? ((1 << bits) - 1) / static_cast<double>(range.scale) + low : low;
  return std::max(std::abs(low), std::abs(high));
}

}  // namespace

bool ViewMode::scalar() const {
  switch (quantity) {
    case ViewQuantity::Luminance:
    case ViewQuantity::Coverage:
    case ViewQuantity::Coefficient:
    case ViewQuantity::Visibility:
    case ViewQuantity::Condition:
      return true;
    default:
      return false;
  }
}

Legend legendOf(const ViewMode& mode, const bake::GroundBake& ground) {
  Legend legend = quantityLegend(mode, ground);
  if (mode.layer < 0) return legend;
  const std::string layer = "layer " + std::to_string(mode.layer);
  legend.title = legend.title.empty() ? "Shaded, " + layer : legend.title + ", " + layer;
  return legend;
}

glm::vec3 tileColour(int tile) {
  constexpr float kGolden = 0.61803399f, kPale = 0.25f;
  glm::vec3 colour;
  for (int c = 0; c < 3; ++c) {
    const float third = static_cast<float>((3 - c) % 3) / 3.0f;
    const float shifted = static_cast<float>(tile) * kGolden + third;
    const float turn = (shifted - std::floor(shifted)) * 6.0f;
    colour[c] = kPale + (1.0f - kPale) * std::clamp(std::abs(turn - 3.0f) - 1.0f, 0.0f, 1.0f);
  }
  return colour;
}

double coefficientRange(const bake::GroundBake& ground, ResponseChannel channel, int coefficient) {
  double range = 0.0;
  const auto include = [&](const lpt::LayerStack& stack) {
    const auto index = static_cast<std::size_t>(static_cast<int>(channel) * stack.perColumn() + coefficient);
    if (index < stack.ranges.size()) range = std::max(range, largest(stack.ranges[index], stack.bits));
  };
  include(ground.slices);
  for (const lpt::LayerStack& blade : ground.blades) include(blade);
  return range > 0.0 ? range : 1.0;
}

Result<void> checkMode(const ViewMode& mode, const bake::GroundBake& ground) {
  const int layers = ground.slices.layers, coefficients = ground.slices.perColumn();
  if (mode.layer >= layers)
    return Error::badInput("there is no layer " + std::to_string(mode.layer), "view mode",
                           "Choose 0 to " + std::to_string(layers - 1) + ", or all of them.");
  if (mode.quantity == ViewQuantity::Coefficient && (mode.coefficient < 0 || mode.coefficient >= coefficients))
    return Error::badInput("the fit has no coefficient " + std::to_string(mode.coefficient), "view mode",
                           "Choose 0 to " + std::to_string(coefficients - 1) + ".");
  return {};
}

}  // namespace sward::render
