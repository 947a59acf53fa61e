#include "widgets/number_field.h"

#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui_internal.h>

namespace sward::editor {
namespace {

/// The one number that is being dragged or typed; ImGui has one active item too.
struct Session {
  ImGuiID id = 0;
  bool typing = false;
  double start = 0.0;  ///< value before the drag
  double raw = 0.0;    ///< shown value before rounding
  float lastX = 0.0f;
  bool moved = false;
  std::array<char, 64> text{};
};

Session& session() {
  static Session current;
  return current;
}

bool hasSoftRange(const NumberStyle& style) {
  constexpr double kWide = std::numeric_limits<double>::max() / 4;
  return style.softLow > -kWide && style.softHigh < kWide && style.softHigh > style.softLow;
}

bool usesLogarithm(const NumberStyle& style) {
  return style.logarithmic && hasSoftRange(style) && style.softLow > 0.0;
}

/// Where the value stands in the soft range, 0 to 1.
double fractionOf(double value, const NumberStyle& style) {
  if (usesLogarithm(style)) {
    if (value <= style.softLow) return 0.0;
    return std::clamp(std::log(value / style.softLow) / std::log(style.softHigh / style.softLow), 0.0, 1.0);
  }
  return std::clamp((value - style.softLow) / (style.softHigh - style.softLow), 0.0, 1.0);
}

/// What a pixel of drag is worth at `raw`, both in shown units.
double worthOfPixel(double raw, const NumberStyle& style, float width) {
  const double scale = style.shown.perStored;
  const double across = std::max(width, px(160));
  if (usesLogarithm(style)) {
    return std::max(std::abs(raw), style.softLow * scale) * std::log(style.softHigh / style.softLow) / across;
  }
  if (hasSoftRange(style)) return (style.softHigh - style.softLow) * scale / across;
  return std::max(std::abs(raw) * 0.01, style.whole ? 0.1 : 1e-3);
}

/// `raw` rounded to a power of ten of about a pixel's worth.
double roundedTo(double raw, double worth) {
  const double step = std::pow(10.0, std::floor(std::log10(worth) + 0.3));
  return cleaned(std::round(raw / step) * step);
}

bool drag(double& value, const NumberStyle& style, float width) {
  Session& s = session();
  const ImGuiIO& io = ImGui::GetIO();
  if (!s.moved && !ImGui::IsMouseDragging(0, io.MouseDragThreshold * 0.5f)) return false;
  s.moved = true;
  const double pixels = static_cast<double>(io.MousePos.x - s.lastX);
  s.lastX = io.MousePos.x;
  if (pixels == 0.0) return false;
  const double scale = style.shown.perStored;
  const double worth = worthOfPixel(s.raw, style, width) * (io.KeyShift ? 0.1 : 1.0);
  if (usesLogarithm(style)) {
    const double start = s.raw > 0.0 ? s.raw : style.softLow * scale;
    s.raw = start * std::exp(pixels * worth / std::max(start, style.softLow * scale));
  } else {
    s.raw += pixels * worth;
  }
  s.raw = std::clamp(s.raw, style.low * scale, style.high * scale);
  double shown = roundedTo(s.raw, worth);
  if (style.whole) shown = std::round(shown);
  // Decades never end at 0, which some fields use for "off": it stands at half of the range's lower end.
  if (usesLogarithm(style) && style.low <= 0.0 && s.raw < 0.5 * style.softLow * scale) shown = 0.0;
  const double next = std::clamp(cleaned(shown / scale), style.low, style.high);
  const bool changed = next != value;
  value = next;
  return changed;
}

void startTyping(ImGuiID id, double value, const NumberStyle& style) {
  Session& s = session();
  s.id = id;
  s.typing = true;
  std::snprintf(s.text.data(), s.text.size(), "%s", exactValue(value, style.shown).c_str());
}

/// The field as an entry; its value is taken over once, when it is left: by Enter, or by a click elsewhere, which ImGui
/// tells by another active item before this one is drawn.
EditState typeIn(const ImRect& box, ImGuiID id, const char* label, double& value, const NumberStyle& style,
                 bool starting) {
  Session& s = session();
  if (starting || ImGui::GetActiveID() == id) {
    ImGui::TempInputText(box, id, label, s.text.data(), static_cast<int>(s.text.size()),
                         ImGuiInputTextFlags_AutoSelectAll);
    if (ImGui::GetActiveID() == id) return {};
  }
  s.id = 0;
  const std::optional<double> typed = parsedValue(s.text.data(), style.unit, style.shown);
  if (!typed || s.text.data() == exactValue(value, style.shown)) return {};
  const double next = std::clamp(style.whole ? std::round(*typed) : *typed, style.low, style.high);
  if (next == value) return {};
  value = next;
  return {true, true};
}

void drawField(const ImRect& box, ImGuiID id, double value, const NumberStyle& style, bool hovered) {
  const Palette& c = theme().colours;
  const ImGuiStyle& look = ImGui::GetStyle();
  const bool active = ImGui::GetActiveID() == id;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  ImGui::RenderNavHighlight(box, id);
  ImGui::RenderFrame(box.Min, box.Max,
                     active    ? c.fieldActive
                     : hovered ? c.fieldHover
                               : c.field,
                     true, look.FrameRounding);
  if (style.bar && hasSoftRange(style) && !style.faulty) {
    const double from = style.softLow < 0.0 && style.softHigh > 0.0 ? fractionOf(0.0, style) : 0.0;
    const auto [a, b] = std::minmax({from, fractionOf(value, style)});
    const float inset = look.FrameBorderSize;
    const float x0 = ImLerp(box.Min.x + inset, box.Max.x - inset, static_cast<float>(a));
    const float x1 = ImLerp(box.Min.x + inset, box.Max.x - inset, static_cast<float>(b));
    if (x1 - x0 >= 1.0f) {
      // Clipped, not shortened, so that the bar keeps the field's round corners.
      draw->PushClipRect(ImVec2(x0, box.Min.y), ImVec2(x1, box.Max.y), true);
      draw->AddRectFilled(ImVec2(box.Min.x + inset, box.Min.y + inset), ImVec2(box.Max.x - inset, box.Max.y - inset),
                          active || hovered ? mixed(c.accentFill, faded(c.accent, 0.55f), 0.5f) : c.accentFill,
                          look.FrameRounding);
      draw->PopClipRect();
    }
  }
  if (style.faulty) draw->AddRect(box.Min, box.Max, c.error, look.FrameRounding, 0, std::max(1.0f, px(1)));
  const ImU32 ink = style.faulty ? c.error : ImGui::GetColorU32(ImGuiCol_Text);
  const ImU32 dim = style.faulty ? c.error : ImGui::GetColorU32(ImGuiCol_TextDisabled);
  draw->PushClipRect(box.Min, box.Max, true);
  ImVec2 at(box.Min.x + look.FramePadding.x, box.Min.y + look.FramePadding.y);
  const auto print = [&](const std::string& text, ImU32 colour) {
    draw->AddText(at, colour, text.c_str());
    at.x += ImGui::CalcTextSize(text.c_str()).x;
  };
  if (*style.caption != '\0') print(std::string(style.caption) + "  ", dim);
  print(shownNumber(value, style.shown), ink);
  // A narrow field shows its number rather than half a unit.
  const std::string suffix = (style.shown.attached ? "" : " ") + style.shown.suffix;
  if (at.x + ImGui::CalcTextSize(suffix.c_str()).x <= box.Max.x - px(3)) print(suffix, dim);
  draw->PopClipRect();
}

/// True when this frame turns the field into an entry; else the item may have become active for a drag.
bool activate(ImGuiID id, double value, const NumberStyle& style, bool hovered) {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  const bool tabbed = (g.LastItemData.StatusFlags & ImGuiItemStatusFlags_FocusedByTabbing) != 0;
  const bool clicked = hovered && g.IO.MouseClicked[0];
  const bool types = tabbed || (clicked && (g.IO.KeyCtrl || g.IO.MouseClickedCount[0] == 2)) ||
                     g.NavActivateInputId == id || g.NavActivateId == id;
  if (!clicked && !types) return false;
  ImGui::SetActiveID(id, g.CurrentWindow);
  ImGui::SetFocusID(id, g.CurrentWindow);
  ImGui::FocusWindow(g.CurrentWindow);
  // Escape belongs to the drag, which takes its change back; ImGui would only let go.
  g.ActiveIdUsingNavInputMask |= 1 << ImGuiNavInput_Cancel;
  Session& s = session();
  s = Session{};
  s.id = id;
  s.start = value;
  s.raw = value * style.shown.perStored;
  s.lastX = g.IO.MouseClickedPos[0].x;
  if (types) startTyping(id, value, style);
  return types;
}

EditState dragged(ImGuiID id, double& value, const NumberStyle& style, float width) {
  Session& s = session();
  ImGuiContext& g = *ImGui::GetCurrentContext();
  EditState state;
  if (g.ActiveId != id || s.id != id) return state;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
    state.changed = value != s.start;
    state.finished = s.moved;
    value = s.start;
  } else if (!g.IO.MouseDown[0]) {
    state.finished = s.moved;
  } else {
    state.changed = drag(value, style, width);
    return state;
  }
  s.id = 0;
  ImGui::ClearActiveID();
  return state;
}

}  // namespace

EditState numberField(const char* label, double& value, const NumberStyle& style, float width) {
  ImGuiWindow* window = ImGui::GetCurrentWindow();
  if (window->SkipItems) return {};
  const ImGuiID id = window->GetID(label);
  const ImVec2 pos = window->DC.CursorPos;
  const ImRect box(pos, ImVec2(pos.x + width, pos.y + ImGui::GetFrameHeight()));
  ImGui::ItemSize(box, ImGui::GetStyle().FramePadding.y);
  if (!ImGui::ItemAdd(box, id, &box, ImGuiItemFlags_Inputable)) return {};
  Session& s = session();
  const bool hovered = ImGui::ItemHoverable(box, id);
  const bool wasTyping = s.id == id && s.typing;
  if (wasTyping || activate(id, value, style, hovered)) return typeIn(box, id, label, value, style, !wasTyping);
  const EditState state = dragged(id, value, style, width);
  if (hovered || ImGui::GetActiveID() == id) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (state.changed) ImGui::MarkItemEdited(id);
  drawField(box, id, value, style, hovered);
  return state;
}

}  // namespace sward::editor
