#pragma once

#include "base/result.h"

#include <string>
#include <vector>

namespace sward::base {

struct CurvePoint {
  double x = 0.0;
  double y = 0.0;
  bool operator==(const CurvePoint&) const = default;
};

/// A function through points, monotone cubic (Fritsch and Carlson 1980): between two points it never leaves the range
/// of their values, so no curve overshoots what the user set. Constant beyond the first and the last point.
class Curve {
 public:
  Curve() = default;
  /// A curve through `points`, x strictly increasing and everything finite; else an error that names the point.
  static Result<Curve> fromPoints(std::vector<CurvePoint> points);
  /// The same value everywhere.
  static Curve constant(double value);

  /// Value at x; 0 for an empty curve.
  double operator()(double x) const;
  /// First derivative at x; 0 outside the points.
  double derivative(double x) const;

  const std::vector<CurvePoint>& points() const { return m_points; }
  bool operator==(const Curve& other) const { return m_points == other.m_points; }

 private:
  std::size_t segment(double x) const;
  std::vector<CurvePoint> m_points;
  std::vector<double> m_slopes;  ///< dy/dx at each point
};

/// A curve to start from, in the unit square.
struct CurvePreset {
  const char* name;  ///< for people
  std::vector<CurvePoint> points;
};
/// Constant, linear both ways, ease in, ease out, S, bump, two humps: x from 0 to 1 and y in [0, 1].
const std::vector<CurvePreset>& curvePresets();
/// A preset stretched over the rectangle of a field's axes.
Curve presetCurve(const CurvePreset& preset, double xLow, double xHigh, double yLow, double yHigh);

}  // namespace sward::base
