#pragma once

#include "base/job.h"
#include "lpt/options.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::lpt {

/// b' = scale (b + base) (equation 7) is the stored integer, 0 to 255 or 65535; it is read back as b' / scale - base,
/// in float. A constant coefficient has scale 0, is stored as 0 and read back as -base, exactly.
struct CoefficientRange {
  float scale = 0.0f;
  float base = 0.0f;

  float value(std::uint32_t stored) const { return scale == 0.0f ? -base : static_cast<float>(stored) / scale - base; }
};

/// Coefficients as integers: one byte each, or two (little-endian) for 16 bits, in the order that they had.
struct QuantisedSets {
  std::vector<CoefficientRange> ranges;  ///< one a member of a set
  std::vector<std::uint8_t> bytes;
};

/// Quantises sets of `perSet` coefficients each, to options.bits, rounding to nearest. Ranges are those of the data,
/// with options.clampQuantile cut off at each end, and where float could not hold high - low all beyond a quarter of
/// the largest float, so that everything reads back finite; values that are not finite count for nothing and are stored
/// as 0. Throws ContractError unless bits is 8 or 16, the quantile in [0, 0.5) and the sets whole.
QuantisedSets quantiseSets(std::span<const float> sets, std::size_t perSet, const FitOptions& options,
                           const JobContext& job);

}  // namespace sward::lpt
