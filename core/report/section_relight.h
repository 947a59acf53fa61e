#pragma once

#include "report/light_samples.h"
#include "report/section.h"

namespace sward::report {

/// Section lpt_relight: how fast each way of keeping light responses answers a new light on the processor, with its
/// error beside the time.
Result<Section> lptRelightSection(const SectionInput& input, LightSampleSource& source, const JobContext& job);

}  // namespace sward::report
