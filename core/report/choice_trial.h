#pragma once

#include "report/choice.h"

#include <string>
#include <vector>

/// Private to choice.cpp: one candidate, baked, drawn and compared.
namespace sward::report {

struct ViewError {
  std::string name;
  image::ErrorFigures figures;  ///< of display values; rmse with the reference's noise in it
  double noise = 0.0;           ///< the reference's own, as RMSE of display values
  /// Of a metric: RMSE and PSNR with the noise taken off in quadrature.
  double value(ErrorBound metric) const;
};

struct TrialMeasurement {
  std::vector<ViewError> views;
  double drawMs = 0.0, relightMs = 0.0;
};

/// Bakes a candidate without any disk, or (`floor`) its layers with light traced for the project's sun; draws every
/// view and compares it with the reference of the same tiles.
Result<TrialMeasurement> measureTrial(const ChoiceInput& input, const Candidate& candidate, bool floor,
                                      const JobContext& job);

}  // namespace sward::report
