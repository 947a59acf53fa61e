#pragma once

#include "base/hash.h"
#include "image/image.h"
#include "report/choice.h"

#include <map>
#include <string>
#include <utility>
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

/// References by what they show: candidates that share their tiles share them, too.
class ReferenceStore {
 public:
  struct Truth {
    image::Image display;
    double noise = 0.0;  ///< RMSE of display values
  };
  const Truth* find(const base::Hash128& key) const {
    const auto found = m_truths.find(key);
    return found == m_truths.end() ? nullptr : &found->second;
  }
  const Truth& add(const base::Hash128& key, Truth truth) { return m_truths[key] = std::move(truth); }

 private:
  std::map<base::Hash128, Truth> m_truths;
};

/// Bakes a candidate without any disk, or (`floor`) its layers with light traced for the project's sun; draws every
/// view and compares it with the reference of the same tiles.
Result<TrialMeasurement> measureTrial(const ChoiceInput& input, const Candidate& candidate, bool floor,
                                      ReferenceStore& references, const JobContext& job);

}  // namespace sward::report
