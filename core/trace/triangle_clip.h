#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

namespace sward::trace {

/// A corner of a part of a triangle: where it lies, in cells of a grid, and in the triangle's own coordinates
/// (a + u (b - a) + v (c - a)).
struct ClipCorner {
  glm::dvec3 at;
  double u, v;
};

/// A convex polygon. A triangle cut by both planes of three axes has at most nine corners.
struct ClipPolygon {
  static constexpr std::size_t kMost = 12;
  std::array<ClipCorner, kMost> corners;
  std::size_t count = 0;

  void add(const ClipCorner& corner) { corners[count++] = corner; }
  std::span<const ClipCorner> all() const { return {corners.data(), count}; }
  /// Of the whole triangle's area: twice the polygon's area in (u, v). An affine map keeps ratios of areas in a plane.
  double share() const {
    double twice = 0.0;
    for (std::size_t i = 2; i < count; ++i) {
      const ClipCorner &a = corners[0], &b = corners[i - 1], &c = corners[i];
      twice += (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
    }
    return std::abs(twice);
  }
};

/// Cuts a polygon at `plane` of an axis into what lies below and above (Sutherland and Hodgman 1974).
inline void splitPolygon(const ClipPolygon& polygon, int axis, double plane, ClipPolygon& below, ClipPolygon& above) {
  below.count = above.count = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipCorner& from = polygon.corners[i];
    const ClipCorner& to = polygon.corners[i + 1 == polygon.count ? 0 : i + 1];
    const double d0 = from.at[axis] - plane, d1 = to.at[axis] - plane;
    if (d0 <= 0.0) below.add(from);
    if (d0 >= 0.0) above.add(from);
    if ((d0 < 0.0 && d1 > 0.0) || (d0 > 0.0 && d1 < 0.0)) {
      const double t = d0 / (d0 - d1);
      ClipCorner cut{from.at + t * (to.at - from.at), from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)};
      cut.at[axis] = plane;
      below.add(cut);
      above.add(cut);
    }
  }
}

/// Calls part(cell, polygon) for every cell of the unit grid that a polygon passes through; cells are half-open, and
/// not wrapped. The parts' shares sum to the polygon's to rounding; parts without area are left out.
template <typename Part>
void forEachCell(const ClipPolygon& polygon, const Part& part, int axis = 2, glm::ivec3 cell = glm::ivec3(0)) {
  double low = polygon.corners[0].at[axis], high = low;
  for (const ClipCorner& corner : polygon.all()) {
    low = std::min(low, corner.at[axis]);
    high = std::max(high, corner.at[axis]);
  }
  ClipPolygon rest = polygon;
  const auto first = static_cast<int>(std::floor(low)), last = static_cast<int>(std::floor(high));
  for (int k = first; k <= last && rest.count >= 3; ++k) {
    ClipPolygon inside, beyond;
    if (k == last) {
      inside = rest;
    } else {
      splitPolygon(rest, axis, k + 1.0, inside, beyond);
      rest = beyond;
    }
    if (inside.count < 3 || !(inside.share() > 0.0)) continue;
    cell[axis] = k;
    if (axis == 0) {
      part(cell, inside);
    } else {
      forEachCell(inside, part, axis - 1, cell);
    }
  }
}

}  // namespace sward::trace
