#include "lpt/hemispherical_harmonics.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::lpt {
namespace {

double normalisation(int l, int m) {
  double factorials = 1.0;  // (l + m)! / (l - m)!
  for (int i = l - m + 1; i <= l + m; ++i) factorials *= i;
  return std::sqrt((2.0 * l + 1.0) / (2.0 * std::numbers::pi * factorials));
}

/// P_l^m without the Condon-Shortley phase, l <= 2; `s` is sqrt(1 - x^2).
double legendre(int l, int m, double x, double s) {
  if (l == 0) return 1.0;
  if (l == 1) return m == 0 ? x : s;
  return m == 0 ? 0.5 * (3.0 * x * x - 1.0) : m == 1 ? 3.0 * x * s : 3.0 * s * s;
}

}  // namespace

std::vector<double> hemisphericalHarmonics(const glm::dvec3& light, int bands) {
  SWARD_CHECK(bands >= 1 && bands <= 3);
  const double z = std::clamp(light.z, 0.0, 1.0);
  const double x = 2.0 * z - 1.0, s = 2.0 * std::sqrt(z * (1.0 - z));  // s^2 = 1 - x^2
  const double phi = std::atan2(light.y, light.x);
  std::vector<double> values;
  for (int l = 0; l < bands; ++l) {
    for (int m = -l; m <= l; ++m) {
      const int order = std::abs(m);
      const double around = m == 0 ? 1.0 : std::numbers::sqrt2 * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
      values.push_back(normalisation(l, order) * legendre(l, order, x, s) * around);
    }
  }
  return values;
}

}  // namespace sward::lpt
