#include "widgets/field_painter.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/text.h"
#include "widgets/theme.h"

#include "image/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui_internal.h>

/// The widgets of FieldPainter: one edit() for each type of value.
namespace sward::editor {
namespace {

ImU32 screenColour(const glm::dvec3& linear) {
  const glm::vec3 c = image::srgbFromLinear(glm::clamp(glm::vec3(linear), 0.0f, 1.0f));
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c.x, c.y, c.z, 1.0f));
}

/// Five significant digits: finer than any screen shows, and short in a file.
double shortened(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.5g", value);
  return std::strtod(text.data(), nullptr);
}

std::string tripleText(const glm::dvec3& v) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.3g  %.3g  %.3g", v.x, v.y, v.z);
  return text.data();
}

/// A framed button that shows a colour and its text; true when pressed.
bool swatchButton(const glm::dvec3& colour, const std::string& text, float width, bool faulty) {
  const Palette& c = theme().colours;
  const float height = ImGui::GetFrameHeight();
  const bool pressed = ImGui::InvisibleButton("swatch", ImVec2(width, height));
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const float rounding = ImGui::GetStyle().FrameRounding;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  ImGui::RenderFrame(min, max, ImGui::IsItemHovered() ? c.fieldHover : c.field, true, rounding);
  const float inset = px(3);
  const float split = std::round(std::min(max.x - inset, min.x + std::max(height * 1.6f, width * 0.42f)));
  draw->AddRectFilled(ImVec2(min.x + inset, min.y + inset), ImVec2(split, max.y - inset), screenColour(colour),
                      rounding - px(1));
  draw->AddRect(ImVec2(min.x + inset, min.y + inset), ImVec2(split, max.y - inset), faded(c.text, 0.15f),
                rounding - px(1));
  if (faulty) draw->AddRect(min, max, c.error, rounding);
  textEllipsis(ImVec2(split + px(8), min.y + ImGui::GetStyle().FramePadding.y), max.x - px(4), c.textDim, text);
  return pressed;
}

/// The picker works on encoded values; the value is written only when the user changed them.
EditState pickColour(glm::dvec3& linear) {
  const glm::vec3 encoded = image::srgbFromLinear(glm::vec3(linear));
  std::array<float, 3> rgb{encoded.x, encoded.y, encoded.z};
  ImGui::SetNextItemWidth(px(230));
  EditState state;
  state.changed = ImGui::ColorPicker3("##picker", rgb.data(),
                                      ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoLabel |
                                          ImGuiColorEditFlags_NoOptions | ImGuiColorEditFlags_Uint8 |
                                          ImGuiColorEditFlags_DisplayRGB | ImGuiColorEditFlags_DisplayHex);
  state.finished = ImGui::IsItemDeactivatedAfterEdit();
  if (state.changed) {
    const glm::vec3 back = image::linearFromSrgb(glm::clamp(glm::vec3(rgb[0], rgb[1], rgb[2]), 0.0f, 1.0f));
    linear = {shortened(back.x), shortened(back.y), shortened(back.z)};
  }
  FontScope small(theme().fonts.small);
  ImGui::TextDisabled("Linear  %s", tripleText(linear).c_str());
  return state;
}

/// Three numbers side by side, or below one another when narrow.
EditState editTriple(glm::dvec3& value, const NumberStyle& base, const std::array<const char*, 3>& captions,
                     float width, const std::string& path) {
  EditState state;
  const float gap = px(4);
  const float each = std::floor((width - 2.0f * gap) / 3.0f);
  for (int i = 0; i < 3; ++i) {
    NumberStyle style = base;
    style.bar = false;
    style.caption = captions[static_cast<std::size_t>(i)];
    style.faulty = base.faulty && !(value[i] >= base.low && value[i] <= base.high);
    if (i > 0) ImGui::SameLine(0.0f, gap);
    state |= numberField(style.caption, value[i], style, each);
    logItem("field:", path + "[" + std::to_string(i) + "]");
  }
  return state;
}

/// A curve drawn into a frame, its whole range of x.
void drawPreview(const base::Curve& curve, const project::Spec* spec, ImVec2 min, ImVec2 max) {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (curve.points().empty()) {
    textEllipsis(ImVec2(min.x + px(8), min.y + ImGui::GetStyle().FramePadding.y), max.x, c.textDim, "Built-in");
    return;
  }
  double low = curve.points().front().y, high = low;
  for (const base::CurvePoint& point : curve.points()) {
    low = std::min(low, point.y);
    high = std::max(high, point.y);
  }
  const double x0 = spec != nullptr ? spec->xLow : 0.0, x1 = spec != nullptr ? spec->xHigh : 1.0;
  const float pad = px(4);
  const int steps = std::max(2, static_cast<int>((max.x - min.x - 2 * pad) / 2.0f));
  std::vector<ImVec2> line;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double y = curve(x0 + t * (x1 - x0));
    const double up = high > low ? (y - low) / (high - low) : 0.5;
    line.emplace_back(ImLerp(min.x + pad, max.x - pad, static_cast<float>(t)),
                      ImLerp(max.y - pad, min.y + pad, static_cast<float>(up)));
  }
  draw->AddPolyline(line.data(), static_cast<int>(line.size()), c.accent, 0, std::max(1.5f, px(1.5f)));
}

}  // namespace

void FieldPainter::edit(FieldRow& row, double& value, double fallback) {
  m_default = shownValue(fallback, row.look.number.shown);
  m_factsHaveRange = true;
  checkRange(row, value);
  report(row, numberField("value", value, row.look.number, widgetWidth()));
  logItem("field:", row.path);
}

void FieldPainter::edit(FieldRow& row, int& value, int fallback) {
  m_default = shownValue(fallback, row.look.number.shown);
  m_factsHaveRange = true;
  checkRange(row, value);
  NumberStyle style = row.look.number;
  style.whole = true;
  style.low = std::max(style.low, -2147483647.0);
  style.high = std::min(style.high, 2147483647.0);
  double number = value;
  report(row, numberField("value", number, style, widgetWidth()));
  value = static_cast<int>(std::clamp(number, -2147483647.0, 2147483647.0));
  logItem("field:", row.path);
}

void FieldPainter::edit(FieldRow& row, std::uint64_t& value, std::uint64_t fallback) {
  m_default = valueText(fallback);
  const float button = ImGui::GetFrameHeight() + px(4);
  std::string text = valueText(value);
  if (commitText("##value", text, widgetWidth() - button - px(4)) && readValue(text, value)) report(row, {true, true});
  logItem("field:", row.path);
  ImGui::SameLine(0.0f, px(4));
  if (iconButton("dice", icon::kDice, "Another seed")) {
    // Short numbers are easier to tell and to type; the step visits all of them (it has no factor in common with 9973).
    value = (value + 6151) % 9973 + 1;
    report(row, {true, true});
  }
  logItem("dice:", row.path);
}

void FieldPainter::edit(FieldRow& row, bool& value, bool fallback) {
  m_default = fallback ? "on" : "off";
  if (tickBox("value", value)) report(row, {true, true});
  logItem("field:", row.path);
}

void FieldPainter::edit(FieldRow& row, std::string& value, const std::string& fallback) {
  m_default = fallback;
  const bool file = !row.look.files.empty();
  const float button = file ? ImGui::GetFrameHeight() + px(8) : 0.0f;
  const bool wrong = !row.problem.empty();
  if (wrong) {
    ImGui::PushStyleColor(ImGuiCol_Border, theme().colours.error);
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, std::max(1.0f, px(1)));
  }
  if (commitText("##value", value, widgetWidth() - button, file ? "No file" : "")) report(row, {true, true});
  logItem("field:", row.path);
  if (wrong) {
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
  }
  if (!file) return;
  ImGui::SameLine(0.0f, px(4));
  if (iconButton("browse", icon::kFolder, "Choose a file")) {
    m_events.browse = row.path;
    m_events.files = row.look.files;
  }
  logItem("browse:", row.path);
}

void FieldPainter::edit(FieldRow& row, glm::dvec3& value, const glm::dvec3& fallback) {
  m_factsHaveRange = true;
  for (int i = 0; i < 3; ++i) checkRange(row, value[i]);
  if (!row.look.colour) {
    m_default = tripleText(fallback);
    report(row, editTriple(value, row.look.number, {"X", "Y", "Z"}, widgetWidth(), row.path));
    return;
  }
  const bool bright = row.look.number.high > 1.0;
  m_factsHaveRange = bright;
  m_default = bright ? tripleText(fallback) : hexText(fallback);
  if (swatchButton(value, bright ? tripleText(value) : hexText(value), widgetWidth(), row.look.number.faulty)) {
    ImGui::OpenPopup("pick");
  }
  logItem("field:", row.path);
  if (!ImGui::BeginPopup("pick")) return;
  const EditState state =
      bright ? editTriple(value, row.look.number, {"R", "G", "B"}, px(280), row.path) : pickColour(value);
  logItem("picker:", row.path);
  ImGui::EndPopup();
  report(row, state);
}

void FieldPainter::edit(FieldRow& row, base::Curve& value, const base::Curve& fallback) {
  m_default = fallback.points().empty() ? "built-in" : std::to_string(fallback.points().size()) + " points";
  const Palette& c = theme().colours;
  const bool pressed = ImGui::InvisibleButton("curve", ImVec2(widgetWidth(), ImGui::GetFrameHeight()));
  logItem("field:", row.path);
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  ImGui::RenderFrame(min, max, ImGui::IsItemHovered() ? c.fieldHover : c.field, true, ImGui::GetStyle().FrameRounding);
  drawPreview(value, row.spec, min, max);
  hoverText("Edit the curve");
  if (pressed) m_events.openCurve = row.path;
}

bool FieldPainter::choose(FieldRow& row, const std::vector<ChoiceItem>& items, std::size_t& chosen) {
  const std::size_t before = chosen;
  ImGui::SetNextItemWidth(widgetWidth());
  const bool open = ImGui::BeginCombo("##value", chosen < items.size() ? items[chosen].label : "Unknown");
  if (!open) logItem("field:", row.path);
  if (open) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (ImGui::Selectable(items[i].label, i == chosen)) chosen = i;
      logItem("option:", items[i].label);
      if (*items[i].help != '\0') hoverText(items[i].help);
      if (i == chosen && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
  }
  if (chosen == before) return false;
  report(row, {true, true});
  return true;
}

}  // namespace sward::editor
