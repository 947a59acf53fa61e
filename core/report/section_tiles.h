#pragma once

#include "report/section.h"

namespace sward::report {

/// Section `tiles`, on the project's own patch.
/// - seam_straight, seam_dynamic_programming, seam_graph_cut: time to make the tile set (choice of diamonds, seams);
/// what
///   the seams cost over the disc of lights, summed over all tiles (parameter seam_cost) and by the texel (ratio
///   against neighbours inside the patch: 1 would be a seam that is no rougher than the grass).
/// - map_scan_order, map_hashed: time of a map of 1024 x 1024 cells, and its repetition: by how much two cells at the
///   worst lag agree more often than chance (parameter repetition, 0 none, 1 complete).
/// - repetition_picture: the same of a picture from straight above, as correlation of luminance at whole-tile lags.
Result<Section> tilesSection(const SectionInput& input, const JobContext& job);

}  // namespace sward::report
