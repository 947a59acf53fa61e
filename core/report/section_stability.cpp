#include "report/section_stability.h"

#include "report/stability.h"
#include "report/text.h"

namespace sward::report {
namespace {

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

std::string pathText(const Stability& s) {
  std::string out;
  const auto add = [&](int columns, const char* name) {
    if (columns > 0) out += (out.empty() ? "" : ", ") + std::to_string(columns) + " " + name;
  };
  add(s.moments, "moments");
  add(s.orthogonal, "orthogonal");
  add(s.empty, "empty");
  return out;
}

Row rowOf(const HardCase& one, HardFit fit, const Stability& s) {
  Row row;
  row.method = one.name;
  row.numbersAndNames = {{"fit", quoted(hardFitName(fit))},
                         {"path", quoted(pathText(s))},
                         {"condition", numberText(s.condition)},
                         {"max_coefficient", numberText(s.largestCoefficient)},
                         {"order_difference", numberText(s.orderDifference)},
                         {"error_of_bound", numberText(s.errorShare)},
                         {"finite", s.finite ? "true" : "false"}};
  row.error = {{"max", s.maxError}, {"rmse", s.rmse}};
  row.reference = "long double oracle";
  row.notes = one.expectation;
  return row;
}

Table emptyTable() {
  return {"stability",
          {"case",
           "fit",
           "columns_moments",
           "columns_orthogonal",
           "columns_empty",
           "wrong_paths",
           "wrong_ranks",
           "finite",
           "largest_sample",
           "condition",
           "condition_over_oracle_least",
           "condition_over_oracle_most",
           "max_coefficient",
           "coefficient_of_bound",
           "error_max",
           "error_rmse",
           "error_of_bound",
           "coefficient_error_of_bound",
           "order_difference",
           "order_of_bound",
           "quantisation_of_bound"},
          {}};
}

std::vector<std::string> tableRow(const HardCase& one, HardFit fit, const Stability& s) {
  return {one.name,
          hardFitName(fit),
          std::to_string(s.moments),
          std::to_string(s.orthogonal),
          std::to_string(s.empty),
          std::to_string(s.wrongPaths),
          std::to_string(s.wrongRanks),
          s.finite ? "true" : "false",
          numberText(s.scale),
          numberText(s.condition),
          numberText(s.conditionLow),
          numberText(s.conditionHigh),
          numberText(s.largestCoefficient),
          numberText(s.coefficientShare),
          numberText(s.maxError),
          numberText(s.rmse),
          numberText(s.errorShare),
          numberText(s.coefficientErrorShare),
          numberText(s.orderDifference),
          numberText(s.orderShare),
          numberText(s.quantisationShare)};
}

}  // namespace

Result<Section> stabilitySection(const SectionInput&, const JobContext& job) {
  Section section;
  section.name = "stability";
  section.title = "Stability";
  section.summary =
      "What the polynomial fits make of problems that a solver may fail on: lights that are few, coincide or lie on a "
      "ring, columns of one layer or none, weights of zero, luminance over fourteen decades, samples that are not "
      "finite, patches of a millimetre and a kilometre. Each is solved once more in long double, by Householder QR of "
      "the rows themselves (of least norm where they do not determine the solution), and the two polynomials are "
      "compared at all lights of the case and six others, on occupied layers and between them.\n\n"
      "Errors are in units of the case's largest sample: 6e-8 is the rounding of one float, and what the stored "
      "coefficients cost. A value of error_of_bound above 1 would be an error that rounding does not explain. The fits "
      "with a ridge keep small coefficients and float's error everywhere; lpt_paper, which has none, buys small "
      "residuals with a large condition, large coefficients and, at the horizon, errors a thousand times larger. "
      "Fits on the orthogonal path are as sound as the others.";
  section.tables.push_back(emptyTable());
  const JobContext quiet{job.stop, {}, job.threads};
  SWARD_ASSIGN(const std::vector<HardCase> cases, hardCases(quiet));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (job.onProgress) job.onProgress(cases[i].name, static_cast<double>(i) / static_cast<double>(cases.size()));
    for (const HardFit fit : kHardFits) {
      SWARD_ASSIGN(const Stability measured, measureStability(cases[i], hardFitOptions(fit), quiet));
      section.rows.push_back(rowOf(cases[i], fit, measured));
      section.tables.front().rows.push_back(tableRow(cases[i], fit, measured));
    }
    if (job.cancelled()) return Error::cancelled();
  }
  return section;
}

}  // namespace sward::report
