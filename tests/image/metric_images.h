#pragma once

#include "base/random.h"
#include "image/image.h"

#include <cstdint>

/// Pairs of images for the metrics: the figures that other implementations gave for them stand in the tests, so that
/// every value is a product of few exactly defined operations in float: any change here changes those figures.
namespace sward::image::pairs {

inline constexpr int kWidth = 96;
inline constexpr int kHeight = 64;

/// Uniform in [0, 1), a multiple of 2^-24.
inline float noise(std::uint64_t seed, int x, int y, int c) {
  return base::unitFloat(
      base::mix64(seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(c)));
}

/// `value` in steps of 1/255, as a PNG would hold it; clamped.
inline float inSteps(float value) {
  const float clamped = value < 0.0f ? 0.0f : (value > 1.0f ? 1.0f : value);
  return static_cast<float>(static_cast<int>(clamped * 255.0f + 0.5f)) / 255.0f;
}

struct Pair {
  Image reference = Image(kWidth, kHeight, 3);
  Image test = Image(kWidth, kHeight, 3);
};

/// Display values: smooth ramps of colour, and the same with noise of +-amplitude.
inline Pair noisyRamps(float amplitude = 0.125f) {
  Pair pair;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(kWidth);
      const float v = static_cast<float>(y) / static_cast<float>(kHeight);
      const float ramps[3] = {u, v, 1.0f - 0.5f * (u + v)};
      for (int c = 0; c < 3; ++c) {
        pair.reference.at(x, y, c) = inSteps(ramps[c]);
        pair.test.at(x, y, c) = inSteps(ramps[c] + amplitude * (2.0f * noise(1, x, y, c) - 1.0f));
      }
    }
  }
  return pair;
}

/// Display values: strokes like letters, dark on a light page; the test's stand a pixel to the right and are greyer.
inline Pair shiftedText() {
  Pair pair;
  const auto inked = [](int x, int y) {
    if (x < 0 || x % 8 >= 6 || y % 12 >= 9) return false;
    return (base::mix64(7, static_cast<std::uint64_t>(x / 2), static_cast<std::uint64_t>(y / 3)) & 1) != 0;
  };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < 3; ++c) {
        pair.reference.at(x, y, c) = inSteps(inked(x, y) ? 0.1f : 0.95f);
        pair.test.at(x, y, c) = inSteps(inked(x - 1, y) ? 0.2f : 0.95f);
      }
    }
  }
  return pair;
}

/// Smooth noise in [0, 1] on a lattice of cells of `cell` pixels.
inline float latticeNoise(std::uint64_t seed, int x, int y, int cell) {
  const int i = x / cell;
  const int j = y / cell;
  const float u = static_cast<float>(x % cell) / static_cast<float>(cell);
  const float v = static_cast<float>(y % cell) / static_cast<float>(cell);
  const float top = noise(seed, i, j, 0) * (1.0f - u) + noise(seed, i + 1, j, 0) * u;
  const float bottom = noise(seed, i, j + 1, 0) * (1.0f - u) + noise(seed, i + 1, j + 1, 0) * u;
  return top * (1.0f - v) + bottom * v;
}

/// Linear values like a meadow under a bright sky, from 0.005 to about 40: the test's grass has other detail and its
/// sun is weaker.
inline Pair meadow() {
  Pair pair;
  const auto grass = [](std::uint64_t seed, int x, int y) {
    return 0.5f * latticeNoise(seed, x, y, 16) + 0.3f * latticeNoise(seed + 1, x, y, 5) +
           0.2f * latticeNoise(seed + 2, x, y, 2);
  };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float distance2 = static_cast<float>((x - 70) * (x - 70) + (y - 8) * (y - 8));
      const float sky[3] = {1.5f, 2.0f, 3.0f};
      const float leaf[3] = {0.25f, 0.5f, 0.0625f};
      const bool aboveHorizon = y < 20 + static_cast<int>(6.0f * latticeNoise(40, x, 0, 12));
      for (int c = 0; c < 3; ++c) {
        const float reference = leaf[c] * grass(10, x, y) * grass(13, x, y) + 0.005f;
        const float test = leaf[c] * grass(10, x, y) * (0.75f * grass(13, x, y) + 0.25f * grass(23, x, y)) + 0.005f;
        pair.reference.at(x, y, c) = aboveHorizon ? sky[c] + 400.0f / (10.0f + distance2) : reference;
        pair.test.at(x, y, c) = aboveHorizon ? sky[c] + 300.0f / (10.0f + distance2) : test;
      }
    }
  }
  return pair;
}

}  // namespace sward::image::pairs
