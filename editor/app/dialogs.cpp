#include "app/dialogs.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/theme.h"

#include "project/project.h"

#include <algorithm>
#include <array>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace sward::editor {
namespace {

constexpr const char* kId = "###dialog";

constexpr std::array<const char*, 5> kHints{"Drag in the picture to turn, scroll to come nearer; W A S D walk.",
                                            "Choose a plant on the left and drag its height on the right.",
                                            "Hold L and drag in the picture: the sun moves, nothing is baked again.",
                                            "Open a curve at a plant's values, and bend a blade's outline below.",
                                            "Ctrl+P finds every command; Ctrl+Z takes everything back."};

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

}  // namespace

void Dialogs::open(Kind kind) {
  m_kind = kind;
  m_opening = true;
}

void Dialogs::close() {
  m_kind = Kind::None;
  ImGui::CloseCurrentPopup();
}

void Dialogs::askUnsaved(const std::string& name, std::function<void()> save, std::function<void()> drop) {
  m_name = name;
  m_yes = std::move(save);
  m_no = std::move(drop);
  open(Kind::Unsaved);
}

void Dialogs::askReload(const std::string& name, std::function<void()> reload) {
  m_name = name;
  m_yes = std::move(reload);
  open(Kind::Reload);
}

void Dialogs::offerRecovery(RecoveryList list) {
  m_recovery = std::move(list);
  open(Kind::Recovery);
}

void Dialogs::showMissing(std::vector<std::string> wheres, std::vector<std::string> files) {
  m_missingWhere = std::move(wheres);
  m_missingFile = std::move(files);
  open(Kind::Missing);
}

void Dialogs::showError(const std::string& title, const Error& error) {
  m_name = title;
  m_message = error.text();
  open(Kind::Error);
}

bool Dialogs::begin(const char* title, const Input& input, float width, float height) {
  const std::string name = std::string(title) + kId;
  if (m_opening) ImGui::OpenPopup(name.c_str());
  m_opening = false;
  const ImVec2 window{static_cast<float>(input.width), static_cast<float>(input.height)};
  ImGui::SetNextWindowPos({0.5f * window.x, 0.45f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
  const float high = height > 0.0f ? std::min(px(height), 0.9f * window.y) : 0.0f;
  ImGui::SetNextWindowSize({std::min(px(width), window.x), high});
  bool keep = true;
  const bool shown = ImGui::BeginPopupModal(
      name.c_str(), &keep, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  if (!shown && m_kind != Kind::None) m_kind = Kind::None;  // closed by its cross
  if (shown && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)) && !ImGui::IsAnyItemActive()) close();
  return shown;
}

bool Dialogs::button(const char* label, const char* id, bool primary) {
  const Palette& colours = theme().colours;
  if (primary) {
    ImGui::PushStyleColor(ImGuiCol_Button, colours.accent);
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, colours.accentStrong);
    ImGui::PushStyleColor(ImGuiCol_Text, colours.onAccent);
  }
  const bool pressed = ImGui::Button(label, {std::max(px(96.0f), ImGui::CalcTextSize(label).x + px(28.0f)), 0.0f});
  logItem("dialog:", id);
  if (primary) ImGui::PopStyleColor(3);
  return pressed;
}

void Dialogs::draw(const Input& input) {
  switch (m_kind) {
    case Kind::None:
      break;
    case Kind::Templates:
      drawTemplates(input);
      break;
    case Kind::Preferences:
      drawPreferences(input);
      break;
    case Kind::Shortcuts:
      drawShortcuts(input);
      break;
    case Kind::About:
      drawAbout(input);
      break;
    case Kind::Render:
      drawRender(input);
      break;
    case Kind::Unsaved:
      drawUnsaved(input);
      break;
    case Kind::Reload:
      drawReload(input);
      break;
    case Kind::Recovery:
      drawRecovery(input);
      break;
    case Kind::Missing:
      drawMissing(input);
      break;
    case Kind::Error:
      drawError(input);
      break;
  }
  drawHints(input);
}

void Dialogs::drawUnsaved(const Input& input) {
  if (!begin("Unsaved changes", input, 460.0f)) return;
  ImGui::TextWrapped("\"%s\" has changes that are not saved.", m_name.c_str());
  ImGui::Dummy({0.0f, px(10.0f)});
  const auto answer = [&](const std::function<void()>& act) {
    const std::function<void()> chosen = act;
    close();
    ImGui::EndPopup();
    if (chosen) chosen();
  };
  if (button("Save", "save", true)) return answer(m_yes);
  ImGui::SameLine();
  if (button("Don't save", "dontSave")) return answer(m_no);
  ImGui::SameLine();
  if (button("Cancel", "cancel")) close();
  ImGui::EndPopup();
}

void Dialogs::drawReload(const Input& input) {
  if (!begin("Changed on disk", input, 480.0f)) return;
  ImGui::TextWrapped(
      "\"%s\" was changed by another program, and you have unsaved changes. Loading it is a step that can be undone.",
      m_name.c_str());
  ImGui::Dummy({0.0f, px(10.0f)});
  if (button("Load the file", "reload", true)) {
    const auto reload = m_yes;
    close();
    ImGui::EndPopup();
    return reload();
  }
  ImGui::SameLine();
  if (button("Keep mine", "keep")) close();
  ImGui::EndPopup();
}

void Dialogs::drawError(const Input& input) {
  if (!begin(m_name.c_str(), input, 520.0f)) return;
  ImGui::TextWrapped("%s", m_message.c_str());
  ImGui::Dummy({0.0f, px(10.0f)});
  if (button("Close", "close", true)) close();
  ImGui::EndPopup();
}

void Dialogs::drawTemplates(const Input& input) {
  if (!begin("New project", input, 480.0f)) return;
  ImGui::TextDisabled("Start from");
  for (const project::TemplateInfo& entry : project::templates()) {
    const ImVec2 start = ImGui::GetCursorPos();
    const bool chosen = ImGui::Selectable(("##" + entry.name).c_str(), false, 0, {0.0f, px(46.0f)});
    logItem("template:", entry.name);
    ImGui::SetCursorPos({start.x + px(10.0f), start.y + px(5.0f)});
    {
      const FontScope font(theme().fonts.strong);
      ImGui::TextUnformatted(capitalised(entry.name).c_str());
    }
    ImGui::SetCursorPos({start.x + px(10.0f), start.y + px(24.0f)});
    ImGui::TextDisabled("%s", entry.description.c_str());
    ImGui::SetCursorPos({start.x, start.y + px(50.0f)});
    if (!chosen) continue;
    close();
    ImGui::EndPopup();
    return input.act.useTemplate(entry.name);
  }
  ImGui::Dummy({0.0f, px(6.0f)});
  if (button("Cancel", "cancel")) close();
  ImGui::EndPopup();
}

void Dialogs::drawShortcuts(const Input& input) {
  if (!begin("Keyboard and mouse", input, 560.0f, 560.0f)) return;
  constexpr std::array<std::pair<const char*, const char*>, 9> kMouse{{
      {"Turn about the target", "left drag"},
      {"Pan", "middle or Shift + left drag"},
      {"Come nearer, go away", "wheel"},
      {"Look around", "right drag, Alt + left drag"},
      {"Walk", "W A S D, with Shift faster"},
      {"Down, up", "Q, E"},
      {"Move the sun", "L + left drag"},
      {"Type a number", "double-click or Ctrl-click a field"},
      {"Reset a value", "right-click a field"},
  }};
  ImGui::BeginChild("##list", {0.0f, -px(44.0f)});
  if (ImGui::BeginTable("##keys", 2, ImGuiTableFlags_RowBg)) {
    const auto line = [](const std::string& what, const std::string& how) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(what.c_str());
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", how.c_str());
    };
    for (const auto& [what, how] : kMouse) line(what, how);
    for (const Action& action : input.actions.all()) {
      std::string texts;
      for (const Shortcut& shortcut : action.shortcuts) texts += (texts.empty() ? "" : ", ") + shortcut.text();
      if (!texts.empty()) line(action.label, texts);
    }
    ImGui::EndTable();
  }
  ImGui::EndChild();
  if (button("Close", "close", true)) close();
  ImGui::EndPopup();
}

void Dialogs::drawAbout(const Input& input) {
  if (!begin("About Sward", input, 460.0f)) return;
  {
    const FontScope font(theme().fonts.heading);
    ImGui::Text("Sward %s", input.version.c_str());
  }
  ImGui::TextWrapped("Grassland baked into layered polynomial textures and Wang tiles, drawn live and headless.");
  ImGui::Dummy({0.0f, px(6.0f)});
  ImGui::TextDisabled("Viewport");
  ImGui::TextWrapped("%s", input.viewRenderer.c_str());
  ImGui::TextDisabled("Window");
  ImGui::TextWrapped("OpenGL %s", input.uiRenderer.c_str());
  ImGui::TextDisabled("Interface");
  ImGui::TextWrapped("Dear ImGui %s", IMGUI_VERSION);
  ImGui::Dummy({0.0f, px(6.0f)});
  ImGui::TextDisabled("MIT licence");
  ImGui::Dummy({0.0f, px(6.0f)});
  if (button("Close", "close", true)) close();
  ImGui::EndPopup();
}

void Dialogs::drawMissing(const Input& input) {
  if (!begin("Missing files", input, 620.0f)) return;
  ImGui::TextWrapped(
      "The project opens, but these files are not where it says. Until they are found, what needs them "
      "cannot be baked.");
  for (std::size_t i = 0; i < m_missingFile.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::Separator();
    ImGui::TextWrapped("%s", m_missingFile[i].c_str());
    ImGui::TextDisabled("%s", m_missingWhere[i].c_str());
    ImGui::SameLine();
    const bool locate = ImGui::SmallButton("Locate...");
    logItem("missing:", m_missingWhere[i]);
    ImGui::PopID();
    if (!locate) continue;
    const std::string where = m_missingWhere[i];
    close();
    ImGui::EndPopup();
    return input.act.browse(where, "");
  }
  ImGui::Dummy({0.0f, px(10.0f)});
  if (button("Go on without", "close", true)) close();
  ImGui::EndPopup();
}

void Dialogs::drawHints(const Input& input) {
  if (!m_hints || m_kind != Kind::None) return;
  ImGui::SetNextWindowPos({0.5f * static_cast<float>(input.width), static_cast<float>(input.height) - px(300.0f)},
                          ImGuiCond_Appearing, {0.5f, 1.0f});
  ImGui::SetNextWindowSize({px(520.0f), 0.0f});
  const auto flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin("Five things to try", &m_hints, flags)) {
    for (std::size_t i = 0; i < kHints.size(); ++i) {
      ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme().colours.accent), "%zu", i + 1);
      ImGui::SameLine(px(34.0f));
      ImGui::TextWrapped("%s", kHints[i]);
    }
    ImGui::Dummy({0.0f, px(4.0f)});
    if (button("Got it", "hintsDone", true)) {
      m_hints = false;
      input.preferences.showHints = false;
      input.act.rememberPreferences();
    }
  }
  ImGui::End();
}

}  // namespace sward::editor
