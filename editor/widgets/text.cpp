#include "widgets/text.h"

#include "widgets/theme.h"

#include <algorithm>
#include <cctype>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

namespace sward::editor {
namespace {

std::string lowered(std::string_view text) {
  std::string copy(text);
  std::transform(copy.begin(), copy.end(), copy.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return copy;
}

/// The text of the field that is being typed in; ImGui has one such field too.
struct TextSession {
  ImGuiID id = 0;
  std::string text;
};

TextSession& textSession() {
  static TextSession session;
  return session;
}

}  // namespace

void textEllipsis(ImVec2 at, float right, ImU32 colour, std::string_view text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  const ImVec2 size = ImGui::CalcTextSize(begin, end);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  // Descenders of some fonts reach below the line.
  const float bottom = at.y + size.y * 1.25f;
  ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), at, ImVec2(right, bottom), right, right, begin, end, &size);
  ImGui::PopStyleColor();
}

bool holdsWords(std::string_view text, std::string_view words) {
  const std::string low = lowered(text);
  std::size_t at = 0;
  while (at < words.size()) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (end > at && low.find(lowered(words.substr(at, end - at))) == std::string::npos) return false;
    at = end + 1;
  }
  return true;
}

bool hoveredForAWhile() {
  constexpr float kDelayS = 0.45f;
  return ImGui::IsItemHovered() && ImGui::GetCurrentContext()->HoveredIdTimer > kDelayS;
}

void hoverText(const char* text, const char* shortcut) {
  if (!hoveredForAWhile()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(px(340));
  ImGui::TextUnformatted(text);
  if (*shortcut != '\0') {
    ImGui::SameLine(0.0f, px(12));
    ImGui::TextDisabled("%s", shortcut);
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool commitText(const char* id, std::string& value, float width, const char* hint) {
  TextSession& session = textSession();
  const ImGuiID item = ImGui::GetID(id);
  const bool ours = session.id == item;
  std::string fresh = value;
  ImGui::SetNextItemWidth(width);
  ImGui::InputTextWithHint(id, hint, ours ? &session.text : &fresh);
  if (ImGui::IsItemActivated()) session = {item, value};
  if (!ours || ImGui::IsItemActive()) return false;
  session.id = 0;
  if (session.text == value) return false;
  value = session.text;
  return true;
}

}  // namespace sward::editor
