#pragma once

#include "report/hard_cases.h"

#include <array>
#include <limits>

namespace sward::report {

/// The fits that are tried on every hard case.
enum class HardFit : std::uint8_t { Lpt, LptPaper, Ptm };
inline constexpr std::array kHardFits{HardFit::Lpt, HardFit::LptPaper, HardFit::Ptm};
const char* hardFitName(HardFit fit);  ///< lpt, lpt_paper, ptm
lpt::FitOptions hardFitOptions(HardFit fit);

/// How a fit did on a hard case. A share is the largest quotient of a measured value and the bound that was derived for
/// it at the same place (core/report/stability_bounds.h); above 1 something is wrong.
struct Stability {
  int moments = 0, orthogonal = 0, empty = 0;  ///< columns by the path they took
  int wrongPaths = 0;                          ///< columns on another than the contract of lpt::FitPath says
  int wrongRanks = 0;                          ///< columns whose rank is not the oracle's
  bool finite = true;                          ///< coefficients, conditions and weights all are
  double scale = 0.0;                          ///< the largest finite |sample| of the case
  double condition = 0.0;                      ///< the largest that the fit states
  /// The stated condition over the oracle's, least and most.
  double conditionLow = std::numeric_limits<double>::infinity(), conditionHigh = 0.0;
  double largestCoefficient = 0.0, coefficientShare = 0.0;  ///< |b|, against the bound from ridge or singular values
  /// |f - oracle| over `scale` (as it is where that is 0), at all lights of the case and six others, on layers occupied
  /// or not.
  double maxError = 0.0, rmse = 0.0, errorShare = 0.0;
  double coefficientErrorShare = 0.0;  ///< |b - oracle|, where the rank is full
  /// Largest change of f over `scale` at the same places when lights and layers come in reverse order.
  double orderDifference = 0.0, orderShare = 0.0;
  double quantisationShare = 0.0;                               ///< error of 8 and 16 bits, against half a step
  double rankMargin = std::numeric_limits<double>::infinity();  ///< the least of OracleSolution's
};

/// `options` of basis Lpt or Ptm; wrongPaths holds for the default ridges. Errors of lpt::fit.
Result<Stability> measureStability(const HardCase& one, const lpt::FitOptions& options, const JobContext& job);

}  // namespace sward::report
