#include "render/view_mode.h"

#include "image/bytes.h"
#include "image/colour.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

Legend conditionLegend(const bake::Inspection* inspection) {
  Legend legend{"Condition number of the fit", 0.0, 1.0, infernoStops(), {}, {}};
  if (inspection == nullptr) return legend;
  legend.low = inspection->conditions.low;
  legend.high = inspection->conditions.high;
  legend.ticks = evenTicks(legend.low, legend.high, 5);
  for (Legend::Tick& tick : legend.ticks)
    tick.text = numberText(std::pow(10.0, legend.low + (legend.high - legend.low) * tick.at));
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

Legend quantityLegend(const ViewMode& mode, const bake::GroundBake& ground, const bake::Inspection* inspection) {
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
      return conditionLegend(inspection);
    case ViewQuantity::Tiles:
      return tilesLegend(ground);
  }
  return {};
}

/// Absolute values of one coefficient, of at most about kMost places evenly over the stack.
void collect(const lpt::LayerStack& stack, ResponseChannel channel, int coefficient, std::vector<double>& values) {
  constexpr std::size_t kMost = 100000;
  const auto index = static_cast<std::size_t>(static_cast<int>(channel) * stack.perColumn() + coefficient);
  if (index >= stack.ranges.size()) return;
  const lpt::CoefficientRange& range = stack.ranges[index];
  const std::size_t items = stack.itemCount();
  const std::size_t bytes = static_cast<std::size_t>(stack.bits) / 8;
  for (std::size_t item = 0; item < items; item += 1 + items / kMost) {
    const std::uint8_t* stored = stack.coefficients.data() + (item * stack.ranges.size() + index) * bytes;
    const int quantised = bytes == 2 ? stored[0] | (stored[1] << 8) : stored[0];
    const double value = range.scale > 0.0f ? quantised / static_cast<double>(range.scale) : 0.0;
    values.push_back(std::abs(value - static_cast<double>(range.base)));
  }
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

Legend legendOf(const ViewMode& mode, const bake::GroundBake& ground, const bake::Inspection* inspection) {
  Legend legend = quantityLegend(mode, ground, inspection);
  if (mode.layer < 0) return legend;
  const std::string layer = "layer " + std::to_string(mode.layer);
  legend.title = legend.title.empty() ? "Shaded, " + layer : legend.title + ", " + layer;
  return legend;
}

glm::vec3 tileColour(int tile) {
  constexpr float kGolden = 0.61803399f, kPale = 0.12f;
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
  constexpr double kShown = 0.98;
  std::vector<double> values;
  collect(ground.slices, channel, coefficient, values);
  for (const lpt::LayerStack& blade : ground.blades) collect(blade, channel, coefficient, values);
  if (values.empty()) return 1.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(kShown * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at > 0.0 ? *at : 1.0;
}

ByteColour backdropOf(const ViewMode& mode) {
  return mode.layer >= 0 && !mode.scalar() ? ByteColour{108, 110, 114} : ByteColour{46, 48, 53};
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
