#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace sward::report {

/// A rectangle of a plot, in its units, y downward.
struct Box {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;

  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool inside(const Box& other) const {
    return left >= other.left && right <= other.right && top >= other.top && bottom <= other.bottom;
  }
};

/// About how wide text is, in multiples of the size of a sans-serif font; never less than usual fonts need.
double textWidth(std::string_view text);

/// Finds places for the labels of points, so that no label covers another, a point, or the frame's edge; lines are
/// avoided where there is a choice.
class LabelPlacer {
 public:
  explicit LabelPlacer(Box frame) : m_frame(frame) {}
  void avoid(const Box& box) { m_taken.push_back(box); }
  /// A marker: not covered, and labels of others rather do not stand nearer to it than to their own.
  void avoidPoint(double x, double y, double radius) {
    m_taken.push_back({x - radius, y - radius, x + radius, y + radius});
    m_points.push_back({x, y});
  }
  /// A straight line that labels should rather not cross.
  void avoidLine(double x0, double y0, double x1, double y1);

  /// A label of this size for the point at (x, y): its box, the nearest that is free and no other point's, else the
  /// nearest that is free, which is taken then; nothing when none is free near enough.
  std::optional<Box> place(double x, double y, double width, double height);

 private:
  bool isFree(const Box& label, bool linesToo) const;
  bool isNearestTo(double x, double y, const Box& label) const;

  Box m_frame;
  std::vector<Box> m_taken, m_lines;
  std::vector<std::array<double, 2>> m_points;
};

}  // namespace sward::report
