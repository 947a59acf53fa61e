#include "terrain/height_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

/// Value of a cubic's four Bezier points at t.
double bezier(const std::array<double, 4>& b, double t) {
  const double s = 1.0 - t;
  return s * s * s * b[0] + 3.0 * s * t * (s * b[1] + t * b[2]) + t * t * t * b[3];
}

/// The ray's height over a cell's surface, as a function of the distance.
struct Clearance {
  const BezierNet& net;
  glm::dvec2 start{0.0};  ///< in cells from the cell's corner
  glm::dvec2 rate{0.0};   ///< cells a metre
  double z = 0.0, slope = 0.0;

  double at(double t) const {
    const glm::dvec2 place = glm::clamp(start + rate * t, 0.0, 1.0);
    std::array<double, 4> rows;
    for (std::size_t y = 0; y < 4; ++y) rows[y] = bezier(net[y], place.x);
    return z + slope * t - bezier(rows, place.y);
  }
};

/// First t of [a, b] where the clearance is 0 or below, to `tolerance`. Between two ends a function whose second
/// derivative is at most K stays above the chord less K (b - a)^2 / 8.
std::optional<double> firstCrossing(const Clearance& f, double a, double fa, double b, double fb, double curvature,
                                    double tolerance) {
  if (fa <= 0.0) return a;
  const double width = b - a;
  if (fb > 0.0 && std::min(fa, fb) > curvature * width * width / 8.0) return std::nullopt;
  if (width <= tolerance) return fb <= 0.0 ? std::optional(b) : std::nullopt;
  const double middle = 0.5 * (a + b);
  if (middle <= a || middle >= b) return fb <= 0.0 ? std::optional(b) : std::nullopt;
  const double fm = f.at(middle);
  if (const auto hit = firstCrossing(f, a, fa, middle, fm, curvature, tolerance)) return hit;
  return firstCrossing(f, middle, fm, b, fb, curvature, tolerance);
}

/// Walks along one axis from node to node.
struct Axis {
  double start = 0.0, rate = 0.0;  ///< in cells, and cells a metre
  long cell = 0;

  /// Distance at which the ray leaves the node of 2^level cells that holds `cell`, counted from `first`.
  double exit(int level, long first) const {
    if (rate == 0.0) return std::numeric_limits<double>::infinity();
    const long node = ((cell - first) >> level) << level;
    const long border = node + first + (rate > 0.0 ? 1L << level : 0L);
    return (static_cast<double>(border) - start) / rate;
  }
  /// Moves to distance t, without leaving the node; over its border where `leaves`.
  void advance(double t, int level, long first, bool leaves) {
    const long low = (((cell - first) >> level) << level) + first;
    const long high = low + (1L << level) - 1;
    if (leaves) {
      cell = rate > 0.0 ? high + 1 : low - 1;
    } else {
      cell = std::clamp(static_cast<long>(std::floor(start + rate * t)), low, high);
    }
  }
};

}  // namespace

std::optional<double> HeightField::castInCell(const glm::dvec3& from, const glm::dvec3& direction, long column,
                                              long row, double tLow, double tHigh) const {
  const BezierNet cell = net(column, row);
  const glm::dvec2 corner(static_cast<double>(column), static_cast<double>(row));
  const Clearance f{cell, (glm::dvec2(from) - m_grid.origin) / m_grid.cellM - corner,
                    glm::dvec2(direction) / m_grid.cellM, from.z, direction.z};
  const double tolerance = 1e-6 * std::min(m_grid.cellM.x, m_grid.cellM.y) + 1e-9 * tLow;
  const double curvature = curvatureBound(cell) * glm::dot(f.rate, f.rate);
  return firstCrossing(f, tLow, f.at(tLow), tHigh, f.at(tHigh), curvature, tolerance);
}

std::optional<double> HeightField::rayCast(const glm::dvec3& from, const glm::dvec3& direction,
                                           double maxDistanceM) const {
  double t = 0.0, end = maxDistanceM;
  if (!std::isfinite(from.x + from.y + from.z + direction.x + direction.y + direction.z)) return std::nullopt;
  if (from.z > m_whole.high) {
    if (direction.z >= 0.0) return std::nullopt;
    t = (m_whole.high - from.z) / direction.z;
  } else if (direction.z > 0.0) {
    end = std::min(end, (m_whole.high - from.z) / direction.z);
  }
  const glm::dvec2 start = (glm::dvec2(from) - m_grid.origin) / m_grid.cellM;
  const glm::dvec2 rate = glm::dvec2(direction) / m_grid.cellM;
  const auto cellOf = [&](double u) { return static_cast<long>(std::clamp(std::floor(u), -1e15, 1e15)); };
  Axis x{start.x, rate.x, cellOf(start.x + rate.x * t)}, y{start.y, rate.y, cellOf(start.y + rate.y * t)};
  const int top = static_cast<int>(m_bounds.size()) - 1;
  int level = top;
  while (t <= end) {
    const double exitX = x.exit(level, m_firstCell), exitY = y.exit(level, m_firstCell);
    const double exit = std::max(std::min({exitX, exitY, end}), t);
    const double lowest = from.z + direction.z * (direction.z < 0.0 ? exit : t);
    const bool above = lowest > nodeRange(level, x.cell, y.cell).high;
    if (!above && level > 0) {
      --level;
      continue;
    }
    if (!above) {
      if (const auto hit = castInCell(from, direction, x.cell, y.cell, t, exit)) return hit;
    }
    if (exit >= end) return std::nullopt;
    x.advance(exit, level, m_firstCell, exitX <= exitY);
    y.advance(exit, level, m_firstCell, exitY <= exitX);
    t = exit;
    level = std::min(level + 1, top);
  }
  return std::nullopt;
}

}  // namespace sward::terrain
