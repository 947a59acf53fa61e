#include "widgets/curve_points.h"

#include "widgets/units.h"
#include "widgets/value_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sward::editor {

CurvePoints movedPoints(const CurvePoints& points, const PointSelection& selection, double dx, double dy,
                        const CurveLimits& limits) {
  const double gap = limits.leastGap();
  // Room is never negative: what stands outside already may come back in, but is not thrown about.
  const auto hold = [](double& delta, double roomBelow, double roomAbove) {
    delta = std::clamp(delta, -std::max(0.0, roomBelow), std::max(0.0, roomAbove));
  };
  for (const std::size_t i : selection) {
    if (i >= points.size()) continue;
    const base::CurvePoint& p = points[i];
    const bool freeLeft = i == 0 || selection.contains(i - 1);
    const bool freeRight = i + 1 == points.size() || selection.contains(i + 1);
    hold(dx, freeLeft ? p.x - limits.xLow : std::min(p.x - limits.xLow, p.x - points[i - 1].x - gap),
         freeRight ? limits.xHigh - p.x : std::min(limits.xHigh - p.x, points[i + 1].x - p.x - gap));
    hold(dy, p.y - limits.yLow, limits.yHigh - p.y);
  }
  CurvePoints moved = points;
  for (const std::size_t i : selection) {
    if (i >= points.size()) continue;
    moved[i].x = std::clamp(points[i].x + dx, std::min(points[i].x, limits.xLow), std::max(points[i].x, limits.xHigh));
    moved[i].y = std::clamp(points[i].y + dy, std::min(points[i].y, limits.yLow), std::max(points[i].y, limits.yHigh));
  }
  return moved;
}

std::optional<std::size_t> insertPoint(CurvePoints& points, base::CurvePoint point, const CurveLimits& limits) {
  if (points.size() >= kMaxCurvePoints) return std::nullopt;
  point.x = std::clamp(point.x, limits.xLow, limits.xHigh);
  point.y = std::clamp(point.y, limits.yLow, limits.yHigh);
  const auto after = std::lower_bound(points.begin(), points.end(), point.x,
                                      [](const base::CurvePoint& p, double x) { return p.x < x; });
  const double gap = limits.leastGap();
  if (after != points.end() && after->x - point.x < gap) return std::nullopt;
  if (after != points.begin() && point.x - std::prev(after)->x < gap) return std::nullopt;
  const auto index = static_cast<std::size_t>(after - points.begin());
  points.insert(after, point);
  return index;
}

CurvePoints withoutPoints(const CurvePoints& points, const PointSelection& selection) {
  CurvePoints left;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!selection.contains(i)) left.push_back(points[i]);
  }
  return left;
}

CurvePoints fittedPoints(CurvePoints points, const CurveLimits& limits) {
  std::stable_sort(points.begin(), points.end(),
                   [](const base::CurvePoint& a, const base::CurvePoint& b) { return a.x < b.x; });
  CurvePoints fitted;
  for (const base::CurvePoint& point : points) insertPoint(fitted, point, limits);
  return fitted;
}

double snappedTo(double value, double step) {
  return step > 0.0 ? cleaned(std::round(value / step) * step) : value;
}

double niceStep(double span, double parts) {
  if (!(span > 0.0) || !(parts > 0.0) || !std::isfinite(span)) return 1.0;
  const double rough = span / parts;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * decade * (1.0 + 1e-9)) return cleaned(factor * decade);
  }
  return cleaned(10.0 * decade);
}

std::string tickText(double value, double step) {
  const int decimals = step < 1.0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9) : 0;
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string pointsText(const CurvePoints& points) {
  std::string text;
  for (const base::CurvePoint& point : points) text += valueText(point.x) + " " + valueText(point.y) + "\n";
  return text;
}

std::optional<CurvePoints> parsedPoints(const std::string& text) {
  const auto numbers = numbersIn(text);
  if (!numbers || numbers->empty() || numbers->size() % 2 != 0) return std::nullopt;
  CurvePoints points;
  for (std::size_t i = 0; i < numbers->size(); i += 2) points.push_back({(*numbers)[i], (*numbers)[i + 1]});
  return points;
}

}  // namespace sward::editor
