#include "report/plot_labels.h"

#include "report/markup.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::report {
namespace {

constexpr double kGap = 3.0;   ///< beside a label, so that two words do not become one
constexpr double kStep = 4.0;  ///< length of the boxes that stand for a line

double characterWidth(char c) {
  constexpr std::string_view kNarrow = "iljtfr.,:;'|!()[] -";
  constexpr std::string_view kWide = "mwMW%@";
  if (kNarrow.find(c) != std::string_view::npos) return 0.36;
  if (kWide.find(c) != std::string_view::npos) return 0.90;
  return c >= 'A' && c <= 'Z' ? 0.72 : 0.58;
}

}  // namespace

double textWidth(std::string_view text) {
  double width = 0.0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) width += characterWidth(c);
    if (byte >= 0xc0) width += byte >= 0xe3 ? 1.0 : 0.66;  // a whole square beyond Latin, Greek and punctuation
  }
  return width;
}

void LabelPlacer::avoidLine(double x0, double y0, double x1, double y1) {
  const double length = std::hypot(x1 - x0, y1 - y0);
  const int parts = std::clamp(static_cast<int>(std::ceil(length / kStep)), 1, 1000);
  for (int i = 0; i <= parts; ++i) {
    const double t = static_cast<double>(i) / parts;
    const double x = x0 + t * (x1 - x0), y = y0 + t * (y1 - y0);
    m_lines.push_back({x - 1.0, y - 1.0, x + 1.0, y + 1.0});
  }
}

bool LabelPlacer::isFree(const Box& label, bool linesToo) const {
  const Box box{label.left - kGap, label.top, label.right + kGap, label.bottom};
  const auto covers = [&](const Box& other) { return box.overlaps(other); };
  if (!label.inside(m_frame) || std::any_of(m_taken.begin(), m_taken.end(), covers)) return false;
  return !linesToo || std::none_of(m_lines.begin(), m_lines.end(), covers);
}

bool LabelPlacer::isNearestTo(double x, double y, const Box& label) const {
  const auto distance = [&](double px, double py) {
    return std::hypot(px - std::clamp(px, label.left, label.right), py - std::clamp(py, label.top, label.bottom));
  };
  const double own = distance(x, y);
  return std::none_of(m_points.begin(), m_points.end(),
                      [&](const auto& point) { return distance(point[0], point[1]) < own; });
}

std::optional<Box> LabelPlacer::place(double x, double y, double width, double height) {
  // Where the label's middle lies from the point, in half labels: right and left read best.
  constexpr std::array<std::array<double, 2>, 8> kSides{
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}}};
  constexpr std::array kDistances{7.0, 14.0, 24.0, 36.0, 50.0};
  struct Wish {
    bool noLines, nearest;
  };
  for (const Wish wish : {Wish{true, true}, {false, true}, {true, false}, {false, false}}) {
    for (const double distance : kDistances) {
      for (const auto& [across, down] : kSides) {
        const double middleX = x + across * (distance + 0.5 * width);
        const double middleY = y + down * (distance * (across == 0.0 ? 1.0 : 0.7) + 0.5 * height);
        const Box box{middleX - 0.5 * width, middleY - 0.5 * height, middleX + 0.5 * width, middleY + 0.5 * height};
        if (!isFree(box, wish.noLines) || (wish.nearest && !isNearestTo(x, y, box))) continue;
        m_taken.push_back(box);
        return box;
      }
    }
  }
  return std::nullopt;
}

}  // namespace sward::report
