#include "widgets/parts.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/text.h"
#include "widgets/theme.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

namespace sward::editor {
namespace {

/// Text in the middle of the last item.
void centred(const char* text, ImU32 colour) {
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const ImVec2 size = ImGui::CalcTextSize(text);
  const ImVec2 at(std::round(0.5f * (min.x + max.x - size.x)), std::round(0.5f * (min.y + max.y - size.y)));
  ImGui::GetWindowDrawList()->AddText(at, colour, text);
}

bool flatButton(const char* id, const char* text, ImVec2 size, bool on, bool enabled) {
  const Palette& c = theme().colours;
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::InvisibleButton(id, size);
  const bool hot = ImGui::IsItemHovered(), down = ImGui::IsItemActive();
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const float rounding = ImGui::GetStyle().FrameRounding;
  const ImU32 ground = on ? c.accentFill : down ? c.fieldActive : hot ? c.fieldHover : 0;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if ((ground & IM_COL32_A_MASK) != 0) draw->AddRectFilled(min, max, ground, rounding);
  ImGui::RenderNavHighlight(ImRect(min, max), ImGui::GetItemID());
  const ImU32 ink = on ? mixed(c.text, c.accentStrong, 0.75f) : hot ? c.text : mixed(c.textDim, c.text, 0.6f);
  centred(text, enabled ? ink : faded(c.textDim, 0.45f));
  ImGui::EndDisabled();
  return pressed && enabled;
}

bool textButton(const char* id, const char* text, bool enabled, float width, bool primary) {
  const Palette& c = theme().colours;
  FontScope strong(primary ? theme().fonts.strong : nullptr);
  ImGui::BeginDisabled(!enabled);
  const ImVec2 padding(px(16), ImGui::GetStyle().FramePadding.y);
  const float wide = std::max(width, ImGui::CalcTextSize(text).x + 2 * padding.x);
  const bool pressed = ImGui::InvisibleButton(id, ImVec2(wide, ImGui::GetFontSize() + 2 * padding.y));
  logItem("action:", id);
  const bool hot = ImGui::IsItemHovered(), down = ImGui::IsItemActive();
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const ImU32 ground = primary ? (hot || down ? c.accentStrong : c.accent)
                               : (down  ? c.fieldActive
                                  : hot ? c.fieldHover
                                        : c.field);
  ImGui::RenderNavHighlight(ImRect(min, max), ImGui::GetItemID());
  const float alpha = enabled ? 1.0f : ImGui::GetStyle().DisabledAlpha;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(min, max, faded(ground, alpha), ImGui::GetStyle().FrameRounding);
  if (!primary) draw->AddRect(min, max, faded(c.border, alpha), ImGui::GetStyle().FrameRounding);
  centred(text, faded(primary ? c.onAccent : c.text, alpha));
  ImGui::EndDisabled();
  return pressed && enabled;
}

}  // namespace

bool iconButton(const char* id, const char* icon, const char* tooltip, const char* shortcut, bool enabled) {
  return toolToggle(id, icon, false, tooltip, shortcut, enabled);
}

bool toolToggle(const char* id, const char* icon, bool on, const char* tooltip, const char* shortcut, bool enabled) {
  const float side = ImGui::GetFrameHeight();
  const bool pressed = flatButton(id, icon, ImVec2(side + px(4), side), on, enabled);
  logItem("action:", id);
  if (*tooltip != '\0') hoverText(tooltip, shortcut);
  return pressed;
}

bool primaryButton(const char* id, const char* text, bool enabled, float width) {
  return textButton(id, text, enabled, width, true);
}

bool plainButton(const char* id, const char* text, bool enabled, float width) {
  return textButton(id, text, enabled, width, false);
}

bool tickBox(const char* id, bool& on) {
  const Palette& c = theme().colours;
  const float height = ImGui::GetFrameHeight(), side = px(16);
  const bool pressed = ImGui::InvisibleButton(id, ImVec2(side, height));
  if (pressed) on = !on;
  const ImVec2 corner = ImGui::GetItemRectMin();
  const ImVec2 min(corner.x, std::round(corner.y + 0.5f * (height - side)));
  const ImVec2 max(min.x + side, min.y + side);
  const bool hot = ImGui::IsItemHovered();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  ImGui::RenderNavHighlight(ImRect(min, max), ImGui::GetItemID());
  const float rounding = px(4);
  draw->AddRectFilled(min, max, on ? (hot ? c.accentStrong : c.accent) : hot ? c.fieldHover : c.field, rounding);
  if (!on) draw->AddRect(min, max, mixed(c.border, c.textDim, hot ? 0.8f : 0.4f), rounding, 0, std::max(1.0f, px(1)));
  if (on) {
    const auto at = [&](float x, float y) { return ImVec2(min.x + x * side, min.y + y * side); };
    const ImVec2 mark[] = {at(0.24f, 0.53f), at(0.43f, 0.72f), at(0.77f, 0.30f)};
    draw->AddPolyline(mark, 3, c.onAccent, 0, std::max(1.6f, px(2)));
  }
  return pressed;
}

bool searchBox(const char* id, std::string& text, float width, const char* hint) {
  const Palette& c = theme().colours;
  const float height = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(id);
  ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, 0.5f * height);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(px(31), ImGui::GetStyle().FramePadding.y));
  ImGui::SetNextItemWidth(width);
  bool changed = ImGui::InputTextWithHint("##text", hint, &text);
  ImGui::PopStyleVar(2);
  logItem("search:", id);
  const bool emptied = ImGui::IsItemActive() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  const float line = at.y + ImGui::GetStyle().FramePadding.y;
  ImGui::GetWindowDrawList()->AddText(ImVec2(at.x + px(8), line), c.textDim, icon::kSearch);
  if (!text.empty()) {
    const ImVec2 next = ImGui::GetCursorScreenPos();
    ImGui::SetItemAllowOverlap();
    ImGui::SetCursorScreenPos(ImVec2(at.x + width - height - px(2), at.y));
    const bool cleared = flatButton("clear", icon::kClose, ImVec2(height, height), false, true);
    logItem("action:clear ", id);
    if (cleared || emptied) {
      text.clear();
      changed = true;
    }
    ImGui::SetCursorScreenPos(next);
  }
  ImGui::PopID();
  return changed;
}

bool sectionHeader(const char* id, const char* title, bool openAtFirst, const char* count) {
  const Palette& c = theme().colours;
  bool* open = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID(id), openAtFirst);
  const float height = ImGui::GetFrameHeight() + px(4);
  if (ImGui::InvisibleButton(id, ImVec2(std::max(px(20), ImGui::GetContentRegionAvail().x), height))) *open = !*open;
  logItem("section:", id);
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const bool hot = ImGui::IsItemHovered();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(min, max, hot ? c.fieldHover : c.raised, ImGui::GetStyle().FrameRounding);
  ImGui::RenderNavHighlight(ImRect(min, max), ImGui::GetItemID());
  const float y = std::round(0.5f * (min.y + max.y - ImGui::GetFontSize()));
  draw->AddText(ImVec2(min.x + px(5), y), c.textDim, *open ? icon::kChevronDown : icon::kChevronRight);
  float right = max.x - px(8);
  if (*count != '\0') {
    const float wide = ImGui::CalcTextSize(count).x;
    draw->AddText(ImVec2(right - wide, y), c.textDim, count);
    right -= wide + px(8);
  }
  FontScope strong(theme().fonts.strong);
  textEllipsis(ImVec2(min.x + px(24), y), right, c.text, title);
  return *open;
}

bool progressPill(const char* id, const char* text, float fraction, float width, bool cancellable) {
  const Palette& c = theme().colours;
  const float height = ImGui::GetFrameHeight();
  ImGui::PushID(id);
  ImGui::Dummy(ImVec2(width, height));
  logItem("progress:", id);
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const float round = 0.5f * height;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(min, max, c.field, round);
  // An unknown end: a band that passes every two seconds.
  const float phase = static_cast<float>(std::fmod(ImGui::GetTime() * 0.5, 1.0));
  const float from = fraction < 0.0f ? phase * 1.3f - 0.3f : 0.0f;
  const float to = fraction < 0.0f ? from + 0.3f : std::clamp(fraction, 0.0f, 1.0f);
  draw->PushClipRect(ImVec2(min.x + std::max(0.0f, from) * width, min.y),
                     ImVec2(min.x + std::min(1.0f, to) * width, max.y), true);
  draw->AddRectFilled(min, max, c.accentFill, round);
  draw->PopClipRect();
  if (theme().kind == ThemeKind::Light) draw->AddRect(min, max, c.border, round);
  const float room = cancellable ? height : px(10);
  textEllipsis(ImVec2(min.x + px(12), min.y + ImGui::GetStyle().FramePadding.y), max.x - room, c.text, text);
  bool cancelled = false;
  if (cancellable) {
    const ImVec2 next = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos(ImVec2(max.x - height, min.y));
    cancelled = flatButton("cancel", icon::kClose, ImVec2(height, height), false, true);
    logItem("action:cancel ", id);
    hoverText("Cancel");
    ImGui::SetCursorScreenPos(next);
  }
  ImGui::PopID();
  return cancelled;
}

void keyCaps(const char* shortcut) {
  const Palette& c = theme().colours;
  FontScope small(theme().fonts.small);
  std::string_view rest(shortcut);
  bool first = true;
  while (!rest.empty()) {
    // "Ctrl++" ends in the key "+".
    const std::size_t plus = rest.find('+', 1);
    const std::string key(rest.substr(0, plus));
    rest = plus == std::string_view::npos ? std::string_view() : rest.substr(plus + 1);
    if (!first) ImGui::SameLine(0.0f, px(3));
    first = false;
    const ImVec2 text = ImGui::CalcTextSize(key.c_str());
    // As high as a field, so that it stands in line with one; the cap itself is in the middle.
    const float height = text.y + px(6), line = std::max(height, ImGui::GetFrameHeight());
    ImGui::Dummy(ImVec2(std::max(height, text.x + px(12)), line));
    const float top = std::round(ImGui::GetItemRectMin().y + 0.5f * (line - height));
    const ImVec2 min(ImGui::GetItemRectMin().x, top), max(ImGui::GetItemRectMax().x, top + height);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(min, max, c.border, px(4));
    draw->AddRectFilled(min, ImVec2(max.x, max.y - px(2)), c.field, px(4));
    draw->AddRect(min, max, c.border, px(4));
    draw->AddText(ImVec2(std::round(0.5f * (min.x + max.x - text.x)), min.y + px(2)), c.text, key.c_str());
  }
}

bool thumbnailCell(const char* id, const char* name, ImTextureID texture, const char* icon, bool selected, float side) {
  const Palette& c = theme().colours;
  const float line = ImGui::GetTextLineHeight();
  const bool pressed = ImGui::InvisibleButton(id, ImVec2(side, side + line + px(8)));
  logItem("cell:", id);
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const bool hot = ImGui::IsItemHovered();
  const float rounding = px(6), pad = px(4);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (selected || hot) draw->AddRectFilled(min, max, selected ? c.accentFill : faded(c.text, 0.06f), rounding);
  const ImVec2 a(min.x + pad, min.y + pad), b(max.x - pad, min.y + side - pad);
  if (texture != nullptr) {
    draw->AddImageRounded(texture, a, b, ImVec2(0, 0), ImVec2(1, 1), IM_COL32_WHITE, px(4));
  } else {
    draw->AddRectFilled(a, b, c.field, px(4));
    const float size = std::round(side * 0.4f);
    ImFont* font = ImGui::GetFont();
    const ImVec2 sign = font->CalcTextSizeA(size, FLT_MAX, 0.0f, icon);
    draw->AddText(font, size, ImVec2(0.5f * (a.x + b.x - sign.x), 0.5f * (a.y + b.y - sign.y)), c.textDim, icon);
  }
  if (selected) draw->AddRect(min, max, c.accent, rounding, 0, std::max(1.0f, px(1.5f)));
  ImGui::RenderNavHighlight(ImRect(min, max), ImGui::GetItemID());
  const float wide = ImGui::CalcTextSize(name).x;
  const float x = std::max(min.x + pad, std::round(0.5f * (min.x + max.x - wide)));
  textEllipsis(ImVec2(x, min.y + side + px(1)), max.x - pad, selected ? c.text : mixed(c.textDim, c.text, 0.6f), name);
  return pressed;
}

bool splitHandle(const char* id, bool upright, float length, float& size, float least, float most, float usual) {
  const Palette& c = theme().colours;
  const float thick = px(7);
  ImGui::InvisibleButton(id, upright ? ImVec2(thick, length) : ImVec2(length, thick));
  logItem("split:", id);
  const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float before = size;
  if (hot) ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemActive()) size += upright ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) size = usual;
  size = std::clamp(size, least, std::max(least, most));
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const ImVec2 mid(0.5f * (min.x + max.x), 0.5f * (min.y + max.y));
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::IsItemActive() ? c.accent : hot ? faded(c.accent, 0.7f) : faded(c.textDim, 0.35f);
  const float half = px(hot ? 24 : 14), line = px(1);
  if (upright) {
    draw->AddRectFilled(ImVec2(mid.x - line, mid.y - half), ImVec2(mid.x + line, mid.y + half), ink, line);
  } else {
    draw->AddRectFilled(ImVec2(mid.x - half, mid.y - line), ImVec2(mid.x + half, mid.y + line), ink, line);
  }
  return size != before;
}

void hint(const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, theme().colours.textDim);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

}  // namespace sward::editor
