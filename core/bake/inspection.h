#pragma once

#include "base/job.h"
#include "lpt/fit.h"
#include "tiles/tile_set.h"
#include "trace/layers.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::bake {

/// What a fit was made from and how well it was conditioned, arranged like the stack that it belongs to
/// (lpt::LayerStack's columns and texels).
struct StackInspection {
  std::vector<std::uint8_t> condition;   ///< per column: ConditionRange::byteOf() of the fit's condition number
  std::vector<std::uint8_t> rank;        ///< per column: numerical rank of the data (lpt::Fit::rank); 0 where empty
  std::vector<float> weight;             ///< per column: summed weight of its texels; 0 where empty
  std::vector<std::uint8_t> visibility;  ///< per texel: visibility in [0, 1] times 255; 0 where nothing is
};

/// Logarithms to base 10 of the condition numbers that bytes span: a ridge holds all fits of a ground so close together
/// that fixed decades would show one colour.
struct ConditionRange {
  double low = 0.0, high = 1.0;

  /// 1 to 255 from low to high, clamped; 0 is an empty column (condition 0).
  std::uint8_t byteOf(float condition) const;
};

/// Beside a ground, for inspection alone; no picture needs it. Same order as in GroundBake.
struct Inspection {
  ConditionRange conditions;
  StackInspection slices, soil;
  std::array<StackInspection, 4> blades;
};

/// What an inspection is made of: one layer set of the patch.
struct InspectedLayers {
  const trace::LayerHits& hits;
  const trace::LayerVisibility& visibility;
  const lpt::Fit& fit;
};

/// What all but one in a hundred columns at either end span, at least a twentieth of a decade.
ConditionRange conditionRange(std::span<const lpt::Fit* const> fits);

/// The patch itself as one image.
StackInspection inspectPatch(const InspectedLayers& layers, const ConditionRange& conditions, const JobContext& job);

/// Every tile with its apron. Where several patch columns may stand at a texel: the weighted mean of the logarithms of
/// their conditions, the least of their ranks, the mean of their weights, the coverage-weighted mean of visibility.
StackInspection inspectTiles(const InspectedLayers& layers, const ConditionRange& conditions, const tiles::TileSet& set,
                             const JobContext& job);

}  // namespace sward::bake
