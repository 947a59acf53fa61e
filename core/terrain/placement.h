#pragma once

#include "base/job.h"
#include "base/result.h"
#include "terrain/height_field.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

namespace sward::terrain {

/// Where plants of a kind may stand.
struct PlacementRules {
  double perHectare = 100.0;                                  ///< where nothing keeps them away, >= 0
  double spacingM = 3.0;                                      ///< least distance between any two, >= 0
  double lowestM = -std::numeric_limits<double>::infinity();  ///< height of the ground
  double highestM = std::numeric_limits<double>::infinity();
  double steepestDeg = 90.0;  ///< slope of the ground
  /// Over how many metres of height, or degrees of slope, inside of those bounds plants become fewer; 0: they end
  /// sharply.
  double featherM = 0.0, featherDeg = 0.0;
  std::uint64_t seed = 1;
};

/// A place of a plant: the ground's, and a seed for all that is its own (size, turn, colour).
struct Stand {
  glm::dvec3 foot{0.0};
  std::uint64_t seed = 0;
  bool operator==(const Stand&) const = default;
};

/// Scatters plants over a rectangle: as many as the density says in the mean, never nearer than the spacing (blue noise
/// by dart throwing: Cook 1986; a dart that falls too near is thrown again, kThrows times, before its plant is left
/// out). `share` (0 to 1; none: 1 everywhere) multiplies the density, as a painted mask does. Packing ends at about
/// 0.85 / spacing^2 plants a square metre (measured), whatever the density asks.
///
/// The same seed gives the same plants. Errors: rules that are not finite or out of range; a rectangle without area;
/// more than kMostStands asked for; Error::cancelled().
Result<std::vector<Stand>> place(const PlacementRules& rules, const glm::dvec2& low, const glm::dvec2& high,
                                 const HeightField& ground, const std::function<double(const glm::dvec2&)>& share,
                                 const JobContext& job);
inline constexpr int kThrows = 24;
inline constexpr double kMostStands = 4e6;

/// Part of the full density that rules leave at a place of the ground, 0 to 1.
double allowed(const PlacementRules& rules, const HeightSample& ground);

}  // namespace sward::terrain
