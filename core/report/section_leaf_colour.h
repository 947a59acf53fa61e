#pragma once

#include "report/section.h"

namespace sward::report {

/// Section `leaf_colour`: what colours leaves get, from contents by plates (PROSPECT) and by the paper's subtraction.
/// It needs neither project nor graphics. Rows:
/// - plates, subtraction: a colour of an ageing leaf computed anew; parameters `clamped_wavelengths` (of the fresh
/// leaf,
///   of 71), `desaturated` (greatest part by which a colour was moved into the gamut);
/// - plates_table, subtraction_table: the same from leaf::AgeingColours; parameters `delta_e_max`, `delta_e_mean`:
///   CIEDE2000 against the computed colour, reflectance and transmittance; bytes of the table;
/// - plates_measured, subtraction_measured: fitted to a measured reflectance; parameters `leaf`, `stage` (green,
///   turning, dry), `delta_e` (CIEDE2000 of the fitted against the measured colour) and what was fitted; errors rmse
///   and max are of the reflectance, over 400 to 750 nm.
Result<Section> leafColourSection(const SectionInput& input, const JobContext& job);

}  // namespace sward::report
