#include "base/curve.h"

#include <algorithm>
#include <cmath>

namespace sward::base {
namespace {

/// Slopes after Fritsch and Carlson (1980), in the harmonic form of Fritsch and Butland (1984), which satisfies their
/// sufficient condition for monotonicity by construction.
std::vector<double> monotoneSlopes(const std::vector<CurvePoint>& p) {
  const std::size_t n = p.size();
  std::vector<double> slopes(n, 0.0);
  if (n < 2) return slopes;
  std::vector<double> width(n - 1), secant(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    width[i] = p[i + 1].x - p[i].x;
    secant[i] = (p[i + 1].y - p[i].y) / width[i];
  }
  if (n == 2) return {secant[0], secant[0]};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (secant[i - 1] * secant[i] <= 0.0) continue;
    const double w1 = 2.0 * width[i] + width[i - 1];
    const double w2 = width[i] + 2.0 * width[i - 1];
    slopes[i] = (w1 + w2) / (w1 / secant[i - 1] + w2 / secant[i]);
  }
  // One-sided three-point ends, limited to keep the first and last segment monotone.
  const auto end = [](double h0, double h1, double d0, double d1) {
    double slope = ((2.0 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
    if (slope * d0 <= 0.0) return 0.0;
    if (d0 * d1 <= 0.0 && std::abs(slope) > 3.0 * std::abs(d0)) slope = 3.0 * d0;
    return std::abs(slope) > 3.0 * std::abs(d0) ? 3.0 * d0 : slope;
  };
  slopes[0] = end(width[0], width[1], secant[0], secant[1]);
  slopes[n - 1] = end(width[n - 2], width[n - 3], secant[n - 2], secant[n - 3]);
  return slopes;
}

}  // namespace

Result<Curve> Curve::fromPoints(std::vector<CurvePoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string where = "point " + std::to_string(i);
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
      return Error::badInput("the curve has a value that is not finite", where, "Give numbers.");
    }
    if (i > 0 && points[i].x <= points[i - 1].x) {
      return Error::badInput("the curve's x values do not increase", where, "Sort the points and drop doubles.");
    }
  }
  Curve curve;
  curve.m_slopes = monotoneSlopes(points);
  curve.m_points = std::move(points);
  return curve;
}

Curve Curve::constant(double value) {
  Curve curve;
  curve.m_points = {{0.0, value}};
  curve.m_slopes = {0.0};
  return curve;
}

std::size_t Curve::segment(double x) const {
  const auto above = std::upper_bound(m_points.begin(), m_points.end(), x,
                                      [](double value, const CurvePoint& point) { return value < point.x; });
  return static_cast<std::size_t>(above - m_points.begin()) - 1;
}

double Curve::operator()(double x) const {
  if (m_points.empty()) return 0.0;
  if (!(x > m_points.front().x)) return m_points.front().y;
  if (x >= m_points.back().x) return m_points.back().y;
  const std::size_t i = segment(x);
  const double h = m_points[i + 1].x - m_points[i].x;
  const double t = (x - m_points[i].x) / h;
  const double s = 1.0 - t;
  const double value = s * s * (1.0 + 2.0 * t) * m_points[i].y + t * t * (1.0 + 2.0 * s) * m_points[i + 1].y +
                       h * s * t * (s * m_slopes[i] - t * m_slopes[i + 1]);
  // Rounding must not break the promise either.
  const auto [low, high] = std::minmax(m_points[i].y, m_points[i + 1].y);
  return std::clamp(value, low, high);
}

double Curve::derivative(double x) const {
  if (m_points.size() < 2 || x < m_points.front().x || x > m_points.back().x) return 0.0;
  const std::size_t i = std::min(segment(x), m_points.size() - 2);
  const double h = m_points[i + 1].x - m_points[i].x;
  const double t = (x - m_points[i].x) / h;
  const double secant = (m_points[i + 1].y - m_points[i].y) / h;
  return 6.0 * t * (1.0 - t) * secant + (1.0 - t) * (1.0 - 3.0 * t) * m_slopes[i] +
         t * (3.0 * t - 2.0) * m_slopes[i + 1];
}

}  // namespace sward::base
