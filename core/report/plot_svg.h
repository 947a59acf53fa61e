#pragma once

#include "report/section.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace sward::report {

/// Gives every series' name one look (colour and shape of its marker) in all plots of a report, in order of appearance.
class SeriesLooks {
 public:
  static constexpr std::size_t kColours = 7, kShapes = 5;
  explicit SeriesLooks(const std::vector<Section>& sections);
  SeriesLooks() = default;
  /// 0 for a name that no section has.
  std::size_t of(const std::string& name) const;

 private:
  std::map<std::string, std::size_t> m_looks;
};

/// Points that no other beats: no other is at most as large in both x and y and smaller in one. By rising x; of equal
/// points the first alone. Points that are not finite are on no front.
std::vector<Plot::Point> paretoFront(const std::vector<Plot::Point>& points);

struct PlotText {
  std::string svg;
  int leftOut = 0;  ///< points that the axes cannot show: not finite, or not above 0 on a logarithmic axis
};

/// The plot as SVG 1.1: grid, ticks, points with their values as <title>, labels beside points that do not overlap, a
/// legend where some series has no label of its own, the front as a staircase. `alone`: a file of its own, with the
/// style; else an element of a page that has it. Well-formed whatever the texts hold.
PlotText plotSvg(const Plot& plot, const SeriesLooks& looks, bool alone);

}  // namespace sward::report
