#include "report/stability_bounds.h"

#include <algorithm>
#include <cmath>

namespace sward::report::detail {

double solverBound(const OracleSolution& exact, std::size_t channel, bool normalEquations) {
  const OracleSolution::Channel& c = exact.channels[channel];
  const long double gamma = 0x1p-53L * (exact.rows + exact.unknowns) * exact.unknowns;
  const long double x = exact.norm(channel), s = exact.largest, k = exact.gapCondition;
  if (normalEquations) return static_cast<double>(gamma * k * k * (x + c.rightHandSide / s));
  return static_cast<double>(gamma * (2 * k * x + k * c.rightHandSide / s + k * k * c.residual / s));
}

double valueBound(double solver, std::span<const float> coefficients, std::span<const double> phi,
                  std::span<const double> centred) {
  double terms = 0.0, sum = 0.0, norm = 0.0;
  for (std::size_t j = 0; j < phi.size(); ++j) {
    terms += std::abs(static_cast<double>(coefficients[j]) * phi[j]);
    sum += std::abs(phi[j]);
    norm += centred[j] * centred[j];
  }
  return solver * std::sqrt(norm) + (0x1p-24 + 0x1p-50) * terms + 0x1p-150 * sum;
}

double coefficientBound(const OracleSolution& exact, std::size_t channel, const lpt::FitOptions& options) {
  const OracleSolution::Channel& c = exact.channels[channel];
  // What float's rounding of the largest may add.
  constexpr double kStored = 1.0 + 0x1p-22;
  const auto samples = static_cast<double>(c.rightHandSide);
  if (options.paper) return kStored * samples * static_cast<double>(exact.condition / exact.largest);
  const bool layered = options.basis == lpt::Basis::Lpt;
  const double mean = std::abs(static_cast<double>(c.mean));
  const double spread = std::sqrt(std::max(samples * samples - mean * mean, 0.0)) + 0x1p-25 * samples;
  double factor = std::sqrt(5.5 / options.lightRidge + (layered ? 9.0 / options.layerRidge : 0.0));
  if (layered) factor += 3.0 / std::sqrt(options.layerRidge);
  return kStored * (mean + spread * factor);
}

}  // namespace sward::report::detail
