#include "base/check.h"
#include "lpt/fit.h"
#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt {

Fit constantFit(const FitInput& input, std::span<const std::span<const float>> responses) {
  SWARD_CHECK_EQ(responses.size(), static_cast<std::size_t>(input.channels));
  const auto columns = static_cast<std::size_t>(input.columns), layers = static_cast<std::size_t>(input.layers);
  Fit fit;
  fit.basis = Basis::Constant;
  fit.columns = input.columns;
  fit.layers = input.layers;
  fit.channels = input.channels;
  fit.perColumn = input.layers;
  fit.coefficients.assign(columns * responses.size() * layers, 0.0f);
  fit.layerWeight.assign(columns * layers, 0.0f);
  fit.rank.assign(columns, 0);
  fit.condition.assign(columns, 0.0f);
  fit.weight.assign(columns, 0.0f);
  fit.path.assign(columns, FitPath::Empty);
  const FitOptions options;
  const detail::LightSystem noLights;
  const detail::FitJob work{input, options, noLights, fit};
  for (std::size_t column = 0; column < columns; ++column) {
    double total = 0.0;
    for (std::size_t t = input.columnStart[column]; t < input.columnStart[column + 1]; ++t) {
      const double weight = work.weight(t);
      const bool finite = std::all_of(responses.begin(), responses.end(),
                                      [t](std::span<const float> channel) { return std::isfinite(channel[t]); });
      if (!(weight > 0.0) || !finite) continue;
      total += weight;
      fit.layerWeight[column * layers + input.layer[t]] = detail::storedWeight(weight);
      for (std::size_t c = 0; c < responses.size(); ++c) {
        fit.coefficients[(column * responses.size() + c) * layers + input.layer[t]] = responses[c][t];
      }
    }
    if (!(total > 0.0)) continue;
    fit.weight[column] = detail::storedWeight(total);
    fit.rank[column] = 1;
    fit.condition[column] = 1.0f;
    fit.path[column] = FitPath::Moments;
  }
  return fit;
}

}  // namespace sward::lpt
