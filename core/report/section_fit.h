#pragma once

#include "report/light_samples.h"
#include "report/section.h"

namespace sward::report {

/// Section lpt_fit: how well each way of keeping light responses (lpt::kMethods) predicts lights that it was not fitted
/// to, by the sun's elevation, one light left out in turn, and between texels; with bytes and the time to fit.
Result<Section> lptFitSection(const SectionInput& input, LightSampleSource& source, const JobContext& job);

}  // namespace sward::report
