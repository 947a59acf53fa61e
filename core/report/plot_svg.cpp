#include "report/plot_svg.h"

#include "report/assets.h"
#include "report/markup.h"
#include "report/plot_axis.h"
#include "report/plot_labels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::report {
namespace {

// The page shows plots at about this size, so that text has its own.
constexpr double kWidth = 540.0, kHeight = 372.0;
constexpr Box kFrame{64.0, 12.0, 520.0, 318.0};
constexpr Box kLabels{64.0, 4.0, 538.0, 317.0};  ///< where labels may stand
constexpr double kLabelSize = 12.0;              ///< of the font, as plotStyle() has it
constexpr double kLegendLine = 20.0;             ///< of the legend's lines

std::string number(double value) {
  return fixedText(value, 1);
}

/// Closes itself: <name a b c/>.
std::string element(const std::string& name, const std::string& attributes) {
  return "<" + name + " " + attributes + "/>\n";
}

std::string attribute(const char* name, double value) {
  return std::string(name) + "=\"" + number(value) + "\" ";
}

std::string line(double x0, double y0, double x1, double y1, const std::string& style) {
  return element("line", "class=\"" + style + "\" " + attribute("x1", x0) + attribute("y1", y0) + attribute("x2", x1) +
                             attribute("y2", y1));
}

std::string text(double x, double y, const std::string& style, const std::string& anchor, const std::string& words) {
  return "<text class=\"" + style + "\" " + attribute("x", x) + attribute("y", y) + "text-anchor=\"" + anchor + "\">" +
         escaped(words) + "</text>\n";
}

std::string look(std::size_t index) {
  return "sw-c" + std::to_string(index % SeriesLooks::kColours);
}

/// The outline of a marker of about 5 units' radius about (x, y); shapes differ so that colour is not needed.
std::string markerPath(std::size_t shape, double x, double y) {
  const auto at = [&](double dx, double dy) { return number(x + dx) + " " + number(y + dy); };
  switch (shape % SeriesLooks::kShapes) {
    case 0:
      return "M" + at(-4.8, 0) + "a4.8 4.8 0 1 0 9.6 0a4.8 4.8 0 1 0 -9.6 0z";
    case 1:
      return "M" + at(-4.3, -4.3) + "h8.6v8.6h-8.6z";
    case 2:
      return "M" + at(0, -5.6) + "L" + at(5.2, 3.8) + "L" + at(-5.2, 3.8) + "z";
    case 3:
      return "M" + at(0, -6.0) + "L" + at(6.0, 0) + "L" + at(0, 6.0) + "L" + at(-6.0, 0) + "z";
    default:
      return "M" + at(0, 5.6) + "L" + at(5.2, -3.8) + "L" + at(-5.2, -3.8) + "z";
  }
}

/// A point that is shown, in the plot's units.
struct Mark {
  double x = 0.0, y = 0.0;
  std::size_t series = 0;
  const Plot::Point* point = nullptr;
  bool front = false;
  std::string label;
};

class Drawing {
 public:
  Drawing(const Plot& plot, const SeriesLooks& looks) : m_plot(plot), m_looks(looks), m_placer(kLabels) {
    collect();
    chooseLabels();
  }

  PlotText draw(bool alone) {
    std::string body = grid();
    body += lines();
    body += front();
    body += markers();
    body += labels();  // after all that they must not cover
    body += legend();
    const std::string title = escaped(m_plot.title);
    std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sw-plot\" viewBox=\"0 0 " + number(kWidth) +
                      " " + number(m_height) + "\" role=\"img\" aria-label=\"" + title + "\"";
    out += alone ? " width=\"" + number(kWidth) + "\" height=\"" + number(m_height) + "\">\n" : ">\n";
    if (alone) {
      out += "<title>" + title + "</title>\n<style>" + std::string(plotStyle()) + "</style>\n";
      out += element("rect", "class=\"sw-ground\" width=\"100%\" height=\"100%\"");
    }
    return {out + body + "</svg>\n", m_leftOut};
  }

 private:
  void collect();
  void chooseLabels();
  std::string grid() const;
  std::string lines();
  std::string front();
  std::string markers();
  std::string labels();
  std::string legend();
  std::string legendEntry(double x, double y, std::size_t series) const;
  std::string nameOf(const Mark& mark) const;
  double across(double x) const { return kFrame.left + m_x.place(x) * (kFrame.right - kFrame.left); }
  double down(double y) const { return kFrame.bottom - m_y.place(y) * (kFrame.bottom - kFrame.top); }
  std::size_t lookOf(std::size_t series) const { return m_looks.of(m_plot.series[series].name); }

  const Plot& m_plot;
  const SeriesLooks& m_looks;
  LabelPlacer m_placer;
  Axis m_x, m_y;
  std::vector<Mark> m_marks;
  std::vector<Plot::Point> m_front;
  std::vector<bool> m_named;  ///< of series: some label says which it is
  int m_leftOut = 0;
  double m_height = kHeight;
};

void Drawing::collect() {
  const auto shown = [](double value, bool log) { return std::isfinite(value) && (!log || value > 0.0); };
  std::vector<double> xs, ys;
  std::vector<Plot::Point> points;
  for (std::size_t s = 0; s < m_plot.series.size(); ++s) {
    for (const Plot::Point& point : m_plot.series[s].points) {
      if (!shown(point.x, m_plot.logX) || !shown(point.y, m_plot.logY)) {
        ++m_leftOut;
        continue;
      }
      xs.push_back(point.x);
      ys.push_back(point.y);
      points.push_back(point);
      m_marks.push_back({0.0, 0.0, s, &point, false, {}});
    }
  }
  const bool curves = !m_plot.series.empty() && std::all_of(m_plot.series.begin(), m_plot.series.end(),
                                                            [](const Plot::Series& series) { return series.line; });
  m_x = curves ? domainAxisOf(xs, m_plot.logX) : axisOf(xs, m_plot.logX);
  m_y = axisOf(ys, m_plot.logY);
  if (m_plot.pareto) m_front = paretoFront(points);
  for (Mark& mark : m_marks) {
    mark.x = across(mark.point->x);
    mark.y = down(mark.point->y);
    mark.front = std::any_of(m_front.begin(), m_front.end(),
                             [&](const Plot::Point& p) { return p.x == mark.point->x && p.y == mark.point->y; });
  }
}

std::string Drawing::nameOf(const Mark& mark) const {
  const std::string& series = m_plot.series[mark.series].name;
  const std::string& own = mark.point->label;
  return own.empty() || own == series ? series : series.empty() ? own : series + ", " + own;
}

/// A point's own label; else the series' name at its only or its last point.
void Drawing::chooseLabels() {
  m_named.assign(m_plot.series.size(), false);
  for (std::size_t i = 0; i < m_marks.size(); ++i) {
    Mark& mark = m_marks[i];
    const bool last = i + 1 == m_marks.size() || m_marks[i + 1].series != mark.series;
    mark.label = mark.point->label;
    if (mark.label.empty() && last) mark.label = m_plot.series[mark.series].name;
  }
}

std::string Drawing::grid() const {
  std::string out;
  for (const Axis::Tick& tick : m_x.ticks) {
    const double x = across(tick.value);
    out += line(x, kFrame.top, x, kFrame.bottom, tick.label.empty() ? "sw-grid sw-minor" : "sw-grid");
    if (!tick.label.empty()) out += text(x, kFrame.bottom + 17.0, "sw-tick", "middle", tick.label);
  }
  for (const Axis::Tick& tick : m_y.ticks) {
    const double y = down(tick.value);
    out += line(kFrame.left, y, kFrame.right, y, tick.label.empty() ? "sw-grid sw-minor" : "sw-grid");
    if (!tick.label.empty()) out += text(kFrame.left - 8.0, y + 4.0, "sw-tick", "end", tick.label);
  }
  out += line(kFrame.left, kFrame.bottom, kFrame.right, kFrame.bottom, "sw-axis");
  out += line(kFrame.left, kFrame.top, kFrame.left, kFrame.bottom, "sw-axis");
  const std::string logX = m_plot.logX ? " (logarithmic)" : "", logY = m_plot.logY ? " (logarithmic)" : "";
  out += text(0.5 * (kFrame.left + kFrame.right), kFrame.bottom + 40.0, "sw-name", "middle", m_plot.xLabel + logX);
  const double middle = 0.5 * (kFrame.top + kFrame.bottom);
  out += "<text class=\"sw-name\" text-anchor=\"middle\" transform=\"translate(16 " + number(middle) +
         ") rotate(-90)\">" + escaped(m_plot.yLabel + logY) + "</text>\n";
  return out;
}

std::string Drawing::lines() {
  std::string out;
  for (std::size_t i = 1; i < m_marks.size(); ++i) {
    const Mark &from = m_marks[i - 1], &to = m_marks[i];
    if (from.series != to.series || !m_plot.series[to.series].line) continue;
    out += line(from.x, from.y, to.x, to.y, "sw-line " + look(lookOf(to.series)));
    m_placer.avoidLine(from.x, from.y, to.x, to.y);
  }
  return out;
}

/// The staircase between what is reached and what is not: everything above and right of it is beaten by some point.
std::string Drawing::front() {
  if (m_front.empty()) return {};
  std::string path = "M" + number(across(m_front.front().x)) + " " + number(kFrame.top);
  double x = across(m_front.front().x), y = kFrame.top;
  const auto lineTo = [&](double nextX, double nextY) {
    path += "L" + number(nextX) + " " + number(nextY);
    m_placer.avoidLine(x, y, nextX, nextY);
    x = nextX;
    y = nextY;
  };
  for (const Plot::Point& point : m_front) {
    lineTo(across(point.x), y);
    lineTo(x, down(point.y));
  }
  lineTo(kFrame.right, y);
  const std::string region = path + "L" + number(kFrame.right) + " " + number(kFrame.top) + "z";
  return element("path", "class=\"sw-beaten\" d=\"" + region + "\"") +
         element("path", "class=\"sw-front\" d=\"" + path + "\"");
}

std::string Drawing::markers() {
  std::string out;
  for (const Mark& mark : m_marks) {
    const std::size_t index = lookOf(mark.series);
    const bool hollow = m_plot.pareto && !mark.front;
    out += "<path class=\"sw-mark " + look(index) + (hollow ? " sw-hollow" : "") + "\" d=\"" +
           markerPath(index, mark.x, mark.y) + "\"><title>" +
           escaped(nameOf(mark) + "\n" + m_plot.xLabel + ": " + figureText(mark.point->x, 4) + "\n" + m_plot.yLabel +
                   ": " + figureText(mark.point->y, 4)) +
           "</title></path>\n";
    m_placer.avoidPoint(mark.x, mark.y, 6.0);
  }
  return out;
}

std::string Drawing::labels() {
  std::string out;
  // Points of the front are labelled first: they are what one looks for.
  std::vector<const Mark*> order;
  for (const Mark& mark : m_marks) order.push_back(&mark);
  std::stable_sort(order.begin(), order.end(), [](const Mark* a, const Mark* b) { return a->front && !b->front; });
  for (const Mark* mark : order) {
    if (mark->label.empty()) continue;
    const double width = kLabelSize * textWidth(mark->label);
    const auto box = m_placer.place(mark->x, mark->y, width, kLabelSize + 1.0);
    if (!box) continue;
    const bool right = box->left > mark->x, left = box->right < mark->x;
    const double x = right ? box->left : left ? box->right : 0.5 * (box->left + box->right);
    const double gapX = right ? box->left - mark->x : left ? mark->x - box->right : 0.0;
    const double gapY = std::max({box->top - mark->y, mark->y - box->bottom, 0.0});
    // Too far to be read as the marker's own.
    if (std::hypot(gapX, gapY) > 15.0) {
      const double endY = std::clamp(mark->y, box->top, box->bottom);
      out += line(mark->x, mark->y, right ? box->left - 1.0 : left ? box->right + 1.0 : x, endY, "sw-leader");
    }
    out += text(x, box->bottom - 3.0, "sw-label", right ? "start" : left ? "end" : "middle", mark->label);
    const std::string& series = m_plot.series[mark->series].name;
    if (mark->label == series) m_named[mark->series] = true;
  }
  return out;
}

std::string Drawing::legendEntry(double x, double y, std::size_t series) const {
  const std::size_t index = lookOf(series);
  return element("path", "class=\"sw-mark " + look(index) + "\" d=\"" + markerPath(index, x + 6.0, y - 4.0) + "\"") +
         text(x + 18.0, y, "sw-label", "start", m_plot.series[series].name);
}

/// Below the axis: all series, when some are not named in the plot.
std::string Drawing::legend() {
  const bool needed = std::any_of(m_marks.begin(), m_marks.end(), [&](const Mark& mark) {
    return !m_named[mark.series] && !m_plot.series[mark.series].name.empty();
  });
  if (!needed) return {};
  std::string out;
  double x = kFrame.left, y = kHeight + 12.0;
  for (std::size_t s = 0; s < m_plot.series.size(); ++s) {
    const std::string& name = m_plot.series[s].name;
    if (name.empty()) continue;
    const double width = 18.0 + kLabelSize * textWidth(name) + 20.0;
    if (x > kFrame.left && x + width > kFrame.right + 20.0) {
      x = kFrame.left;
      y += kLegendLine;
    }
    out += legendEntry(x, y, s);
    x += width;
  }
  m_height = y + 12.0;
  return out;
}

}  // namespace

SeriesLooks::SeriesLooks(const std::vector<Section>& sections) {
  for (const Section& section : sections)
    for (const Plot& plot : section.plots)
      for (const Plot::Series& series : plot.series) m_looks.try_emplace(series.name, m_looks.size());
}

std::size_t SeriesLooks::of(const std::string& name) const {
  const auto found = m_looks.find(name);
  return found == m_looks.end() ? 0 : found->second;
}

std::vector<Plot::Point> paretoFront(const std::vector<Plot::Point>& points) {
  std::vector<Plot::Point> sorted;
  for (const Plot::Point& point : points) {
    if (std::isfinite(point.x) && std::isfinite(point.y)) sorted.push_back(point);
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Plot::Point& a, const Plot::Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Plot::Point> front;
  for (const Plot::Point& point : sorted) {
    if (front.empty() || point.y < front.back().y) front.push_back(point);
  }
  return front;
}

PlotText plotSvg(const Plot& plot, const SeriesLooks& looks, bool alone) {
  return Drawing(plot, looks).draw(alone);
}

}  // namespace sward::report
