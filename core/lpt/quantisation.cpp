#include "lpt/quantisation.h"

#include "base/check.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::lpt {
namespace {

double largestInteger(int bits) {
  return bits == 8 ? 255.0 : 65535.0;
}

/// Range of one coefficient over all sets: `step` floats apart from `first`.
CoefficientRange findRange(std::span<const float> values, std::size_t first, std::size_t step,
                           const FitOptions& options) {
  std::vector<float> finite;
  finite.reserve(values.size() / step + 1);
  for (std::size_t i = first; i < values.size(); i += step) {
    if (std::isfinite(values[i])) finite.push_back(values[i]);
  }
  if (finite.empty()) return {};
  const auto cut = static_cast<std::ptrdiff_t>(options.clampQuantile * static_cast<double>(finite.size()));
  std::nth_element(finite.begin(), finite.begin() + cut, finite.end());
  float low = finite[static_cast<std::size_t>(cut)];
  const std::ptrdiff_t top = static_cast<std::ptrdiff_t>(finite.size()) - 1 - cut;
  std::nth_element(finite.begin(), finite.begin() + top, finite.end());
  float high = finite[static_cast<std::size_t>(top)];
  // A range that float cannot hold (its ends are of both signs then) would be read back as infinity.
  constexpr float kWidest = std::numeric_limits<float>::max() / 2.0f;
  if (0.5 * static_cast<double>(high) - 0.5 * static_cast<double>(low) > 0.99 * static_cast<double>(kWidest)) {
    low = std::max(low, -0.5f * kWidest);
    high = std::min(high, 0.5f * kWidest);
  }
  const auto scale =
      static_cast<float>(largestInteger(options.bits) / (static_cast<double>(high) - static_cast<double>(low)));
  // Infinite where the range is 0, or so narrow that float cannot tell: a constant.
  if (!(high > low) || !std::isfinite(scale)) return {0.0f, -low};
  return {scale, -low};
}

std::uint32_t quantised(float value, const CoefficientRange& range, double largest) {
  if (range.scale == 0.0f || !std::isfinite(value)) return 0;
  const double scaled =
      static_cast<double>(range.scale) * (static_cast<double>(value) + static_cast<double>(range.base));
  return static_cast<std::uint32_t>(std::floor(std::clamp(scaled, 0.0, largest) + 0.5));
}

}  // namespace

QuantisedSets quantiseSets(std::span<const float> sets, std::size_t perSet, const FitOptions& options,
                           const JobContext& job) {
  SWARD_CHECK(options.bits == 8 || options.bits == 16);
  SWARD_CHECK(options.clampQuantile >= 0.0 && options.clampQuantile < 0.5);
  SWARD_CHECK(perSet > 0 && sets.size() % perSet == 0);
  QuantisedSets out;
  out.ranges.assign(perSet, {});
  base::parallelFor(job, perSet, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) out.ranges[j] = findRange(sets, j, perSet, options);
  });
  const std::size_t bytes = options.bits == 8 ? 1 : 2;
  const double largest = largestInteger(options.bits);
  out.bytes.assign(sets.size() * bytes, 0);
  base::parallelFor(job, sets.size() / perSet, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * perSet; i < end * perSet; ++i) {
      const std::uint32_t q = quantised(sets[i], out.ranges[i % perSet], largest);
      out.bytes[i * bytes] = static_cast<std::uint8_t>(q & 255u);
      if (bytes == 2) out.bytes[i * 2 + 1] = static_cast<std::uint8_t>(q >> 8);
    }
  });
  return out;
}

}  // namespace sward::lpt
