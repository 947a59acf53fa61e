#pragma once

#include "base/job.h"
#include "report/row.h"

namespace sward::report {

/// Row `lpt_fit` of section `speed`: the rate of fitting LPT in light samples a second, and its ratio to one
/// column-pivoting QR (Eigen) a pixseries on the same regularised systems, both on job.threads threads, in turn, in the
/// same run. Dense: every layer of every pixseries occupied; the parameters also hold a patch where 39 % of the
/// pixseries have only one or two occupied layers. `error` holds the largest difference of a coefficient, relative to
/// the largest of its pixseries. Errors of a fit end in a row without figures whose notes say why. quick: a quarter of
/// the pixseries, fewer runs.
Row lptFitRow(const JobContext& job, bool quick);

}  // namespace sward::report
