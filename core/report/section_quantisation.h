#pragma once

#include "report/light_samples.h"
#include "report/section.h"

namespace sward::report {

/// Section quantisation: what 8 and 16 bits, and ranges that cut off some of the coefficients at each end, add to the
/// error of an LPT and a PTM.
Result<Section> quantisationSection(const SectionInput& input, LightSampleSource& source, const JobContext& job);

}  // namespace sward::report
