#pragma once

#include "base/job.h"
#include "base/result.h"
#include "report/row.h"
#include "report/speed.h"

#include <vector>

namespace sward::report {

/// Rows `edit_preview` of section speed: an edit of the project's first plant to the picture that shows it, in process
/// and without a window: baked at a quality, uploaded, and drawn at 1280x800 as the editor draws while a slider moves
/// (half resolution, one sample). One row for each of
///   its height ("edit": "geometry") at coarse, half and (not when quick) full quality,
///   its colour ("edit": "colour") at coarse and half quality, where nothing is traced.
/// Ratios: coarse and colours against the limit of 150 ms, half against 3 s, full against the cold bake of the same
/// project in the same run. A project without plants gives no rows.
Result<std::vector<Row>> editPreviewRows(const SpeedInput& input, const JobContext& job);

/// Rows `curve_preview` of section speed: a point of the ageing curves let go, to the picture that shows it, in the
/// same way, at coarse and at full quality: of about a hundred blades in a texel of 256 columns, and of the project
/// itself where it is drawn as texels. Ratios: coarse against the limit of 100 ms, full against 3 s.
Result<std::vector<Row>> curvePreviewRows(const SpeedInput& input, const JobContext& job);

}  // namespace sward::report
