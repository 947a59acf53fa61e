#include "app/palette.h"

#include "widgets/item_log.h"
#include "widgets/theme.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace sward::editor {
namespace {

constexpr const char* kPopup = "##palette";
constexpr float kWidth = 520.0f, kListHeight = 320.0f, kRowHeight = 26.0f;

bool pressed(ImGuiKey key) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

}  // namespace

const Action* CommandPalette::row(const Action& action, bool selected, float width) {
  const bool enabled = action.isEnabled();
  const ImVec2 start = ImGui::GetCursorPos();
  const bool clicked = ImGui::Selectable(("##" + action.id).c_str(), selected,
                                         enabled ? 0 : ImGuiSelectableFlags_Disabled, {0.0f, px(kRowHeight)});
  logItem("palette:", action.id);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", action.help.c_str());
  const float textTop = start.y + 0.5f * (px(kRowHeight) - ImGui::GetTextLineHeight());
  if (!enabled) ImGui::PushStyleColor(ImGuiCol_Text, theme().colours.textDim);
  ImGui::SetCursorPos({start.x + px(8.0f), textTop});
  ImGui::TextUnformatted(action.icon);
  ImGui::SetCursorPos({start.x + px(34.0f), textTop});
  ImGui::TextUnformatted(action.text().c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", action.menu.c_str());
  if (!action.shortcuts.empty()) {
    const std::string keys = action.shortcuts.front().text();
    ImGui::SetCursorPos({width - ImGui::CalcTextSize(keys.c_str()).x - px(16.0f), textTop});
    ImGui::TextDisabled("%s", keys.c_str());
  }
  if (!enabled) ImGui::PopStyleColor();
  ImGui::SetCursorPos({start.x, start.y + px(kRowHeight)});
  return clicked && enabled ? &action : nullptr;
}

void CommandPalette::draw(const ActionTable& actions, int width, int height) {
  if (m_opening) {
    ImGui::OpenPopup(kPopup);
    m_query.clear();
    m_selected = 0;
  }
  ImGui::SetNextWindowPos({0.5f * static_cast<float>(width), 0.14f * static_cast<float>(height)}, ImGuiCond_Always,
                          {0.5f, 0.0f});
  ImGui::SetNextWindowSize({std::min(px(kWidth), static_cast<float>(width)), 0.0f});
  if (!ImGui::BeginPopup(kPopup)) {
    m_opening = false;
    return;
  }
  if (m_opening) ImGui::SetKeyboardFocusHere();
  m_opening = false;
  ImGui::SetNextItemWidth(-1.0f);
  if (ImGui::InputTextWithHint("##query", "Type a command", &m_query)) m_selected = 0;
  logItem("palette.query");
  const auto found = actions.search(m_query);
  const int last = static_cast<int>(found.size()) - 1;
  const int before = m_selected;
  if (pressed(ImGuiKey_DownArrow)) ++m_selected;
  if (pressed(ImGuiKey_UpArrow)) --m_selected;
  m_selected = std::clamp(m_selected, 0, std::max(last, 0));
  const Action* chosen = nullptr;
  const float rows = px(kRowHeight) * static_cast<float>(std::max<std::size_t>(found.size(), 1)) + px(6.0f);
  const float listHeight = std::min({rows, px(kListHeight), 0.6f * static_cast<float>(height)});
  ImGui::BeginChild("##found", {0.0f, listHeight});
  for (int i = 0; i <= last; ++i) {
    const Action* clicked = row(*found[static_cast<std::size_t>(i)], i == m_selected, ImGui::GetContentRegionAvail().x);
    if (clicked != nullptr) chosen = clicked;
    if (i == m_selected && before != m_selected) ImGui::SetScrollHereY();
  }
  if (found.empty()) ImGui::TextDisabled("No command is called so.");
  ImGui::EndChild();
  const bool enter = pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter);
  if (enter && last >= 0 && found[static_cast<std::size_t>(m_selected)]->isEnabled())
    chosen = found[static_cast<std::size_t>(m_selected)];
  if (chosen != nullptr || pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (chosen != nullptr) chosen->run();
}

}  // namespace sward::editor
