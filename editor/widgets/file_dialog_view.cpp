#include "widgets/file_dialog.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/text.h"
#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

/// How the file dialog looks and answers.
namespace sward::editor {
namespace {

namespace fs = std::filesystem;

bool keyHit(ImGuiKey key, bool repeat = false) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
}

/// A flat entry of the crumbs or the places.
bool flatEntry(const char* id, const std::string& text, float width, bool chosen) {
  const Palette& c = theme().colours;
  const bool pressed = ImGui::InvisibleButton(id, ImVec2(width, ImGui::GetFrameHeight()));
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const bool hot = ImGui::IsItemHovered();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  if (chosen || hot) draw->AddRectFilled(min, max, chosen ? c.accentFill : c.fieldHover, rounding);
  ImGui::RenderNavHighlight(ImRect(min, max), ImGui::GetItemID());
  textEllipsis(ImVec2(min.x + px(7), min.y + ImGui::GetStyle().FramePadding.y), max.x - px(4),
               chosen || hot ? c.text : mixed(c.textDim, c.text, 0.6f), text);
  return pressed;
}

const char* iconOf(const FolderEntry& entry) {
  if (entry.folder) return icon::kFolder;
  const std::string end = fs::path(entry.name).extension().string();
  if (end == ".sward") return icon::kLeaf;
  if (end == ".glb" || end == ".gltf") return icon::kModel;
  for (const char* picture : {".png", ".jpg", ".jpeg", ".exr", ".hdr", ".tif", ".tiff"}) {
    if (end == picture) return icon::kImage;
  }
  return icon::kFile;
}

}  // namespace

void FileDialog::crumbs() {
  const float room = ImGui::GetContentRegionAvail().x - 4.0f * (ImGui::GetFrameHeight() + px(8));
  if (m_typingPath) {
    ImGui::SetNextItemWidth(room);
    if (m_focusPath) ImGui::SetKeyboardFocusHere();
    m_focusPath = false;
    ImGui::InputText("##path", &m_path);
    logItem("action:", "files.path");
    return;
  }
  std::vector<fs::path> parts;
  for (fs::path at = m_folder;; at = at.parent_path()) {
    parts.push_back(at);
    if (!at.has_parent_path() || at == at.parent_path()) break;
  }
  std::reverse(parts.begin(), parts.end());
  const auto nameOf = [](const fs::path& part) {
    return part.has_filename() ? part.filename().string() : std::string(icon::kDisk) + "  /";
  };
  const auto widthOf = [&](const fs::path& part) { return ImGui::CalcTextSize(nameOf(part).c_str()).x + px(15); };
  // From the right: what has no room is left out at the left.
  std::size_t first = parts.size() - 1;
  for (float used = widthOf(parts[first]); first > 0; --first) {
    used += widthOf(parts[first - 1]) + px(14);
    if (used > room) break;
  }
  const ImVec2 start = ImGui::GetCursorScreenPos();
  for (std::size_t i = first; i < parts.size(); ++i) {
    if (i > first) {
      ImGui::SameLine(0.0f, px(1));
      ImGui::AlignTextToFramePadding();
      ImGui::TextDisabled("%s", icon::kChevronRight);
      ImGui::SameLine(0.0f, px(1));
    }
    ImGui::PushID(static_cast<int>(i));
    const float left = start.x + room - ImGui::GetCursorScreenPos().x;
    const bool pressed =
        flatEntry("crumb", nameOf(parts[i]), std::max(px(24), std::min(widthOf(parts[i]), left)), false);
    logItem("crumb:", std::to_string(i));
    ImGui::PopID();
    if (pressed && i + 1 < parts.size()) {
      enter(parts[i]);
      break;
    }
  }
}

void FileDialog::toolButtons() {
  const float width = 4.0f * (ImGui::GetFrameHeight() + px(6));
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - width + px(2));
  if (iconButton("files.up", icon::kFolderUp, "Up", "Backspace")) goUp();
  ImGui::SameLine(0.0f, px(2));
  if (toolToggle("files.type", icon::kRename, m_typingPath, "Type a path", "Ctrl+L")) {
    m_typingPath = !m_typingPath;
    m_focusPath = m_typingPath;
    m_path = (m_folder / "").string();
  }
  ImGui::SameLine(0.0f, px(2));
  if (toolToggle("files.hidden", m_hidden ? icon::kEye : icon::kEyeOff, m_hidden, "Hidden files", "Ctrl+H")) {
    m_hidden = !m_hidden;
    refresh();
  }
  ImGui::SameLine(0.0f, px(2));
  if (iconButton("files.new folder", icon::kFolderNew, "New folder")) {
    m_ask = Ask::NewFolder;
    m_askAppearing = true;
    m_newName = "New folder";
  }
}

void FileDialog::places(float height) {
  const float width = std::min(px(170), ImGui::GetContentRegionAvail().x * 0.3f);
  ImGui::BeginChild("places", ImVec2(width, height), false, ImGuiWindowFlags_NoNavInputs);
  const auto place = [&](const char* icon, const std::string& label, const fs::path& folder) {
    if (flatEntry(label.c_str(), std::string(icon) + "   " + label, ImGui::GetContentRegionAvail().x,
                  folder == m_folder)) {
      enter(folder);
    }
    logItem("place:", label);
    hoverText(folder.string().c_str());
  };
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, px(2)));
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') place(icon::kHome, "Home", home);
  place(icon::kDisk, "File system", "/");
  if (!m_options.places.empty()) ImGui::Dummy(ImVec2(0, px(6)));
  for (const auto& [label, folder] : m_options.places) place(icon::kFolder, label, folder);
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

void FileDialog::row(std::size_t index, std::optional<fs::path>& chosen) {
  const Palette& c = theme().colours;
  const FolderEntry& entry = m_entries[index];
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(static_cast<int>(index));
  const bool selected = m_selected == index;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  constexpr auto kFlags = ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick;
  const bool clicked = ImGui::Selectable("##row", selected, kFlags, ImVec2(0, ImGui::GetTextLineHeight() + px(3)));
  logItem("file:", entry.name);
  ImGui::PopID();
  if (selected && m_scrollToSelected) ImGui::SetScrollHereY(0.5f);
  const float right = at.x + ImGui::GetColumnWidth();
  const float y = at.y + px(1);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddText(ImVec2(at.x + px(2), y), entry.folder ? c.accent : c.textDim, iconOf(entry));
  textEllipsis(ImVec2(at.x + px(26), y), right - px(4), c.text, entry.name);
  if (!m_narrow) {
    const auto cell = [&](const std::string& text) {
      ImGui::TableNextColumn();
      draw->AddText(ImVec2(ImGui::GetCursorScreenPos().x, y), c.textDim, text.c_str());
    };
    cell(timeText(entry.modifiedS));
    cell(entry.folder ? "" : fileSizeText(entry.bytes));
  }
  if (!clicked) return;
  const bool twice = ImGui::IsMouseDoubleClicked(0);
  pick(index);
  m_scrollToSelected = false;
  if (twice) chosen = activate(index);
}

std::optional<fs::path> FileDialog::list(float height) {
  std::optional<fs::path> chosen;
  ImGui::PushStyleColor(ImGuiCol_ChildBg, theme().colours.plot);
  // The arrows step through the files; ImGui's own walk would take them.
  ImGui::BeginChild("list", ImVec2(0, height), true, ImGuiWindowFlags_NoNavInputs);
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_BordersInnerH |
                                     ImGuiTableFlags_PadOuterX;
  m_narrow = ImGui::GetWindowWidth() < px(380);
  if (ImGui::BeginTable(m_narrow ? "names" : "files", m_narrow ? 1 : 3, kFlags)) {
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Name", ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_DefaultSort);
    constexpr auto kFixed = ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_PreferSortDescending;
    if (!m_narrow) ImGui::TableSetupColumn("Modified", kFixed, px(128));
    if (!m_narrow) ImGui::TableSetupColumn("Size", kFixed, px(66));
    ImGui::TableHeadersRow();
    if (ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs != nullptr && specs->SpecsDirty) {
      const bool any = specs->SpecsCount > 0;
      m_sort = any ? static_cast<FolderSort>(specs->Specs[0].ColumnIndex) : FolderSort::Name;
      m_descending = any && specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
      specs->SpecsDirty = false;
      refresh();
    }
    // A copy of the count: activating a folder changes the list.
    for (std::size_t i = 0; i < m_entries.size() && !chosen; ++i) {
      const fs::path before = m_folder;
      row(i, chosen);
      if (m_folder != before) break;
    }
    m_scrollToSelected = false;
    ImGui::EndTable();
  }
  if (m_entries.empty()) {
    const char* text = m_error.empty() ? "Nothing here that could be chosen" : "This folder cannot be read";
    const ImVec2 size = ImGui::CalcTextSize(text), pane = ImGui::GetWindowSize(), at = ImGui::GetWindowPos();
    ImGui::GetWindowDrawList()->AddText(ImVec2(at.x + 0.5f * (pane.x - size.x), at.y + 0.5f * pane.y),
                                        theme().colours.textDim, text);
  }
  ImGui::EndChild();
  ImGui::PopStyleColor();
  return chosen;
}

std::optional<fs::path> FileDialog::footer() {
  std::optional<fs::path> chosen;
  const bool saves = m_options.mode == FileDialogMode::Save;
  if (saves) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Name");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (m_appearing) ImGui::SetKeyboardFocusHere();
    const bool entered =
        ImGui::InputText("##name", &m_name, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    logItem("action:", "files.name");
    if (entered) chosen = accept();
  }
  ImGui::PushStyleColor(ImGuiCol_Text, theme().colours.error);
  ImGui::PushTextWrapPos(0.0f);
  if (!m_error.empty()) ImGui::TextUnformatted(m_error.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  if (m_options.mode != FileDialogMode::Folder) {
    ImGui::SetNextItemWidth(std::min(px(220), ImGui::GetContentRegionAvail().x * 0.45f));
    if (ImGui::BeginCombo("##filter", filter().name.c_str())) {
      for (std::size_t i = 0; i < m_options.filters.size(); ++i) {
        if (ImGui::Selectable(m_options.filters[i].name.c_str(), i == m_filter)) {
          m_filter = i;
          refresh();
        }
        logItem("filter:", m_options.filters[i].name);
      }
      ImGui::EndCombo();
    } else {
      logItem("action:", "files.filter");
    }
    ImGui::SameLine();
  }
  const char* verb = saves ? "Save" : m_options.mode == FileDialogMode::Folder ? "Choose" : "Open";
  const std::string text = m_options.accept.empty() ? verb : m_options.accept;
  const float each = px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * each - ImGui::GetStyle().ItemSpacing.x);
  if (plainButton("files.cancel", "Cancel", true, each)) close();
  ImGui::SameLine();
  const bool can = saves ? !m_name.empty() : !target().empty();
  if (primaryButton("files.accept", text.c_str(), can, each)) chosen = accept();
  return chosen;
}

std::optional<fs::path> FileDialog::question() {
  if (m_ask == Ask::None) return std::nullopt;
  const bool creates = m_ask == Ask::NewFolder;
  const char* title = creates ? "New folder###ask" : "Replace the file?###ask";
  if (m_askAppearing) ImGui::OpenPopup("###ask");
  std::optional<fs::path> chosen;
  bool stays = true;
  if (!ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    m_ask = Ask::None;
    return chosen;
  }
  bool done = false;
  if (creates) {
    if (m_askAppearing) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(px(300));
    done =
        ImGui::InputText("##new", &m_newName, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    logItem("action:", "files.new name");
    if (!m_error.empty())
      ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(theme().colours.error), "%s", m_error.c_str());
  } else {
    ImGui::PushTextWrapPos(px(340));
    ImGui::Text("\"%s\" exists already. Replacing it loses what it holds.", target().filename().string().c_str());
    ImGui::PopTextWrapPos();
  }
  m_askAppearing = false;
  ImGui::Dummy(ImVec2(px(300), px(4)));
  const float each = px(96);
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - 2 * each - ImGui::GetStyle().ItemSpacing.x);
  if (plainButton("files.no", "Cancel", true, each) || keyHit(ImGuiKey_Escape)) stays = false;
  ImGui::SameLine();
  done |= primaryButton("files.yes", creates ? "Create" : "Replace", true, each);
  if (done && creates && createFolder()) stays = false;
  if (done && !creates) {
    chosen = accept();
    stays = false;
  }
  if (!stays) {
    ImGui::CloseCurrentPopup();
    m_ask = Ask::None;
  }
  ImGui::EndPopup();
  return chosen;
}

std::optional<fs::path> FileDialog::keys() {
  ImGuiIO& io = ImGui::GetIO();
  if (m_ask != Ask::None) return std::nullopt;
  if (m_typingPath && keyHit(ImGuiKey_Enter)) return acceptTyped();
  if (keyHit(ImGuiKey_Escape)) {
    if (!m_typingPath) close();
    m_typingPath = false;
    return std::nullopt;
  }
  // Letters beyond ImGui's own few come as the window's codes, which are ASCII's in GLFW.
  if (io.KeyCtrl && ImGui::IsKeyPressed('H', false)) {
    m_hidden = !m_hidden;
    refresh();
  }
  if (io.KeyCtrl && ImGui::IsKeyPressed('L', false)) {
    m_typingPath = m_focusPath = true;
    m_path = (m_folder / "").string();
  }
  if (io.WantTextInput || m_typingPath) return std::nullopt;
  if (keyHit(ImGuiKey_Backspace)) goUp();
  if (keyHit(ImGuiKey_DownArrow, true)) step(1);
  if (keyHit(ImGuiKey_UpArrow, true)) step(-1);
  if (keyHit(ImGuiKey_PageDown, true)) step(10);
  if (keyHit(ImGuiKey_PageUp, true)) step(-10);
  if (keyHit(ImGuiKey_Home)) step(-1000000);
  if (keyHit(ImGuiKey_End)) step(1000000);
  if (keyHit(ImGuiKey_Enter) || keyHit(ImGuiKey_KeyPadEnter)) {
    return m_selected ? activate(*m_selected) : accept();
  }
  constexpr double kTogetherS = 1.0;
  for (const ImWchar c : io.InputQueueCharacters) {
    if (c < 32 || io.KeyCtrl) continue;
    if (ImGui::GetTime() - m_typedAt > kTogetherS) m_typed.clear();
    m_typedAt = ImGui::GetTime();
    std::array<char, 5> bytes{};
    m_typed += ImTextCharToUtf8(bytes.data(), c);
    // A longer text may still mean the entry that stands selected.
    const std::size_t from = m_selected.value_or(0) + (m_typed.size() == 1 && m_selected ? 1 : 0);
    if (const auto found = findTyped(m_entries, m_typed, from)) pick(*found);
  }
  return std::nullopt;
}

std::optional<fs::path> FileDialog::draw() {
  if (!m_open) return std::nullopt;
  const std::string title = m_options.title + "###file dialog";
  if (m_appearing) ImGui::OpenPopup("###file dialog");
  const ImVec2 screen = ImGui::GetMainViewport()->WorkSize, origin = ImGui::GetMainViewport()->WorkPos;
  const ImVec2 most(screen.x - px(16), screen.y - px(16));
  ImGui::SetNextWindowSize(ImVec2(std::min(px(780), most.x), std::min(px(520), most.y)), ImGuiCond_Appearing);
  ImGui::SetNextWindowPos(ImVec2(origin.x + 0.5f * screen.x, origin.y + 0.5f * screen.y), ImGuiCond_Appearing,
                          ImVec2(0.5f, 0.5f));
  bool stays = true;
  std::optional<fs::path> chosen;
  if (!ImGui::BeginPopupModal(title.c_str(), &stays, ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNavInputs)) {
    m_open = false;
    return chosen;
  }
  crumbs();
  toolButtons();
  ImGui::Dummy(ImVec2(0, px(2)));
  const float line = ImGui::GetFrameHeightWithSpacing();
  float below = line + px(6) + (m_options.mode == FileDialogMode::Save ? line : 0.0f);
  if (!m_error.empty()) {
    below += ImGui::CalcTextSize(m_error.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y + px(8);
  }
  const float height = std::max(px(60), ImGui::GetContentRegionAvail().y - below);
  places(height);
  ImGui::SameLine();
  const auto take = [&chosen](std::optional<fs::path> path) {
    if (path && !chosen) chosen = std::move(path);
  };
  take(list(height));
  if (m_open) take(footer());
  if (m_open) take(keys());
  if (m_open) take(question());
  m_appearing = false;
  if (!stays) close();
  if (!m_open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return chosen;
}

}  // namespace sward::editor
