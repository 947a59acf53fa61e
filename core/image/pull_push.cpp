#include "image/pull_push.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sward::image {
namespace {

/// One level: weighted means of the level below.
struct Level {
  int width = 0, height = 0;
  std::vector<float> values;
  std::vector<float> weight;
};

std::size_t pixel(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

Level pull(const Level& fine, std::size_t channels) {
  Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
  const std::size_t count = static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height);
  coarse.values.assign(count * channels, 0.0f);
  coarse.weight.assign(count, 0.0f);
  std::vector<double> sum(channels);
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      double total = 0.0;
      std::fill(sum.begin(), sum.end(), 0.0);
      for (int fy = 2 * y; fy < std::min(2 * y + 2, fine.height); ++fy) {
        for (int fx = 2 * x; fx < std::min(2 * x + 2, fine.width); ++fx) {
          const std::size_t at = pixel(fx, fy, fine.width);
          const double w = static_cast<double>(fine.weight[at]);
          if (w == 0.0) continue;
          total += w;
          for (std::size_t c = 0; c < channels; ++c) sum[c] += w * static_cast<double>(fine.values[at * channels + c]);
        }
      }
      if (total == 0.0) continue;
      const std::size_t at = pixel(x, y, coarse.width);
      // A mean of weights, not their sum, so that they stay within the range of float at every level.
      coarse.weight[at] = std::max(static_cast<float>(0.25 * total), 1e-30f);
      for (std::size_t c = 0; c < channels; ++c) coarse.values[at * channels + c] = static_cast<float>(sum[c] / total);
    }
  }
  return coarse;
}

int bordered(int i, int size, bool periodic) {
  return periodic ? (i % size + size) % size : std::clamp(i, 0, size - 1);
}

/// `coarse` is complete; fills the pixels of `values` without a weight.
void push(const Level& coarse, std::span<float> values, std::span<const float> weight, int width, int height,
          std::size_t channels, bool periodic) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = pixel(x, y, width);
      if (weight[at] > 0.0f) continue;
      // Pixel x lies at (x + 1/2) / 2 - 1/2 on the coarse grid: a quarter from one neighbour, three from the other.
      const int x0 = bordered((x - 1) >> 1, coarse.width, periodic),
                x1 = bordered(((x - 1) >> 1) + 1, coarse.width, periodic);
      const int y0 = bordered((y - 1) >> 1, coarse.height, periodic),
                y1 = bordered(((y - 1) >> 1) + 1, coarse.height, periodic);
      const float tx = x % 2 == 0 ? 0.75f : 0.25f, ty = y % 2 == 0 ? 0.75f : 0.25f;
      for (std::size_t c = 0; c < channels; ++c) {
        const auto value = [&](int cx, int cy) { return coarse.values[pixel(cx, cy, coarse.width) * channels + c]; };
        const float low = (1.0f - tx) * value(x0, y0) + tx * value(x1, y0);
        const float high = (1.0f - tx) * value(x0, y1) + tx * value(x1, y1);
        values[at * channels + c] = (1.0f - ty) * low + ty * high;
      }
    }
  }
}

}  // namespace

void pullPush(std::span<float> values, std::span<const float> weight, int width, int height, int channels,
              bool periodic) {
  SWARD_CHECK(width > 0 && height > 0 && channels > 0);
  SWARD_CHECK_EQ(weight.size(), static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  SWARD_CHECK_EQ(values.size(), weight.size() * static_cast<std::size_t>(channels));
  const auto empty = [](float w) { return !(w > 0.0f); };
  if (std::none_of(weight.begin(), weight.end(), empty) || std::all_of(weight.begin(), weight.end(), empty)) return;
  const auto depth = static_cast<std::size_t>(channels);
  std::vector<Level> levels;
  levels.push_back({width, height, {values.begin(), values.end()}, {weight.begin(), weight.end()}});
  while (std::any_of(levels.back().weight.begin(), levels.back().weight.end(), empty)) {
    levels.push_back(pull(levels.back(), depth));
  }
  for (std::size_t i = levels.size() - 1; i-- > 0;) {
    Level& fine = levels[i];
    push(levels[i + 1], fine.values, fine.weight, fine.width, fine.height, depth, periodic);
  }
  std::copy(levels.front().values.begin(), levels.front().values.end(), values.begin());
}

}  // namespace sward::image
