#include "report/hard_cases.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sward::report {
namespace {

using LayerSets = std::vector<std::vector<int>>;
/// The response of a texel of `layer` to a light.
using Response = double (*)(int layer, const glm::dvec3& light, base::Random& random);

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// From one layer to all sixteen; ranks 6, 9, 9, 10, 10 and 10 under lights enough.
const LayerSets kUsualLayers{{7},       {0, 15},        {3, 4},
                             {2, 3, 4}, {0, 5, 10, 15}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}};

/// A leaf's clamped cosine, its normal turning from layer to layer, plus noise.
double leafResponse(int layer, const glm::dvec3& light, base::Random& random) {
  const double turn = 0.4 * layer;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(std::cos(turn), std::sin(turn), 1.0));
  return 0.8 * std::max(glm::dot(normal, light), 0.0) + 0.2 * random.uniform();
}

HardCase withLights(std::string name, std::vector<glm::dvec3> lights, std::string expectation) {
  HardCase out;
  out.name = std::move(name);
  out.expectation = std::move(expectation);
  out.lights = std::move(lights);
  return out;
}

HardCase filled(HardCase out, const LayerSets& columns, Response response = leafResponse, int channels = 1) {
  base::Random random(71);
  out.channels = channels;
  out.columns = static_cast<int>(columns.size());
  out.samples.resize(out.lights.size() * static_cast<std::size_t>(channels));
  for (const std::vector<int>& layers : columns) {
    for (const int layer : layers) {
      out.layer.push_back(static_cast<std::uint8_t>(layer));
      out.coverage.push_back(static_cast<float>(random.uniform(0.3, 1.0)));
      out.visibility.push_back(static_cast<float>(random.uniform(0.1, 1.0)));
      for (std::size_t s = 0; s < out.samples.size(); ++s) {
        out.samples[s].push_back(static_cast<float>(response(layer, out.lights[s % out.lights.size()], random)));
      }
    }
    out.columnStart.push_back(static_cast<std::uint32_t>(out.layer.size()));
  }
  return out;
}

glm::dvec3 lightAt(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation)};
}

std::vector<glm::dvec3> lightsOf(int count, glm::dvec3 (*one)(int)) {
  std::vector<glm::dvec3> lights;
  for (int i = 0; i < count; ++i) lights.push_back(one(i));
  return lights;
}

void addLightCases(std::vector<HardCase>& out) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const auto add = [&](const char* name, std::vector<glm::dvec3> lights, const char* expectation) {
    out.push_back(filled(withLights(name, std::move(lights), expectation), kUsualLayers));
  };
  add("lights_fifteen", hemisphereLights(15), "the usual set, for comparison: the fast path, to float's rounding");
  add("lights_one", hemisphereLights(1), "one value a layer: too few lights leave the fast path, all stays bounded");
  add("lights_three", hemisphereLights(3), "three of six light functions are seen: the orthogonal path");
  add("lights_five", hemisphereLights(5), "one light short of a full fit: the orthogonal path");
  add("lights_coincident", lightsOf(15, [](int) { return glm::dvec3(0.6, 0.0, 0.8); }),
      "fifteen times the same light counts as one");
  add("lights_nearly_coincident",
      lightsOf(15, [](int i) { return glm::normalize(glm::dvec3(0.6 + 1e-9 * i, 1e-9 * i * i, 0.8)); }),
      "a billionth apart: their differences are noise, not slopes; the ridge decides, paper cuts the rank");
  add("lights_coplanar", lightsOf(15, [](int i) { return lightAt(0.0, std::numbers::pi * (i + 0.5) / 15.0); }),
      "one day's sun through the zenith: nothing is known across its plane");
  add("lights_ring", lightsOf(12, [](int i) { return lightAt(kTurn * i / 12.0, std::numbers::pi / 6.0); }),
      "lx^2 + ly^2 is the constant: one direction of six is unknown");
  add("lights_horizon",
      lightsOf(12, [](int i) { return lightAt(kTurn * i / 12.0, (0.1 + 0.08 * i) * std::numbers::pi / 180.0); }),
      "0.1 to 1 degree up: nearly a ring; paper resolves a difference of 3e-4 and pays with large coefficients");
}

void addLayerCases(std::vector<HardCase>& out) {
  out.push_back(filled(withLights("layers_one", hemisphereLights(15), "one layer a column: PTM with a constant u"),
                       {{0}, {1}, {8}, {15}}));
  out.push_back(filled(withLights("layers_none", hemisphereLights(15), "empty columns: zeros"), {{}, {}, {3}, {}}));
  out.push_back(filled(
      withLights("layers_last_two_of_256", hemisphereLights(15), "1/256 apart: without a ridge slopes are steep"),
      {{254, 255}, {0, 1}, {0, 255}, {127, 128, 129}}));
  out.back().layers = 256;
}

void addWeightCases(std::vector<HardCase>& out) {
  const auto usual = [](const char* name, const char* expectation) {
    return filled(withLights(name, hemisphereLights(15), expectation), kUsualLayers);
  };
  out.push_back(usual("visibility_zero", "weights are 1/(2m) alpha; paper has no weight left and is empty"));
  std::fill(out.back().visibility.begin(), out.back().visibility.end(), 0.0f);
  // The first texel of every column counts for nothing beside the others.
  out.push_back(usual("visibility_1e-12", "paper sees the others alone; ours never weighs under 1/(2m)"));
  std::fill(out.back().visibility.begin(), out.back().visibility.end(), 1.0f);
  for (int c = 0; c < out.back().columns; ++c) {
    out.back().visibility[out.back().columnStart[static_cast<std::size_t>(c)]] = 1e-12f;
  }
  out.push_back(usual("coverage_1e-12", "a column of two layers becomes one of one layer, smoothly"));
  std::fill(out.back().coverage.begin(), out.back().coverage.end(), 1.0f);
  for (int c = 0; c < out.back().columns; ++c) {
    out.back().coverage[out.back().columnStart[static_cast<std::size_t>(c)]] = 1e-12f;
  }
}

void addLuminanceCases(std::vector<HardCase>& out) {
  const auto add = [&](const char* name, const char* expectation, Response response) {
    out.push_back(filled(withLights(name, hemisphereLights(15), expectation), kUsualLayers, response));
  };
  add("luminance_1e-8", "coefficients scale with the samples, with the same relative error",
      [](int i, const glm::dvec3& l, base::Random& r) { return 1e-8 * leafResponse(i, l, r); });
  add("luminance_1e6", "coefficients scale with the samples, with the same relative error",
      [](int i, const glm::dvec3& l, base::Random& r) { return 1e6 * leafResponse(i, l, r); });
  add("luminance_mixed", "1e-8 to 1e6 in one column: the error is relative to the largest",
      [](int, const glm::dvec3&, base::Random& r) { return std::pow(10.0, r.uniform(-8.0, 6.0)); });
  add("luminance_zero", "all dark: zeros, not rounding", [](int, const glm::dvec3&, base::Random&) { return 0.0; });
  add("one_light_on_one_texel", "a single bright sample a column among dark ones",
      [](int, const glm::dvec3&, base::Random&) { return 0.0; });
  for (int c = 0; c < out.back().columns; ++c) {
    out.back().samples[4][out.back().columnStart[static_cast<std::size_t>(c)]] = 1.0f;
  }
}

void addNotFinite(std::vector<HardCase>& out) {
  const auto add = [&](const char* name, float value) {
    out.push_back(filled(withLights(name, hemisphereLights(15),
                                    "the row is left out of both channels; the last column has no other and is empty"),
                         {{7}, {0, 15}, {2, 3, 4}, {0, 5, 10, 15}, {1, 2}, {9}}, leafResponse, 2));
    HardCase& one = out.back();
    for (std::size_t c = 0; c < 4; ++c) one.samples[3 + c][one.columnStart[c]] = value;
    for (auto& samples : one.samples) samples[one.columnStart[5]] = value;
  };
  add("sample_nan", kNan);
  add("sample_infinite", kInf);
}

}  // namespace

std::vector<glm::dvec3> hemisphereLights(int count) {
  std::vector<glm::dvec3> lights;
  for (int i = 0; i < count; ++i) {
    lights.push_back(lightAt(i * std::numbers::pi * (3.0 - std::sqrt(5.0)), std::asin(1.0 - (i + 0.5) / count)));
  }
  return lights;
}

lpt::FitInput HardCase::input() const {
  lpt::FitInput in;
  in.columns = columns;
  in.layers = layers;
  in.columnStart = columnStart;
  in.layer = layer;
  in.coverage = coverage;
  in.visibility = visibility;
  in.lights = lights;
  in.channels = channels;
  for (const auto& one : samples) in.samples.emplace_back(one);
  return in;
}

HardCase reordered(const HardCase& from) {
  HardCase out = from;
  const auto turn = [&](auto& values) {
    for (std::size_t c = 0; c + 1 < from.columnStart.size(); ++c) {
      std::reverse(values.begin() + from.columnStart[c], values.begin() + from.columnStart[c + 1]);
    }
  };
  turn(out.layer);
  turn(out.coverage);
  turn(out.visibility);
  for (auto& values : out.samples) turn(values);
  std::reverse(out.lights.begin(), out.lights.end());
  const auto lights = static_cast<std::ptrdiff_t>(from.lights.size());
  for (std::ptrdiff_t c = 0; c < from.channels; ++c) {
    std::reverse(out.samples.begin() + c * lights, out.samples.begin() + (c + 1) * lights);
  }
  return out;
}

Result<std::vector<HardCase>> hardCases(const JobContext& job) {
  std::vector<HardCase> out;
  addLightCases(out);
  addLayerCases(out);
  addWeightCases(out);
  addLuminanceCases(out);
  addNotFinite(out);
  struct Size {
    const char* name;
    double scale;
  };
  for (const Size size : {Size{"patch_1m", 1.0}, Size{"patch_1mm", 0x1.0p-10}, Size{"patch_1km", 0x1.0p10}}) {
    SWARD_ASSIGN(HardCase patch, patchCase(size.name, size.scale, job));
    out.push_back(std::move(patch));
  }
  return out;
}

}  // namespace sward::report
