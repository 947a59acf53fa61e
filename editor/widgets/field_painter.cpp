#include "widgets/field_painter.h"

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

constexpr float kGutter = 14.0f;  ///< left of labels: the mark of changed values and the chevrons of titles
constexpr float kIndent = 10.0f;  ///< of a struct's rows

double heldIn(double value, const NumberStyle& style) {
  return std::clamp(value, style.low, style.high);
}

}  // namespace

FieldPainter::FieldPainter(std::string root, const FieldOptions& options) : m_options(options) {
  ImGui::PushID(root.c_str());
  m_left = ImGui::GetCursorScreenPos().x;
  m_width = ImGui::GetContentRegionAvail().x;
  m_groups.emplace_back();
  m_groupOpen.push_back(true);
  m_matchAll.push_back(options.filter.empty());
}

FieldEvents FieldPainter::finish() {
  ImGui::PopID();
  return std::move(m_events);
}

bool FieldPainter::matches(const std::string& label) const {
  return m_matchAll.back() || holdsWords(label, m_options.filter);
}

float FieldPainter::widgetWidth() const {
  return std::max(px(60), m_left + m_width - ImGui::GetCursorScreenPos().x);
}

bool FieldPainter::group(const std::string& title) {
  if (title == m_groups.back()) return m_groupOpen.back();
  m_groups.back() = title;
  m_groupOpen.back() = title.empty() || foldTitle(title, "", nullptr);
  return m_groupOpen.back();
}

void FieldPainter::endGroup() {
  m_groups.back().clear();
  m_groupOpen.back() = true;
}

bool FieldPainter::foldTitle(const std::string& title, const std::string& path, bool* on) {
  const Palette& c = theme().colours;
  ImGui::PushID(title.c_str());
  ImGui::Dummy(ImVec2(0.0f, px(2)));
  const float height = ImGui::GetFrameHeight();
  const float left = m_left + px(kIndent) * static_cast<float>(m_depth);
  ImGui::SetCursorScreenPos(ImVec2(left, ImGui::GetCursorScreenPos().y));
  const float room = on != nullptr ? px(16) + px(6) : 0.0f;
  bool* open = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("open"), true);
  const bool pressed =
      ImGui::InvisibleButton("title", ImVec2(std::max(px(20), m_left + m_width - left - room), height));
  if (pressed) *open = !*open;
  const bool shown = (*open || !m_options.filter.empty()) && (on == nullptr || *on);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  logItem("fold:", title);
  const ImU32 ink = ImGui::IsItemHovered() ? c.text : mixed(c.textDim, c.text, 0.55f);
  const float y = min.y + ImGui::GetStyle().FramePadding.y;
  draw->AddText(ImVec2(min.x - px(3), y), faded(ink, 0.8f), shown ? icon::kChevronDown : icon::kChevronRight);
  {
    FontScope strong(theme().fonts.strong);
    draw->AddText(ImVec2(min.x + px(kGutter), y), ink, title.c_str());
    const float end = min.x + px(kGutter) + ImGui::CalcTextSize(title.c_str()).x + px(8);
    const float mid = std::round(0.5f * (min.y + max.y));
    if (end < max.x) draw->AddLine(ImVec2(end, mid), ImVec2(max.x, mid), faded(c.border, 0.7f));
  }
  if (on != nullptr) {
    ImGui::SameLine(0.0f, px(6));
    tickBox("on", *on);
    logItem("enable:", path);
  }
  ImGui::PopID();
  return shown;
}

bool FieldPainter::beginRow(FieldRow& row) {
  if (!matches(row.look.label)) return false;
  if (row.look.advanced && !m_options.advanced && m_options.filter.empty() && !row.differs) return false;
  if (!group(row.look.group)) return false;
  findProblem(row);
  ImGui::PushID(row.path.c_str());
  const float indent = px(kIndent) * static_cast<float>(m_depth);
  const ImVec2 at(m_left + indent, ImGui::GetCursorScreenPos().y);
  const float labels = std::round(m_width * m_options.labelShare);
  const float height = ImGui::GetFrameHeight();
  m_rowMin = ImVec2(m_left, at.y);
  m_rowMax = ImVec2(m_left + m_width, at.y + height);
  ImGui::SetCursorScreenPos(at);
  label(row, std::max(px(20), labels - indent - px(6)));
  ImGui::SetCursorScreenPos(ImVec2(m_left + labels, at.y));
  return true;
}

void FieldPainter::label(const FieldRow& row, float width) {
  const Palette& c = theme().colours;
  ImGui::InvisibleButton("label", ImVec2(width, ImGui::GetFrameHeight()));
  logItem("label:", row.path);
  m_labelHovered = hoveredForAWhile();
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (row.differs) {
    draw->AddCircleFilled(ImVec2(min.x + px(4), 0.5f * (min.y + max.y)), std::max(2.0f, px(2.5f)), c.accent, 12);
  }
  const ImU32 ink = !row.problem.empty() ? c.error : row.differs ? c.text : mixed(c.textDim, c.text, 0.7f);
  textEllipsis(ImVec2(min.x + px(kGutter), min.y + ImGui::GetStyle().FramePadding.y), max.x, ink, row.look.label);
}

void FieldPainter::findProblem(FieldRow& row) const {
  if (m_options.problems == nullptr) return;
  for (const project::Problem& problem : *m_options.problems) {
    const bool here = problem.where == row.path ||
                      (problem.where.starts_with(row.path) && problem.where.substr(row.path.size(), 1) == "[");
    if (!here) continue;
    row.problem = problem.what + ". " + problem.remedy;
    row.look.number.faulty = problem.fatal;
    return;
  }
}

void FieldPainter::checkRange(FieldRow& row, double value) const {
  const NumberStyle& style = row.look.number;
  if (value >= style.low && value <= style.high) return;
  row.look.number.faulty = true;
  if (row.problem.empty())
    row.problem = shownValue(value, style.shown) + " is out of range. Give " + lowerFirst(rangeText(row)) + ".";
}

std::string FieldPainter::rangeText(const FieldRow& row) const {
  constexpr double kUnbounded = std::numeric_limits<double>::max() / 4;
  const NumberStyle& style = row.look.number;
  const auto shown = [&style](double value) { return shownValue(value, style.shown); };
  if (style.low > -kUnbounded && style.high < kUnbounded) return shown(style.low) + " to " + shown(style.high);
  if (style.low > -kUnbounded) return "At least " + shown(style.low);
  if (style.high < kUnbounded) return "At most " + shown(style.high);
  return {};
}

void FieldPainter::tooltip(const FieldRow& row) const {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(340));
  {
    FontScope strong(theme().fonts.strong);
    ImGui::TextUnformatted(row.look.label.c_str());
  }
  if (!row.look.help.empty()) ImGui::TextUnformatted(row.look.help.c_str());
  if (!row.problem.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, theme().colours.error);
    ImGui::TextUnformatted(row.problem.c_str());
    ImGui::PopStyleColor();
  }
  std::string facts = m_factsHaveRange ? rangeText(row) : std::string();
  if (!m_default.empty()) facts += (facts.empty() ? "Default " : "   \u00B7   default ") + m_default;
  {
    FontScope small(theme().fonts.small);
    if (!facts.empty()) ImGui::TextDisabled("%s", facts.c_str());
    ImGui::TextDisabled("%s", row.path.c_str());
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

RowMenu FieldPainter::endRow(FieldRow& row) {
  if (m_labelHovered || (!row.problem.empty() && hoveredForAWhile())) tooltip(row);
  m_default.clear();
  m_factsHaveRange = false;
  RowMenu chosen = RowMenu::None;
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(m_rowMin, m_rowMax) && ImGui::IsMouseReleased(1)) {
    ImGui::OpenPopup("menu");
  }
  if (ImGui::BeginPopup("menu")) {
    const auto item = [&](const char* sign, const char* text, bool enabled, RowMenu choice) {
      if (ImGui::MenuItem((std::string(sign) + "   " + text).c_str(), nullptr, false, enabled)) chosen = choice;
      logItem("menu:", text);
    };
    item(icon::kReset, "Reset to default", row.differs, RowMenu::Reset);
    ImGui::Separator();
    item(icon::kCopy, "Copy value", true, RowMenu::Copy);
    item(icon::kPaste, "Paste value", !clipboard().empty(), RowMenu::Paste);
    if (ImGui::MenuItem((std::string(icon::kCopy) + "   Copy path").c_str())) copy(row.path);
    logItem("menu:", "Copy path");
    ImGui::EndPopup();
  }
  ImGui::PopID();
  if (chosen == RowMenu::Reset) report(row, {true, true});
  return chosen;
}

void FieldPainter::switchOptional(FieldRow& row) {
  if (tickBox("on", row.enabled)) report(row, {true, true});
  logItem("enable:", row.path);
  ImGui::SameLine(0.0f, px(6));
}

void FieldPainter::showUnset(const FieldRow&) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Not set");
}

bool FieldPainter::beginStruct(FieldRow& row, bool innerMatches, bool* on) {
  const bool named = matches(row.look.label);
  if (!named && !innerMatches) return false;
  if (!group(row.look.group)) return false;
  ImGui::PushID(row.path.c_str());
  const bool was = on != nullptr && *on;
  const bool open = foldTitle(row.look.label, row.path, on);
  if (on != nullptr && *on != was) report(row, {true, true});
  if (!open) {
    ImGui::PopID();
    return false;
  }
  m_groups.emplace_back();
  m_groupOpen.push_back(true);
  m_matchAll.push_back(named);
  ++m_depth;
  return true;
}

void FieldPainter::endStruct() {
  m_groups.pop_back();
  m_groupOpen.pop_back();
  m_matchAll.pop_back();
  --m_depth;
  ImGui::PopID();
}

void FieldPainter::report(const FieldRow& row, const EditState& state) {
  if (!state.changed && !state.finished) return;
  m_events.changed |= state.changed;
  m_events.finished |= state.finished;
  m_events.path = row.path;
  m_events.label = lowerFirst(row.look.label);
}

void FieldPainter::copy(const std::string& text) const {
  ImGui::SetClipboardText(text.c_str());
}

std::string FieldPainter::clipboard() {
  const char* text = ImGui::GetClipboardText();
  return text != nullptr ? text : "";
}

void FieldPainter::hold(const FieldRow& row, double& value) {
  value = heldIn(value, row.look.number);
}

void FieldPainter::hold(const FieldRow& row, int& value) {
  value = static_cast<int>(heldIn(value, row.look.number));
}

void FieldPainter::hold(const FieldRow& row, glm::dvec3& value) {
  for (int i = 0; i < 3; ++i) value[i] = heldIn(value[i], row.look.number);
}

void FieldPainter::hold(const FieldRow& row, base::Curve& value) {
  std::vector<base::CurvePoint> points;
  for (base::CurvePoint point : value.points()) {
    point.x = row.spec != nullptr ? std::clamp(point.x, row.spec->xLow, row.spec->xHigh) : point.x;
    point.y = heldIn(point.y, row.look.number);
    // Points that the range pushes onto one another are one.
    if (points.empty() || point.x > points.back().x) points.push_back(point);
  }
  if (auto held = base::Curve::fromPoints(std::move(points)); held.ok()) value = std::move(held).value();
}

}  // namespace sward::editor
