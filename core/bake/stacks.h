#pragma once

#include "base/job.h"
#include "lpt/fit.h"
#include "lpt/layer_stack.h"
#include "tiles/tile_set.h"
#include "trace/layers.h"

#include <vector>

namespace sward::bake {

/// All that is known of one layer set of the patch; texel arrays are as long as hits.texels().
struct SetLayers {
  const trace::LayerHits& hits;
  const trace::LayerSurface& surface;
  const trace::LayerVisibility& visibility;
  const lpt::Fit& fit;  ///< filled (lpt::fillEmpty)
};

/// What seams compare: one entry a column of the slices; `fit` must be LPT with both channels.
std::vector<tiles::SeamColumn> seamColumns(const SetLayers& slices);

/// The patch itself as one image.
lpt::LayerStackInput patchStack(const SetLayers& layers, const JobContext& job);

/// Every tile with its apron as an image. Where several patch columns may stand at a texel, coverage is their mean and
/// everything else their coverage-weighted mean.
lpt::LayerStackInput tileStack(const SetLayers& layers, const tiles::TileSet& set, const JobContext& job);

}  // namespace sward::bake
