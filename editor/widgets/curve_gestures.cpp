#include "widgets/curve_editor.h"
#include "widgets/theme.h"

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

/// What mouse and keys do in the curve editor.
namespace sward::editor {
namespace {

constexpr float kReach = 9.0f;      ///< pixels at scale 1 within which a point is meant
constexpr float kLineReach = 6.0f;  ///< the same for a line

bool keyPressed(ImGuiKey key, bool repeat = false) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
}

std::string counted(const char* verb, std::size_t count) {
  return std::string(verb) + (count == 1 ? " curve point" : " curve points");
}

/// How far `value` moves by `delta` when it must end on a multiple of `step`.
double offsetTo(double value, double delta, double step, bool snap) {
  return snap ? snappedTo(value + delta, step) - value : delta;
}

/// Digits beyond a tenth of a pixel only lengthen files: rounds the selected points, unless they would meet a
/// neighbour.
CurvePoints shortenedPoints(const CurvePoints& points, const PointSelection& selection, double perX, double perY,
                            const CurveLimits& limits) {
  const auto shortened = [](double value, double pixel) {
    return snappedTo(value, std::pow(10.0, std::floor(std::log10(pixel)) - 1.0));
  };
  CurvePoints rounded = points;
  for (const std::size_t i : selection) {
    if (i >= rounded.size()) continue;
    rounded[i].x = std::clamp(shortened(rounded[i].x, perX), limits.xLow, limits.xHigh);
    rounded[i].y = std::clamp(shortened(rounded[i].y, perY), limits.yLow, limits.yHigh);
  }
  for (std::size_t i = 1; i < rounded.size(); ++i) {
    if (rounded[i].x - rounded[i - 1].x < 0.5 * limits.leastGap()) return points;
  }
  return rounded;
}

}  // namespace

bool CurveEditor::editable(const Frame& f) const {
  return m_active < f.layers.size() && !f.layers[m_active].locked && f.layers[m_active].visible;
}

CurvePoints CurveEditor::pointsOf(const Frame& f) const {
  if (m_active >= f.layers.size()) return {};
  return f.layers[m_active].curve->points();
}

bool CurveEditor::snapping() const {
  return m_snaps != ImGui::GetIO().KeyAlt;
}

bool CurveEditor::apply(Frame& f, CurvePoints points, const std::string& label) {
  if (points == pointsOf(f)) return false;
  auto curve = base::Curve::fromPoints(std::move(points));
  if (!curve.ok()) return false;
  *f.layers[m_active].curve = std::move(curve).value();
  f.events.changed = true;
  f.events.layer = m_active;
  f.events.label = label;
  return true;
}

void CurveEditor::replace(Frame& f, const base::Curve& curve, const std::string& label) {
  m_selection.clear();
  f.events.finished |= apply(f, curve.points(), label);
}

int CurveEditor::pointAt(const Frame& f, ImVec2 mouse) const {
  int nearest = -1;
  float best = px(kReach) * px(kReach);
  const CurvePoints points = pointsOf(f);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImVec2 at = toScreen(f, points[i].x, points[i].y);
    const float distance = ImLengthSqr(ImVec2(at.x - mouse.x, at.y - mouse.y));
    if (distance > best) continue;
    best = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

int CurveEditor::layerAt(const Frame& f, ImVec2 mouse) const {
  int nearest = -1;
  float best = px(kLineReach);
  for (std::size_t i = 0; i < f.layers.size(); ++i) {
    const CurveLayer& layer = f.layers[i];
    if (!layer.visible || (layer.locked && i != m_active)) continue;
    const double x = xAt(f, mouse.x);
    // Distance to the line along its normal, so that steep lines are no harder to hit.
    const base::Curve& curve = shownCurve(layer);
    const ImVec2 here = toScreen(f, x, curve(x));
    const ImVec2 next = toScreen(f, xAt(f, mouse.x + 1.0f), curve(xAt(f, mouse.x + 1.0f)));
    const float slope = next.y - here.y;
    const float distance = std::abs(here.y - mouse.y) / std::sqrt(1.0f + slope * slope);
    if (distance > best) continue;
    best = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

void CurveEditor::add(Frame& f, ImVec2 mouse) {
  if (!editable(f)) return;
  const CurveLayer& layer = f.layers[m_active];
  CurvePoints points = shownCurve(layer).points();
  base::CurvePoint point{xAt(f, mouse.x), yAt(f, mouse.y)};
  if (snapping()) point = {snappedTo(point.x, xStep(f)), snappedTo(point.y, yStep(f))};
  const bool onLine = !points.empty() && layerAt(f, mouse) == static_cast<int>(m_active);
  if (onLine) point.y = shownCurve(layer)(point.x);
  const auto index = insertPoint(points, {cleaned(point.x), cleaned(point.y)}, f.axes->limits);
  if (!index || !apply(f, points, "add curve point")) return;
  m_selection = {*index};
  // The same press goes on as a drag of the new point.
  m_gesture = Gesture::Move;
  m_grabbed = *index;
  m_before = points;
  m_edited = true;
  m_gestureLabel = "add curve point";
}

void CurveEditor::pressed(Frame& f) {
  const ImGuiIO& io = ImGui::GetIO();
  m_pressedAt = io.MousePos;
  m_moved = m_edited = false;
  m_gesture = Gesture::None;
  const int point = editable(f) ? pointAt(f, io.MousePos) : -1;
  if (point < 0 && (io.KeyCtrl || io.MouseClickedCount[0] == 2)) return add(f, io.MousePos);
  if (point >= 0) {
    const auto index = static_cast<std::size_t>(point);
    if (io.KeyShift) {
      if (!m_selection.erase(index)) m_selection.insert(index);
    } else if (!m_selection.contains(index)) {
      m_selection = {index};
    }
    if (!m_selection.contains(index)) return;
    m_gesture = Gesture::Move;
    m_grabbed = index;
    m_before = pointsOf(f);
    m_gestureLabel = counted("move", m_selection.size());
    return;
  }
  const int layer = layerAt(f, io.MousePos);
  if (layer >= 0 && static_cast<std::size_t>(layer) != m_active) return setActive(static_cast<std::size_t>(layer));
  m_gesture = Gesture::Band;
  m_bandBase = io.KeyShift ? m_selection : PointSelection{};
  m_selection = m_bandBase;
}

void CurveEditor::dragged(Frame& f) {
  const ImGuiIO& io = ImGui::GetIO();
  ImVec2 delta(io.MousePos.x - m_pressedAt.x, io.MousePos.y - m_pressedAt.y);
  if (!m_moved && ImLengthSqr(delta) < px(3) * px(3)) return;
  m_moved = true;
  if (m_gesture == Gesture::Band) {
    const ImRect band(ImMin(m_pressedAt, io.MousePos), ImMax(m_pressedAt, io.MousePos));
    m_selection = m_bandBase;
    const CurvePoints points = pointsOf(f);
    for (std::size_t i = 0; i < points.size() && editable(f); ++i) {
      if (band.Contains(toScreen(f, points[i].x, points[i].y))) m_selection.insert(i);
    }
    return;
  }
  // Undo, or another edit of the curve, took the points away under the drag.
  if (m_gesture != Gesture::Move || !editable(f) || m_before.size() != pointsOf(f).size()) return;
  if (io.KeyShift) (std::abs(delta.x) > std::abs(delta.y) ? delta.y : delta.x) = 0.0f;
  const double perX = (m_x1 - m_x0) / static_cast<double>(f.max.x - f.min.x);
  const double perY = (m_y1 - m_y0) / static_cast<double>(f.max.y - f.min.y);
  const base::CurvePoint& grabbed = m_before[m_grabbed];
  const bool snap = snapping();
  const double dx = offsetTo(grabbed.x, static_cast<double>(delta.x) * perX, xStep(f), snap && delta.x != 0.0f);
  const double dy = offsetTo(grabbed.y, static_cast<double>(-delta.y) * perY, yStep(f), snap && delta.y != 0.0f);
  const CurvePoints moved = movedPoints(m_before, m_selection, dx, dy, f.axes->limits);
  m_edited |= apply(f, shortenedPoints(moved, m_selection, perX, perY, f.axes->limits), m_gestureLabel);
}

void CurveEditor::released(Frame& f) {
  if (m_gesture == Gesture::Move && m_edited) {
    f.events.finished = true;
    f.events.layer = m_active;
    f.events.label = m_gestureLabel;
  }
  const bool clickOnSelected = m_gesture == Gesture::Move && !m_moved && !m_edited && !ImGui::GetIO().KeyShift;
  if (clickOnSelected) m_selection = {m_grabbed};
  m_gesture = Gesture::None;
}

void CurveEditor::navigate(Frame& f) {
  const ImGuiIO& io = ImGui::GetIO();
  const CurveLimits& limits = f.axes->limits;
  if (f.hovered && io.MouseWheel != 0.0f) {
    const double factor = std::pow(0.85, static_cast<double>(io.MouseWheel));
    const auto zoom = [factor](double& low, double& high, double about, double whole) {
      const double span = std::clamp((high - low) * factor, whole * 1e-3, whole * 4.0);
      const double t = (about - low) / (high - low);
      low = about - t * span;
      high = low + span;
    };
    if (!io.KeyCtrl) zoom(m_x0, m_x1, xAt(f, io.MousePos.x), limits.xHigh - limits.xLow);
    if (!io.KeyShift) zoom(m_y0, m_y1, yAt(f, io.MousePos.y), limits.yHigh - limits.yLow);
  }
  if (m_gesture == Gesture::Pan) {
    const double dx = static_cast<double>(io.MouseDelta.x) * (m_x1 - m_x0) / static_cast<double>(f.max.x - f.min.x);
    const double dy = static_cast<double>(io.MouseDelta.y) * (m_y1 - m_y0) / static_cast<double>(f.max.y - f.min.y);
    m_x0 -= dx;
    m_x1 -= dx;
    m_y0 += dy;
    m_y1 += dy;
    if (!io.MouseDown[2]) m_gesture = Gesture::None;
  }
}

void CurveEditor::nudge(Frame& f) {
  const bool left = keyPressed(ImGuiKey_LeftArrow, true), right = keyPressed(ImGuiKey_RightArrow, true);
  const bool up = keyPressed(ImGuiKey_UpArrow, true), down = keyPressed(ImGuiKey_DownArrow, true);
  const double part = ImGui::GetIO().KeyShift ? 0.001 : 0.01;
  const CurveLimits& limits = f.axes->limits;
  const double sx = m_snaps ? xStep(f) : (limits.xHigh - limits.xLow) * part;
  const double sy = m_snaps ? yStep(f) : (limits.yHigh - limits.yLow) * part;
  const std::string label = counted("move", m_selection.size());
  if ((left || right || up || down) && !m_selection.empty()) {
    const double dx = (right ? sx : 0.0) - (left ? sx : 0.0), dy = (up ? sy : 0.0) - (down ? sy : 0.0);
    CurvePoints moved = movedPoints(pointsOf(f), m_selection, dx, dy, limits);
    for (base::CurvePoint& point : moved) point = {cleaned(point.x), cleaned(point.y)};
    m_nudging |= apply(f, std::move(moved), label);
  }
  bool held = false;
  for (const ImGuiKey key : {ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow, ImGuiKey_DownArrow}) {
    held |= ImGui::IsKeyDown(ImGui::GetKeyIndex(key));
  }
  // However long the key repeats, its release ends one step.
  if (m_nudging && !held) {
    m_nudging = false;
    f.events.finished = true;
    f.events.layer = m_active;
    f.events.label = label;
  }
}

void CurveEditor::remove(Frame& f) {
  if (m_selection.empty() || !editable(f)) return;
  const std::string label = counted("delete", m_selection.size());
  f.events.finished |= apply(f, withoutPoints(pointsOf(f), m_selection), label);
  m_selection.clear();
}

void CurveEditor::copy(const Frame& f) const {
  CurvePoints chosen;
  const CurvePoints points = pointsOf(f);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (m_selection.empty() || m_selection.contains(i)) chosen.push_back(points[i]);
  }
  ImGui::SetClipboardText(pointsText(chosen).c_str());
}

void CurveEditor::paste(Frame& f) {
  const char* text = ImGui::GetClipboardText();
  const auto points = parsedPoints(text != nullptr ? text : "");
  if (!points || !editable(f)) return;
  const CurvePoints fitted = fittedPoints(*points, f.axes->limits);
  m_selection.clear();
  f.events.finished |= apply(f, fitted, "paste curve");
}

void CurveEditor::keys(Frame& f) {
  if (m_active >= f.layers.size()) return;
  const ImGuiIO& io = ImGui::GetIO();
  if (m_nudging || (f.focused && editable(f))) nudge(f);
  if (!f.focused || io.WantTextInput) return;
  const CurvePoints points = pointsOf(f);
  if (keyPressed(ImGuiKey_Delete) || keyPressed(ImGuiKey_Backspace)) remove(f);
  if (keyPressed(ImGuiKey_Escape)) m_selection.clear();
  // Letters beyond ImGui's own few come as the window's codes, which are ASCII's in GLFW.
  if (!io.KeyCtrl && ImGui::IsKeyPressed('F', false)) frameAll();
  if (!io.KeyCtrl) return;
  if (keyPressed(ImGuiKey_A) && editable(f)) {
    for (std::size_t i = 0; i < points.size(); ++i) m_selection.insert(i);
  }
  if (keyPressed(ImGuiKey_C)) copy(f);
  if (keyPressed(ImGuiKey_V)) paste(f);
}

void CurveEditor::gestures(Frame& f) {
  const ImGuiIO& io = ImGui::GetIO();
  // A point is pressed, not hovered, before the first frame of a click ends: ImGui's item has become active then.
  if (f.hovered && ImGui::IsMouseClicked(0)) pressed(f);
  if (f.hovered && ImGui::IsMouseClicked(2) && m_gesture == Gesture::None) m_gesture = Gesture::Pan;
  const bool left = m_gesture == Gesture::Move || m_gesture == Gesture::Band;
  if (left && io.MouseDown[0]) dragged(f);
  if (left && !io.MouseDown[0]) released(f);
  navigate(f);
  keys(f);
  // Undo may have shortened the curve.
  while (!m_selection.empty() && *m_selection.rbegin() >= pointsOf(f).size()) m_selection.erase(*m_selection.rbegin());
}

}  // namespace sward::editor
