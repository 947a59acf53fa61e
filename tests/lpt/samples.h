#pragma once

#include "base/random.h"
#include "lpt/fit.h"
#include "lpt/polynomial.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt::test {

/// Spherical Fibonacci points over the upper hemisphere.
inline std::vector<glm::dvec3> hemisphere(int count) {
  std::vector<glm::dvec3> lights;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (i + 0.5) / count, r = std::sqrt(1.0 - z * z);
    const double azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    lights.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), z);
  }
  return lights;
}

/// Owns what a FitInput points at.
struct Scene {
  int columns = 0, layers = 16, channels = 1;
  std::vector<glm::dvec3> lights = hemisphere(15);
  std::vector<std::uint32_t> columnStart{0};
  std::vector<std::uint8_t> layer;
  std::vector<float> coverage, visibility;
  std::array<std::vector<float>, 2> sky;    ///< empty: unknown
  std::vector<std::vector<float>> samples;  ///< [channel * lights + k]

  FitInput input() const {
    FitInput in;
    in.columns = columns;
    in.layers = layers;
    in.columnStart = columnStart;
    in.layer = layer;
    in.coverage = coverage;
    in.visibility = visibility;
    in.sky = {sky[0], sky[1]};
    in.lights = lights;
    in.channels = channels;
    for (const auto& one : samples) in.samples.emplace_back(one);
    return in;
  }
  double u(std::size_t texel) const { return static_cast<double>(layer[texel]) / layers; }
  float sample(std::size_t channel, std::size_t light, std::size_t texel) const {
    return samples[channel * lights.size() + light][texel];
  }
};

/// One more column with these layers; response(channel, layer, light) gives its samples.
inline void addColumn(Scene& scene, const std::vector<int>& layers,
                      const std::function<double(int, int, const glm::dvec3&)>& response, float coverage = 0.7f,
                      float visibility = 0.5f) {
  const std::size_t lights = scene.lights.size();
  scene.samples.resize(lights * static_cast<std::size_t>(scene.channels));
  for (const int layer : layers) {
    scene.layer.push_back(static_cast<std::uint8_t>(layer));
    scene.coverage.push_back(coverage);
    scene.visibility.push_back(visibility);
    for (int c = 0; c < scene.channels; ++c) {
      for (std::size_t k = 0; k < lights; ++k) {
        scene.samples[static_cast<std::size_t>(c) * lights + k].push_back(
            static_cast<float>(response(c, layer, scene.lights[k])));
      }
    }
  }
  ++scene.columns;
  scene.columnStart.push_back(static_cast<std::uint32_t>(scene.layer.size()));
}

/// Columns with random layers (1 to all of them), coverage, visibility and samples in [0, 1].
inline Scene randomScene(int columns, int layers, int lights, int channels, std::uint64_t seed) {
  Scene scene;
  scene.layers = layers;
  scene.channels = channels;
  scene.lights = hemisphere(lights);
  base::Random random(seed);
  for (int c = 0; c < columns; ++c) {
    const double share = random.uniform(0.05, 1.0);
    std::vector<int> occupied;
    for (int i = 0; i < layers; ++i) {
      if (random.uniform() < share) occupied.push_back(i);
    }
    if (occupied.empty()) occupied.push_back(static_cast<int>(random.index(static_cast<std::uint32_t>(layers))));
    addColumn(scene, occupied, [&](int, int, const glm::dvec3&) { return random.uniform(); });
  }
  for (float& a : scene.coverage) a = static_cast<float>(random.uniform(0.05, 1.0));
  for (float& d : scene.visibility) d = static_cast<float>(random.uniform());
  return scene;
}

/// Fits, or throws (which fails the test) with the error's text.
inline Fit fitted(const Scene& scene, const FitOptions& options = {}, int threads = 0) {
  JobContext job;
  job.threads = threads;
  auto result = fit(scene.input(), options, job);
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(result).value();
}

inline double predicted(const Fit& fit, int column, int channel, const glm::dvec3& light, double u) {
  return evaluateLpt(fit.column(column, channel).first<kLptCoefficients>(), light.x, light.y, u);
}
inline double predictedPtm(const Fit& fit, int column, int channel, int layer, const glm::dvec3& light) {
  const auto all = fit.column(column, channel).subspan(static_cast<std::size_t>(layer) * kPtmCoefficients);
  return evaluatePtm(all.first<kPtmCoefficients>(), light.x, light.y);
}

inline double largestCoefficient(std::span<const float> values) {
  double largest = 0.0;
  for (const float v : values) largest = std::max(largest, std::abs(static_cast<double>(v)));
  return largest;
}
/// Largest difference relative to the largest of `b`.
inline double relativeDifference(std::span<const float> a, std::span<const float> b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
  }
  const double scale = largestCoefficient(b);
  return scale > 0.0 ? largest / scale : largest;
}

}  // namespace sward::lpt::test
