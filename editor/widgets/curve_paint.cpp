#include "widgets/curve_editor.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/text.h"
#include "widgets/theme.h"

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

/// How the curve editor looks.
namespace sward::editor {
namespace {

std::string withUnit(std::string number, const std::string& unit) {
  return unit.empty() ? number : number + " " + unit;
}

/// Four significant digits or so, by the span that is shown.
std::string readout(double value, double span) {
  return tickText(value, niceStep(span, 500.0));
}

/// Antialiased edges of neighbouring quads would show as stripes.
class PlainFill {
 public:
  explicit PlainFill(ImDrawList* draw) : m_draw(draw), m_flags(draw->Flags) {
    m_draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;
  }
  ~PlainFill() { m_draw->Flags = m_flags; }
  PlainFill(const PlainFill&) = delete;
  PlainFill& operator=(const PlainFill&) = delete;

 private:
  ImDrawList* m_draw;
  ImDrawListFlags m_flags;
};

}  // namespace

ImU32 CurveEditor::colourOf(const Frame& f, std::size_t index) {
  const auto& series = theme().colours.series;
  const ImU32 own = f.layers[index].colour;
  return own != 0 ? own : series[index % series.size()];
}

const base::Curve& CurveEditor::shownCurve(const CurveLayer& layer) {
  return layer.curve->points().empty() && layer.builtIn != nullptr ? *layer.builtIn : *layer.curve;
}

ImVec2 CurveEditor::toScreen(const Frame& f, double x, double y) const {
  return ImVec2(f.min.x + static_cast<float>((x - m_x0) / (m_x1 - m_x0)) * (f.max.x - f.min.x),
                f.max.y - static_cast<float>((y - m_y0) / (m_y1 - m_y0)) * (f.max.y - f.min.y));
}

double CurveEditor::xAt(const Frame& f, float screenX) const {
  return m_x0 + static_cast<double>((screenX - f.min.x) / (f.max.x - f.min.x)) * (m_x1 - m_x0);
}

double CurveEditor::yAt(const Frame& f, float screenY) const {
  return m_y0 + static_cast<double>((f.max.y - screenY) / (f.max.y - f.min.y)) * (m_y1 - m_y0);
}

double CurveEditor::xStep(const Frame& f) const {
  if (f.axes->xSnap > 0.0) return f.axes->xSnap;
  return niceStep(m_x1 - m_x0, static_cast<double>((f.max.x - f.min.x) / px(18)));
}

double CurveEditor::yStep(const Frame& f) const {
  if (f.axes->ySnap > 0.0) return f.axes->ySnap;
  return niceStep(m_y1 - m_y0, static_cast<double>((f.max.y - f.min.y) / px(16)));
}

void CurveEditor::paintGrid(const Frame& f) const {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto columns = [&](double step, ImU32 colour) {
    for (double x = std::ceil(m_x0 / step) * step; x <= m_x1; x += step) {
      const float at = std::round(toScreen(f, x, 0).x);
      draw->AddLine(ImVec2(at, f.min.y), ImVec2(at, f.max.y), colour);
    }
  };
  const auto rows = [&](double step, ImU32 colour) {
    for (double y = std::ceil(m_y0 / step) * step; y <= m_y1; y += step) {
      const float at = std::round(toScreen(f, 0, y).y);
      draw->AddLine(ImVec2(f.min.x, at), ImVec2(f.max.x, at), colour);
    }
  };
  const bool fine = m_snaps || !f.compact;
  if (fine) columns(xStep(f), c.plotGrid);
  if (fine) rows(yStep(f), c.plotGrid);
  columns(niceStep(m_x1 - m_x0, static_cast<double>((f.max.x - f.min.x) / px(80))), c.plotGridMajor);
  rows(niceStep(m_y1 - m_y0, static_cast<double>((f.max.y - f.min.y) / px(44))), c.plotGridMajor);
  // Where no point may stand.
  const CurveLimits& l = f.axes->limits;
  const ImVec2 low = toScreen(f, l.xLow, l.yLow), high = toScreen(f, l.xHigh, l.yHigh);
  const ImU32 shade = faded(c.backdrop, 0.55f);
  const auto cover = [&](float x0, float y0, float x1, float y1) {
    if (x1 > x0 && y1 > y0) draw->AddRectFilled(ImVec2(x0, y0), ImVec2(x1, y1), shade);
  };
  const float top = std::clamp(high.y, f.min.y, f.max.y), bottom = std::clamp(low.y, f.min.y, f.max.y);
  cover(f.min.x, f.min.y, std::min(low.x, f.max.x), f.max.y);
  cover(std::max(high.x, f.min.x), f.min.y, f.max.x, f.max.y);
  cover(std::max(low.x, f.min.x), f.min.y, std::min(high.x, f.max.x), top);
  cover(std::max(low.x, f.min.x), bottom, std::min(high.x, f.max.x), f.max.y);
}

void CurveEditor::paintTicks(const Frame& f) const {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  FontScope small(theme().fonts.small);
  const float line = ImGui::GetFontSize();
  const double sx = niceStep(m_x1 - m_x0, static_cast<double>((f.max.x - f.min.x) / px(80)));
  float freeFrom = f.min.x - px(20);
  for (double x = std::ceil(m_x0 / sx - 1e-9) * sx; x <= m_x1 + 1e-9 * sx; x += sx) {
    const std::string text = tickText(x, sx);
    const float wide = ImGui::CalcTextSize(text.c_str()).x;
    const float at = std::clamp(toScreen(f, x, 0).x - 0.5f * wide, f.min.x - px(4), f.max.x - wide + px(4));
    if (at < freeFrom) continue;
    draw->AddText(ImVec2(std::round(at), f.max.y + px(3)), c.textDim, text.c_str());
    freeFrom = at + wide + px(6);
  }
  const double sy = niceStep(m_y1 - m_y0, static_cast<double>((f.max.y - f.min.y) / px(44)));
  for (double y = std::ceil(m_y0 / sy - 1e-9) * sy; y <= m_y1 + 1e-9 * sy; y += sy) {
    const std::string text = tickText(y, sy);
    const float wide = ImGui::CalcTextSize(text.c_str()).x;
    const float at = std::clamp(toScreen(f, 0, y).y - 0.5f * line, f.min.y - px(2), f.max.y - line + px(2));
    draw->AddText(ImVec2(f.min.x - px(6) - wide, std::round(at)), c.textDim, text.c_str());
  }
  if (f.compact) return;
  // In the margin above the limits, where no curve runs.
  const auto title = [](const char* arrow, const std::string& label, const std::string& unit) {
    return label.empty() ? "" : arrow + label + (unit.empty() ? "" : " (" + unit + ")") + "     ";
  };
  const std::string titles =
      title("\u2191 ", f.axes->yLabel, f.axes->yUnit) + title("\u2192 ", f.axes->xLabel, f.axes->xUnit);
  draw->AddText(ImVec2(f.min.x + px(8), f.min.y + px(4)), mixed(c.textDim, c.text, 0.3f), titles.c_str());
}

void CurveEditor::paintLayer(const Frame& f, std::size_t index) const {
  const CurveLayer& layer = f.layers[index];
  const base::Curve& curve = shownCurve(layer);
  if (!layer.visible || curve.points().empty()) return;
  const bool active = index == m_active, own = !layer.curve->points().empty();
  const ImU32 colour = faded(colourOf(f, index), active ? 1.0f : 0.55f);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  std::vector<ImVec2> line;
  const float step = std::max(1.5f, (f.max.x - f.min.x) / 1500.0f);
  for (float x = f.min.x; x <= f.max.x + step; x += step) line.push_back(toScreen(f, xAt(f, x), curve(xAt(f, x))));
  if (active) {
    const PlainFill plain(draw);
    const float from = toScreen(f, f.axes->limits.xLow, 0).x, to = toScreen(f, f.axes->limits.xHigh, 0).x;
    draw->PushClipRect(ImVec2(std::max(from, f.min.x), f.min.y), ImVec2(std::min(to, f.max.x), f.max.y), true);
    const float floor = std::clamp(toScreen(f, 0, std::max(0.0, f.axes->limits.yLow)).y, f.min.y, f.max.y);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      draw->AddQuadFilled(line[i], line[i + 1], ImVec2(line[i + 1].x, floor), ImVec2(line[i].x, floor),
                          faded(colour, own ? 0.09f : 0.05f));
    }
    draw->PopClipRect();
  }
  const float thick = std::max(1.5f, px(active ? 2.0f : 1.5f));
  // Beyond its points a curve is constant, which is thinner; a built-in one is dashed.
  const float first = toScreen(f, curve.points().front().x, 0).x, last = toScreen(f, curve.points().back().x, 0).x;
  const auto part = [&](float from, float to, ImU32 ink, float width) {
    if (to <= from) return;
    const auto begin = static_cast<std::size_t>(std::max(0.0f, std::floor((from - f.min.x) / step)));
    const auto end = std::min(line.size(), static_cast<std::size_t>(std::ceil((to - f.min.x) / step)) + 1);
    if (begin + 1 >= end) return;
    draw->PushClipRect(ImVec2(from, f.min.y), ImVec2(to, f.max.y), true);
    draw->AddPolyline(line.data() + begin, static_cast<int>(end - begin), ink, 0, width);
    draw->PopClipRect();
  };
  if (!own) {
    for (float x = f.min.x; x < f.max.x; x += px(9)) part(x, std::min(f.max.x, x + px(5)), faded(colour, 0.8f), thick);
    return;
  }
  part(f.min.x, std::min(first, f.max.x), faded(colour, 0.45f), std::max(1.0f, px(1)));
  part(std::max(last, f.min.x), f.max.x, faded(colour, 0.45f), std::max(1.0f, px(1)));
  part(std::max(first, f.min.x), std::min(last, f.max.x), colour, thick);
}

void CurveEditor::paintPoints(const Frame& f) const {
  if (m_active >= f.layers.size() || !f.layers[m_active].visible) return;
  const Palette& c = theme().colours;
  const ImU32 colour = colourOf(f, m_active);
  const bool locked = f.layers[m_active].locked;
  const CurvePoints points = pointsOf(f);
  const int hot = f.hovered && m_gesture == Gesture::None ? pointAt(f, ImGui::GetIO().MousePos) : -1;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImVec2 at = toScreen(f, points[i].x, points[i].y);
    const bool chosen = m_selection.contains(i);
    const float radius = px(locked ? 3.0f : 4.5f) + (static_cast<int>(i) == hot && !locked ? px(1.5f) : 0.0f);
    if (chosen) draw->AddCircleFilled(at, radius + px(3), faded(colour, 0.28f));
    draw->AddCircleFilled(at, radius, chosen ? colour : c.plot);
    draw->AddCircle(at, radius, chosen ? mixed(colour, c.text, 0.75f) : colour, 0, std::max(1.5f, px(1.75f)));
    const ImVec2 reach(px(6), px(6));
    logRect("curve:", f.id + ":point:" + std::to_string(i), ImVec2(at.x - reach.x, at.y - reach.y),
            ImVec2(at.x + reach.x, at.y + reach.y));
  }
}

void CurveEditor::paintReadout(const Frame& f) const {
  const bool dragging = m_gesture == Gesture::Move;
  if ((!f.hovered && !dragging) || m_active >= f.layers.size() || !f.layers[m_active].visible) return;
  if (m_gesture == Gesture::Band || m_gesture == Gesture::Pan) return;
  const base::Curve& curve = shownCurve(f.layers[m_active]);
  if (curve.points().empty()) return;
  const Palette& c = theme().colours;
  const CurvePoints points = pointsOf(f);
  const int hot = dragging ? static_cast<int>(m_grabbed) : pointAt(f, ImGui::GetIO().MousePos);
  const bool onPoint = hot >= 0 && static_cast<std::size_t>(hot) < points.size();
  const double x = onPoint ? points[static_cast<std::size_t>(hot)].x : xAt(f, ImGui::GetIO().MousePos.x);
  const double y = curve(x);
  const ImVec2 at = toScreen(f, x, y);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddLine(ImVec2(std::round(at.x), f.min.y), ImVec2(std::round(at.x), f.max.y), faded(c.text, 0.18f));
  if (!onPoint) draw->AddCircleFilled(at, px(3), colourOf(f, m_active));
  FontScope small(theme().fonts.small);
  const std::string text =
      withUnit(readout(x, m_x1 - m_x0), f.axes->xUnit) + "   " + withUnit(readout(y, m_y1 - m_y0), f.axes->yUnit);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const ImVec2 pad(px(7), px(3));
  // Beside the point, on the side that has room, and never under the hand.
  const float wide = size.x + 2 * pad.x, high = size.y + 2 * pad.y;
  float left = at.x + px(12), top = at.y - high - px(10);
  if (left + wide > f.max.x) left = at.x - px(12) - wide;
  if (top < f.min.y + px(2)) top = at.y + px(12);
  left = std::clamp(left, f.min.x + px(2), std::max(f.min.x + px(2), f.max.x - wide - px(2)));
  top = std::clamp(top, f.min.y + px(2), std::max(f.min.y + px(2), f.max.y - high - px(2)));
  draw->AddRectFilled(ImVec2(left, top), ImVec2(left + wide, top + high), faded(c.raised, 0.94f), px(4));
  draw->AddRect(ImVec2(left, top), ImVec2(left + wide, top + high), c.border, px(4));
  draw->AddText(ImVec2(left + pad.x, top + pad.y), c.text, text.c_str());
}

void CurveEditor::paint(Frame& f) {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(f.min, f.max, c.plot, px(4));
  draw->PushClipRect(f.min, f.max, true);
  paintGrid(f);
  for (std::size_t i = 0; i < f.layers.size(); ++i) {
    if (i != m_active) paintLayer(f, i);
  }
  if (m_active < f.layers.size()) paintLayer(f, m_active);
  draw->PopClipRect();
  // Points on the plot's edge stay whole.
  draw->PushClipRect(ImVec2(f.min.x - px(7), f.min.y - px(7)), ImVec2(f.max.x + px(7), f.max.y + px(7)), true);
  paintPoints(f);
  draw->PopClipRect();
  if (m_gesture == Gesture::Band && m_moved) {
    const ImVec2 a = ImMin(m_pressedAt, ImGui::GetIO().MousePos), b = ImMax(m_pressedAt, ImGui::GetIO().MousePos);
    draw->AddRectFilled(a, b, faded(c.accent, 0.12f), px(2));
    draw->AddRect(a, b, faded(c.accent, 0.8f), px(2));
  }
  draw->AddRect(f.min, f.max, f.focused ? faded(c.accent, 0.55f) : c.border, px(4));
  paintTicks(f);
  paintReadout(f);
  if (m_active < f.layers.size() && shownCurve(f.layers[m_active]).points().empty()) {
    const char* text = f.compact ? "Double-click to add a point" : "No points yet: double-click to add one";
    const ImVec2 size = ImGui::CalcTextSize(text);
    draw->AddText(ImVec2(0.5f * (f.min.x + f.max.x - size.x), 0.5f * (f.min.y + f.max.y - size.y)), c.textDim, text);
  }
}

}  // namespace sward::editor
