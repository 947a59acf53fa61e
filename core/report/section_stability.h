#pragma once

#include "report/section.h"

namespace sward::report {

/// Section `stability`: a row for every hard case (hardCases) and fit, against the long-double oracle. It needs neither
/// project nor graphics. Method is the case's name; parameters:
/// - fit: lpt, lpt_paper or ptm; path: how many columns took which (lpt::FitPath);
/// - condition: the largest stated; max_coefficient: the largest |b|;
/// - order_difference: largest change of f when lights and layers come in reverse order; finite: true or false;
/// - error_of_bound: the largest quotient of an error and the rounding bound derived for it: 1 or less is sound.
/// Errors max and rmse are of f, in units of the case's largest sample. Table stability holds the same in full.
Result<Section> stabilitySection(const SectionInput& input, const JobContext& job);

}  // namespace sward::report
