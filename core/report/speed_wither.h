#pragma once

#include "base/job.h"
#include "base/result.h"
#include "report/row.h"

#include <vector>

namespace sward::report {

/// What the rows of withering are measured on; smaller for tests.
struct WitherSpeedSize {
  int resolution = 256;
  int blades = 100;
  int samples = 7;  ///< that are mingled
  double proportions[2] = {6.0, 110.0};
  int runs = 5;
};

/// Rows wither_to_points, wither_step, wither_to_texel, wither_key_frame_bytes and mingle_7 of section speed, on the
/// paper's cones; parameters `blades`, `points`, `voxels` (of the result), `resolution`, `proportion`.
///
/// The first three have a row for each of the proportions, and one more with half of the blades. The ratio of the first
/// proportion is that of the target over the time, that of the second the time of copying as many bytes as are read and
/// written (`bytes_moved`, std::memcpy on one thread), that of half the blades the time of all of them over theirs,
/// measured in turn: `ratio_of_points`, about 2, is proportional. `over_paper` at the first proportion, the paper's own
/// number of points: the paper's figure over the time. Errors: core/wither's; Error::cancelled().
Result<std::vector<Row>> witherSpeedRows(const WitherSpeedSize& size, const JobContext& job);

}  // namespace sward::report
