#pragma once

#include "base/job.h"
#include "base/result.h"
#include "report/row.h"
#include "trace/options.h"
#include "trace/patch_scene.h"

namespace sward::report {

/// Row `layer_sampling` of section speed: rays a second of sampling the slices and lighting them by one light, against
/// a bare Embree loop over the very packets that this traces, prepared in arrays, in the same run. The packets are kept
/// in memory, so `options` above 128 x 128 x 16 x 4 are scaled down to that many rays by fewer columns. The ratio is
/// rate over rate; errors: no ray at all, cancellation.
Result<Row> layerSamplingRow(const trace::PatchScene& scene, const trace::SamplingOptions& options,
                             const JobContext& job);

}  // namespace sward::report
