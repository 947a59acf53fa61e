#pragma once

#include "base/job.h"
#include "lpt/fit.h"
#include "tiles/tile_set.h"
#include "trace/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// What a fit was made from and how well it was conditioned, arranged like the stack that it belongs to
/// (lpt::LayerStack's columns and texels).
struct StackInspection {
  std::vector<std::uint8_t> condition;   ///< per column: conditionByte() of the fit's condition number
  std::vector<std::uint8_t> rank;        ///< per column: numerical rank of the data (lpt::Fit::rank); 0 where empty
  std::vector<float> weight;             ///< per column: summed weight of its texels; 0 where empty
  std::vector<std::uint8_t> visibility;  ///< per texel: visibility in [0, 1] times 255; 0 where nothing is
};

/// Beside a ground, for inspection alone; no picture needs it. Same order as in GroundBake.
struct Inspection {
  StackInspection slices, soil;
  std::array<StackInspection, 4> blades;
};

/// Condition numbers from 1 to 10^kConditionDecades and above, by their logarithm, as 1 to 255; 0 is an empty column.
inline constexpr double kConditionDecades = 4.0;
inline std::uint8_t conditionByte(float condition) {
  if (!(condition > 0.0f)) return 0;
  const double share = std::log10(static_cast<double>(condition)) / kConditionDecades;
  return static_cast<std::uint8_t>(1 + std::lround(254.0 * std::min(std::max(share, 0.0), 1.0)));
}

/// What an inspection is made of: one layer set of the patch.
struct InspectedLayers {
  const trace::LayerHits& hits;
  const trace::LayerVisibility& visibility;
  const lpt::Fit& fit;
};

/// The patch itself as one image.
StackInspection inspectPatch(const InspectedLayers& layers, const JobContext& job);

/// Every tile with its apron. Where several patch columns may stand at a texel: the weighted mean of the logarithms of
/// their conditions, the least of their ranks, the mean of their weights, the coverage-weighted mean of visibility.
StackInspection inspectTiles(const InspectedLayers& layers, const tiles::TileSet& set, const JobContext& job);

}  // namespace sward::bake
