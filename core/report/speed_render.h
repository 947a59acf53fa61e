#pragma once

#include "bake/ground_bake.h"
#include "base/result.h"
#include "gpu/context.h"
#include "report/row.h"

#include <memory>
#include <vector>

namespace sward::report {

/// Rows of section speed for drawing a ground on `context`, at 1280 x 720, one sample a pixel, with the filtering of
/// pictures:
///  - relight_tiles: slices and soil of all tiles with their mips, against copying as many texels;
///  - march_down, march_45, march_grazing: 200 x 200 tiles in view (grazing: to the horizon, from eye height), and
///    march_down_near, march_45_near from 3 m, against a bare loop of as many nearest fetches a pixel as there are
///    layers;
///  - blended_slices: all slices composited without an early end, straight down from 3 m, against march_down_near.
/// Ratios are rate over rate, measured in turn. quick: fewer runs.
Result<std::vector<Row>> renderRows(gpu::Context& context, std::shared_ptr<const bake::GroundBake> ground, bool quick);

}  // namespace sward::report
