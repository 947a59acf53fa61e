#include "widgets/curve_editor.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/text.h"
#include "widgets/theme.h"

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

namespace sward::editor {
namespace {

void showRange(double low, double high, double& from, double& to) {
  const double margin = 0.05 * (high - low);
  from = low - margin;
  to = high + margin;
}

std::string withIcon(const char* icon, const std::string& text) {
  return std::string(icon) + "   " + text;
}

}  // namespace

void CurveEditor::setActive(std::size_t layer) {
  if (layer == m_active) return;
  m_active = layer;
  m_selection.clear();
}

void CurveEditor::layerChips(Frame& f, float right) {
  const Palette& c = theme().colours;
  const float height = ImGui::GetFrameHeight();
  for (std::size_t i = 0; i < f.layers.size(); ++i) {
    CurveLayer& layer = f.layers[i];
    const bool active = i == m_active;
    const float text = ImGui::CalcTextSize(layer.name.c_str()).x;
    const float wide = text + px(layer.locked ? 46.0f : 30.0f);
    if (i > 0) ImGui::SameLine(0.0f, px(4));
    if (ImGui::GetCursorScreenPos().x + wide > right) break;
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::InvisibleButton("chip", ImVec2(wide, height))) setActive(i);
    logItem("curve:", f.id + ":layer:" + std::to_string(i));
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    const bool hot = ImGui::IsItemHovered();
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImU32 ground = active ? c.field : hot ? c.fieldHover : 0;
    if (ground != 0) draw->AddRectFilled(min, max, ground, 0.5f * height);
    if (active) draw->AddRect(min, max, faded(colourOf(f, i), 0.6f), 0.5f * height);
    const ImVec2 dot(min.x + px(13), 0.5f * (min.y + max.y));
    const ImU32 colour = colourOf(f, i);
    layer.visible ? draw->AddCircleFilled(dot, px(4), colour) : draw->AddCircle(dot, px(4), colour, 0, px(1.5f));
    const ImU32 ink = !layer.visible ? faded(c.textDim, 0.7f) : active ? c.text : c.textDim;
    draw->AddText(ImVec2(min.x + px(22), min.y + ImGui::GetStyle().FramePadding.y), ink, layer.name.c_str());
    if (layer.locked) {
      FontScope small(theme().fonts.small);
      draw->AddText(ImVec2(max.x - px(20), min.y + px(5)), c.textDim, icon::kLock);
    }
    hoverText("Click to edit this curve, right-click to hide or lock it");
    if (ImGui::BeginPopupContextItem("chip menu")) {
      if (ImGui::MenuItem("Visible", nullptr, layer.visible)) layer.visible = !layer.visible;
      logItem("curve:", f.id + ":visible:" + std::to_string(i));
      if (ImGui::MenuItem("Locked", nullptr, layer.locked)) layer.locked = !layer.locked;
      logItem("curve:", f.id + ":locked:" + std::to_string(i));
      ImGui::EndPopup();
    }
    ImGui::PopID();
  }
}

void CurveEditor::pointEntry(Frame& f, float width) {
  const CurvePoints points = pointsOf(f);
  const bool one = m_selection.size() == 1 && *m_selection.begin() < points.size() && editable(f);
  ImGui::BeginDisabled(!one);
  const std::size_t index = one ? *m_selection.begin() : 0;
  base::CurvePoint point = one ? points[index] : base::CurvePoint{};
  const CurveLimits& l = f.axes->limits;
  NumberStyle x, y;
  x.caption = "x";
  y.caption = "y";
  x.bar = y.bar = false;
  x.unit = f.axes->xUnit;
  y.unit = f.axes->yUnit;
  x.shown.suffix = f.axes->xUnit;
  y.shown.suffix = f.axes->yUnit;
  x.softLow = l.xLow;
  x.softHigh = l.xHigh;
  y.softLow = y.low = l.yLow;
  y.softHigh = y.high = l.yHigh;
  x.low = one && index > 0 ? points[index - 1].x + l.leastGap() : l.xLow;
  x.high = one && index + 1 < points.size() ? points[index + 1].x - l.leastGap() : l.xHigh;
  x.high = std::max(x.low, x.high);
  const float each = std::floor((width - px(4)) / 2.0f);
  EditState state = numberField("point x", point.x, x, each);
  logItem("curve:", f.id + ":x");
  ImGui::SameLine(0.0f, px(4));
  state |= numberField("point y", point.y, y, each);
  logItem("curve:", f.id + ":y");
  ImGui::EndDisabled();
  if (!one || (!state.changed && !state.finished)) return;
  CurvePoints moved = points;
  moved[index] = point;
  apply(f, std::move(moved), "move curve point");
  f.events.finished |= state.finished;
  f.events.layer = m_active;
  f.events.label = "move curve point";
}

void CurveEditor::presetItems(Frame& f) {
  for (const CurvePreset& preset : f.presets) {
    if (ImGui::MenuItem(preset.name.c_str())) {
      replace(f, base::Curve::fromPoints(fittedPoints(preset.curve.points(), f.axes->limits)).value(), "curve preset");
    }
    logItem("curve:", f.id + ":preset:" + preset.name);
  }
}

void CurveEditor::menuItems(Frame& f) {
  const auto item = [&](const char* icon, const char* text, const char* keys, bool enabled, const char* log) {
    const bool chosen = ImGui::MenuItem(withIcon(icon, text).c_str(), keys, false, enabled);
    logItem("curve:", f.id + ":menu:" + log);
    return chosen;
  };
  const bool can = editable(f);
  if (item(icon::kDelete, "Delete points", "Del", can && !m_selection.empty(), "delete")) remove(f);
  if (item(icon::kCopy, m_selection.empty() ? "Copy curve" : "Copy points", "Ctrl+C", true, "copy")) copy(f);
  if (item(icon::kPaste, "Paste curve", "Ctrl+V", can, "paste")) paste(f);
  const bool hasPoints = can && !pointsOf(f).empty();
  if (item(icon::kReset, "Reset curve", "", hasPoints, "reset")) replace(f, base::Curve(), "reset curve");
  if (!f.presets.empty() && ImGui::BeginMenu(withIcon(icon::kCurve, "Presets").c_str(), can)) {
    presetItems(f);
    ImGui::EndMenu();
  }
  ImGui::Separator();
  if (ImGui::MenuItem(withIcon(icon::kSnap, "Snap to grid").c_str(), "Alt", m_snaps)) m_snaps = !m_snaps;
  logItem("curve:", f.id + ":menu:snap");
  if (item(icon::kFrameAll, "Frame all", "F", true, "frame")) frameAll();
}

void CurveEditor::barButtons(Frame& f) {
  const bool can = editable(f);
  if (toolToggle((f.id + ".snap").c_str(), icon::kSnap, m_snaps, "Snap to the grid", "Alt inverts")) m_snaps = !m_snaps;
  ImGui::SameLine(0.0f, px(2));
  if (iconButton((f.id + ".frame").c_str(), icon::kFrameAll, "Frame all", "F")) frameAll();
  ImGui::SameLine(0.0f, px(2));
  if (iconButton((f.id + ".presets").c_str(), icon::kCurve, "Presets", "", can && !f.presets.empty())) {
    ImGui::OpenPopup("presets");
  }
  if (ImGui::BeginPopup("presets")) {
    presetItems(f);
    ImGui::EndPopup();
  }
  ImGui::SameLine(0.0f, px(2));
  if (iconButton((f.id + ".more").c_str(), icon::kMore, "More")) ImGui::OpenPopup("more");
  if (ImGui::BeginPopup("more")) {
    menuItems(f);
    ImGui::EndPopup();
  }
}

void CurveEditor::bar(Frame& f, float width) {
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float buttons = 4.0f * (ImGui::GetFrameHeight() + px(6));
  const bool entry = width > px(430) && m_selection.size() == 1;
  const float entryWidth = entry ? std::min(px(230), width * 0.4f) : 0.0f;
  const float right = start.x + width - buttons;
  layerChips(f, right - entryWidth - px(8));
  if (entry) {
    ImGui::SetCursorScreenPos(ImVec2(right - entryWidth - px(6), start.y));
    pointEntry(f, entryWidth);
  }
  ImGui::SetCursorScreenPos(ImVec2(right, start.y));
  barButtons(f);
  ImGui::SetCursorScreenPos(ImVec2(start.x, start.y + ImGui::GetFrameHeight() + px(6)));
}

void CurveEditor::contextMenu(Frame& f) {
  if (!ImGui::BeginPopup("plot menu")) return;
  if (m_selection.size() == 1) {
    pointEntry(f, px(220));
    ImGui::Separator();
  }
  menuItems(f);
  ImGui::EndPopup();
}

void CurveEditor::plot(Frame& f) {
  ImGui::SetCursorScreenPos(f.min);
  // Without a size ImGui asserts; a panel may be squeezed to nothing.
  const ImVec2 size(std::max(1.0f, f.max.x - f.min.x), std::max(1.0f, f.max.y - f.min.y));
  ImGui::InvisibleButton("plot", size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemUsingMouseWheel();
  logItem("curve:", f.id + ":plot");
  f.hovered = ImGui::IsItemHovered() || ImGui::IsItemActive();
  f.focused = ImGui::IsWindowFocused();
  if (ImGui::IsItemHovered() && ImGui::IsMouseReleased(1)) {
    const int point = editable(f) ? pointAt(f, ImGui::GetIO().MousePos) : -1;
    if (point >= 0 && !m_selection.contains(static_cast<std::size_t>(point))) {
      m_selection = {static_cast<std::size_t>(point)};
    }
    ImGui::OpenPopup("plot menu");
  }
  gestures(f);
  paint(f);
  contextMenu(f);
}

CurveEvents CurveEditor::draw(const char* id, std::span<CurveLayer> layers, const CurveAxes& axes, ImVec2 size,
                              std::span<const CurvePreset> presets) {
  Frame f;
  f.id = id;
  f.layers = layers;
  f.axes = &axes;
  f.presets = presets;
  if (m_active >= layers.size()) setActive(0);
  if (!m_framed || !(m_framedFor == axes.limits)) {
    showRange(axes.limits.xLow, axes.limits.xHigh, m_x0, m_x1);
    showRange(axes.limits.yLow, axes.limits.yHigh, m_y0, m_y1);
    m_framedFor = axes.limits;
    m_framed = true;
  }
  // Arrows belong to the points, not to ImGui's walk between items.
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  const bool shown = ImGui::BeginChild(
      id, size, false,
      ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  if (shown) {
    const ImVec2 min = ImGui::GetWindowPos();
    const ImVec2 max(min.x + size.x, min.y + size.y);
    f.compact = size.y < px(160) || size.x < px(260);
    float top = min.y + px(4);
    if (!f.compact) {
      bar(f, size.x);
      top = ImGui::GetCursorScreenPos().y;
    }
    FontScope small(theme().fonts.small);
    // Room for a digit more than the whole range needs, so that zooming does not move the plot under the mouse.
    const CurveLimits& l = axes.limits;
    const double whole = niceStep(l.yHigh - l.yLow, 50.0), now = niceStep(m_y1 - m_y0, 5.0);
    float labels = 0.0f;
    for (const std::string& text :
         {tickText(l.yLow, whole), tickText(l.yHigh, whole), tickText(m_y0, now), tickText(m_y1, now)}) {
      labels = std::max(labels, ImGui::CalcTextSize(text.c_str()).x);
    }
    f.min = ImVec2(min.x + labels + px(10), top);
    f.max = ImVec2(max.x - px(6), max.y - ImGui::GetFontSize() - px(6));
  }
  if (shown && f.max.x - f.min.x > px(20) && f.max.y - f.min.y > px(20)) plot(f);
  ImGui::EndChild();
  return f.events;
}

}  // namespace sward::editor
