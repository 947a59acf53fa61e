#pragma once

#include "base/curve.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

/// What the curve editor does to points, without a user interface.
namespace sward::editor {

using CurvePoints = std::vector<base::CurvePoint>;
using PointSelection = std::set<std::size_t>;

/// Where points may stand. Two points keep at least leastGap() apart in x, so that no drag makes them meet.
struct CurveLimits {
  double xLow = 0.0, xHigh = 1.0;
  double yLow = 0.0, yHigh = 1.0;
  double leastGap() const { return (xHigh - xLow) * 1e-4; }
  bool operator==(const CurveLimits&) const = default;
};

/// Files hold no more points in a curve (project/reader.cpp).
inline constexpr std::size_t kMaxCurvePoints = 256;

/// The selected points moved together, by as much of (dx, dy) as limits and the unselected neighbours allow. Points
/// keep their order.
CurvePoints movedPoints(const CurvePoints& points, const PointSelection& selection, double dx, double dy,
                        const CurveLimits& limits);
/// Adds a point, held in the limits, and returns its index; nothing where a point stands already, or when there are as
/// many as files hold.
std::optional<std::size_t> insertPoint(CurvePoints& points, base::CurvePoint point, const CurveLimits& limits);
CurvePoints withoutPoints(const CurvePoints& points, const PointSelection& selection);
/// Points from elsewhere, held in the limits, in order of x; of points that meet the first one stays.
CurvePoints fittedPoints(CurvePoints points, const CurveLimits& limits);

/// The multiple of `step` that is nearest; the value itself for steps that are not above 0.
double snappedTo(double value, double step);
/// A step of 1, 2 or 5 times a power of ten that divides `span` into about `parts`.
double niceStep(double span, double parts);
/// A tick's label with the decimals that its step asks for; never "-0".
std::string tickText(double value, double step);

/// One point a line, "x y" with every digit: for clipboards, spreadsheets and people.
std::string pointsText(const CurvePoints& points);
/// Reads pairs of numbers whatever stands between them; nothing for any other text or an odd count.
std::optional<CurvePoints> parsedPoints(const std::string& text);

}  // namespace sward::editor
