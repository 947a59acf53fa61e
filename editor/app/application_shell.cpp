#include "app/application.h"

#include "base/file.h"
#include "panels/history_panel.h"
#include "panels/status_bar.h"
#include "panels/view_edits.h"
#include "widgets/icons.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include <algorithm>
#include <array>

#include <imgui.h>
#include <nlohmann/json.hpp>

namespace sward::editor {
namespace {

constexpr float kToolbarHeight = 40.0f, kStatusHeight = 26.0f, kSplitter = 5.0f;
constexpr float kLeastPanel = 140.0f, kLeastViewport = 120.0f;
constexpr std::array<const char*, 4> kMenus{"File", "Edit", "Plant", "View"};
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
constexpr ImGuiWindowFlags kScrolling = (kFixed & ~ImGuiWindowFlags_NoScrollbar);

constexpr const char* kReferenceHelp =
    "The plants themselves, ray-traced where the tiles put them, under the same sun and sky:\n"
    "what the baked ground stands for. It grows while the view is at rest.\n"
    "Macro variation is off on both sides. The noise is the reference's own, and part of the RMSE.";

struct Region {
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;
};

/// A window that fills a region; ImGui's End() must follow.
void beginRegion(const char* name, const Region& region, ImU32 background, ImVec2 padding, bool scrolls) {
  ImGui::SetNextWindowPos({region.x, region.y});
  ImGui::SetNextWindowSize({std::max(region.width, 1.0f), std::max(region.height, 1.0f)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  ImGui::Begin(name, nullptr, scrolls ? kScrolling : kFixed | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar(4);
  ImGui::PopStyleColor();
}

/// A handle along a region between two panels; the size of the panel that it belongs to, after a drag. Panels right of
/// and below the viewport grow against the mouse.
float splitter(const char* id, const Region& at, float size, float most, float usual) {
  beginRegion(id, at, theme().colours.backdrop, {0.0f, 0.0f}, false);
  ImGui::SetCursorScreenPos({at.x, at.y});
  const bool upright = at.height > at.width;
  const float least = std::min(px(kLeastPanel), most);
  if (std::string_view(id) == "splitter.left") {
    splitHandle(id, upright, std::max(at.width, at.height), size, least, most, px(usual));
  } else {
    float mirrored = -size;
    splitHandle(id, upright, std::max(at.width, at.height), mirrored, -most, -least, -px(usual));
    size = -mirrored;
  }
  ImGui::End();
  return size;
}

void menuItem(const Action& action) {
  if (action.separatorBefore) ImGui::Separator();
  const std::string keys = action.shortcuts.empty() ? "" : action.shortcuts.front().text();
  const std::string label = std::string(action.icon) + "  " + action.text();
  if (ImGui::MenuItem(label.c_str(), keys.c_str(), action.isChecked(), action.isEnabled())) action.run();
  logItem("menu:", action.id);
  if (ImGui::IsItemHovered() && !action.help.empty()) ImGui::SetTooltip("%s", action.help.c_str());
}

}  // namespace

PanelContext Application::context(double seconds) {
  std::vector<std::string> adds;
  for (const Action& action : m_actions.all())
    if (action.id.starts_with("plant.add.")) adds.push_back(action.id);
  return {*m_document, m_document->snapshot(), *this, m_ui, m_live->state(), seconds, theme().scale, std::move(adds)};
}

/// What one panel did is what the next one shows: a plant that was added may be selected already.
void Application::refresh(PanelContext& context) {
  context.project = m_document->snapshot();
  m_ui.selection = followSelection(m_ui.selection, *context.project);
}

void Application::drawMenuBar() {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(px(8.0f), px(6.0f)));
  const bool shown = ImGui::BeginMainMenuBar();
  ImGui::PopStyleVar();
  if (!shown) return;
  const auto menu = [&](const char* name) {
    const bool open = ImGui::BeginMenu(name);
    logItem("menu:", name);
    if (!open) return;
    for (const Action& action : m_actions.all()) {
      if (action.menu != name) continue;
      menuItem(action);
      if (action.id == "file.open") drawRecentMenu();
    }
    ImGui::EndMenu();
  };
  for (const char* name : kMenus) menu(name);
  menu("Help");
  ImGui::EndMainMenuBar();
}

void Application::drawRecentMenu() {
  if (!ImGui::BeginMenu("      Open recent", !m_preferences.recentFiles.empty())) return;
  std::optional<std::filesystem::path> chosen;
  for (const std::filesystem::path& file : m_preferences.recentFiles)
    if (ImGui::MenuItem(file.string().c_str())) chosen = file;
  ImGui::Separator();
  const bool clear = ImGui::MenuItem("Clear the list");
  ImGui::EndMenu();
  if (clear) m_preferences.recentFiles.clear();
  if (chosen) open(*chosen);
}

void Application::toolButton(const char* id) {
  const Action* action = m_actions.find(id);
  if (action == nullptr) return;
  const bool enabled = action->isEnabled(), checked = action->isChecked();
  ImGui::BeginDisabled(!enabled);
  if (checked) ImGui::PushStyleColor(ImGuiCol_Button, theme().colours.accentFill);
  const bool pressed = ImGui::Button((std::string(action->icon) + "##" + id).c_str(), {px(32.0f), px(28.0f)});
  if (checked) ImGui::PopStyleColor();
  ImGui::EndDisabled();
  logItem("action:", id);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    const std::string keys = action->shortcuts.empty() ? "" : "  (" + action->shortcuts.front().text() + ")";
    ImGui::SetTooltip("%s%s\n%s", action->text().c_str(), keys.c_str(), action->help.c_str());
  }
  ImGui::SameLine(0.0f, px(4.0f));
  if (pressed) action->run();
}

void Application::drawToolbar() {
  constexpr std::array<std::array<const char*, 4>, 4> kGroups{{{"file.new", "file.open", "file.save", nullptr},
                                                               {"edit.undo", "edit.redo", nullptr, nullptr},
                                                               {"view.frame", "view.sunTool", "view.compare", nullptr},
                                                               {"file.render", "edit.palette", nullptr, nullptr}}};
  ImGui::SetCursorPos({px(8.0f), px(6.0f)});
  for (const auto& group : kGroups) {
    for (const char* id : group)
      if (id != nullptr) toolButton(id);
    ImGui::Dummy({px(10.0f), 1.0f});
    ImGui::SameLine(0.0f, 0.0f);
  }
  drawCompareControls();
}

void Application::drawCompareControls() {
  CompareState& compare = m_ui.compare;
  if (!compare.on) return;
  constexpr std::array<std::pair<CompareState::Other, const char*>, 6> kOthers{{
      {CompareState::Other::March, "March"},
      {CompareState::Other::Blended, "Blended, normalised"},
      {CompareState::Other::BlendedPaper, "Blended, paper's weights"},
      {CompareState::Other::Ptm, "PTM fit"},
      {CompareState::Other::LptPaper, "LPT without ridge"},
      {CompareState::Other::Reference, "Reference (ray-traced)"},
  }};
  ImGui::SetCursorPosY(px(7.0f));
  ImGui::TextDisabled("against");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(px(180.0f));
  const bool texels = drawsTexels(m_document->project());
  const CompareState::Other shown = shownComparison(m_ui, m_document->project()).other;
  const auto now = std::find_if(kOthers.begin(), kOthers.end(), [&](const auto& o) { return o.first == shown; });
  if (ImGui::BeginCombo("##other", now->second)) {
    for (const auto& [other, label] : kOthers) {
      // The other ways are ways to draw layers.
      if (texels && other != CompareState::Other::Reference) continue;
      if (ImGui::Selectable(label, other == shown)) compare.other = other;
      logItem("compare:", label);
    }
    ImGui::EndCombo();
  }
  logItem("compare.other");
  if (shown == CompareState::Other::Reference && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", kReferenceHelp);
  ImGui::SameLine();
  bool difference = compare.show == Comparison::Show::Difference;
  if (ImGui::Checkbox("Difference", &difference))
    compare.show = difference ? Comparison::Show::Difference : Comparison::Show::Split;
  logItem("compare.difference");
  if (!difference) return;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(px(90.0f));
  auto gain = static_cast<float>(compare.gain);
  if (ImGui::SliderFloat("##gain", &gain, 1.0f, 32.0f, "times %.0f", ImGuiSliderFlags_Logarithmic)) compare.gain = gain;
}

void Application::drawPanels(PanelContext& context, int width, int height) {
  const Palette& colours = theme().colours;
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  const float menu = ImGui::GetFrameHeight() + px(4.0f);
  const float top = menu + px(kToolbarHeight), status = px(kStatusHeight), gap = px(kSplitter);
  const float room = std::max(h - top - status, 1.0f);
  const auto fit = [&](bool shown, double wanted, float most) {
    return shown ? std::clamp(px(static_cast<float>(wanted)), std::min(px(kLeastPanel), std::max(most, 0.0f)),
                              std::max(most, 1.0f))
                 : 0.0f;
  };
  Layout& layout = m_layout;
  const float left = fit(m_ui.showOutliner, layout.left, 0.3f * w);
  const float right = fit(m_ui.showInspector, layout.right, 0.4f * w);
  const float bottom = fit(m_ui.showBottom, layout.bottom, std::max(room - px(kLeastViewport), 1.0f) * 0.75f);
  const float gapLeft = m_ui.showOutliner ? gap : 0.0f, gapRight = m_ui.showInspector ? gap : 0.0f;
  const float gapBottom = m_ui.showBottom ? gap : 0.0f;
  const float middle = std::max(w - left - right - gapLeft - gapRight, 1.0f);

  beginRegion("##toolbar", {0.0f, menu, w, px(kToolbarHeight)}, colours.raised, {0.0f, 0.0f}, false);
  drawToolbar();
  ImGui::End();

  const float scale = theme().scale;
  if (m_ui.showOutliner)
    layout.left = splitter("splitter.left", {left, top, gap, room}, left, 0.3f * w, 250.0f) / scale;
  if (m_ui.showInspector)
    layout.right = splitter("splitter.right", {w - right - gap, top, gap, room}, right, 0.4f * w, 380.0f) / scale;
  const float bottomTop = top + room - bottom - gapBottom;
  if (m_ui.showBottom)
    layout.bottom =
        splitter("splitter.bottom", {left + gapLeft, bottomTop, middle, gap}, bottom, 0.75f * room, 250.0f) / scale;

  if (m_ui.showOutliner) {
    beginRegion("##outliner", {0.0f, top, left, room}, colours.panel, {0.0f, px(4.0f)}, true);
    refresh(context);
    m_outliner.draw(context);
    ImGui::End();
  }
  if (m_ui.showInspector) {
    beginRegion("##inspector", {w - right, top, right, room}, colours.panel, {px(12.0f), px(10.0f)}, false);
    refresh(context);
    m_inspector.draw(context);
    ImGui::End();
  }
  beginRegion("##viewport", {left + gapLeft, top, middle, std::max(room - bottom - gapBottom, 1.0f)}, colours.panel,
              {0.0f, 0.0f}, false);
  refresh(context);
  m_viewport.draw(context);
  ImGui::End();
  if (m_ui.showBottom) {
    beginRegion("##bottomPanel", {left + gapLeft, top + room - bottom, middle, bottom}, colours.panel,
                {px(10.0f), px(6.0f)}, false);
    refresh(context);
    drawBottom(context);
    ImGui::End();
  }
  beginRegion("##status", {0.0f, h - status, w, status}, colours.raised, {0.0f, 0.0f}, false);
  drawStatusBar(context, m_stalls.text());
  ImGui::End();
}

void Application::drawBottom(PanelContext& context) {
  constexpr std::array<std::pair<BottomTab, const char*>, 5> kTabs{{{BottomTab::Curves, "Curves"},
                                                                    {BottomTab::Season, "Season"},
                                                                    {BottomTab::Lights, "Light directions"},
                                                                    {BottomTab::Day, "Day"},
                                                                    {BottomTab::History, "History"}}};
  if (!ImGui::BeginTabBar("##tabs")) return;
  const BottomTab wanted = m_ui.bottomTab;
  const bool asked = wanted != m_shownTab;
  for (const auto& [tab, label] : kTabs) {
    // A tab that code asked for is selected once; after that the user's clicks say.
    const bool select = asked && wanted == tab;
    const bool shown = ImGui::BeginTabItem(label, nullptr, select ? ImGuiTabItemFlags_SetSelected : 0);
    logItem("tab:", label);
    if (!shown) continue;
    if (!asked || select) m_ui.bottomTab = m_shownTab = tab;
    drawTab(context, tab);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

void Application::drawTab(PanelContext& context, BottomTab tab) {
  switch (tab) {
    case BottomTab::Curves:
      m_curves.draw(context);
      break;
    case BottomTab::Season:
      m_season.draw(context);
      break;
    case BottomTab::Lights:
      m_lights.draw(context);
      break;
    case BottomTab::Day:
      m_day.draw(context);
      break;
    case BottomTab::History:
      ImGui::BeginChild("##history");
      drawHistory(context);
      ImGui::EndChild();
      break;
  }
}

void Application::writeItemLog(int width, int height) {
  if (m_options.itemLog.empty()) return;
  const LiveState& live = m_live->state();
  const int samples = live.reference && live.reference->picture ? live.reference->picture->samples : 0;
  nlohmann::ordered_json state{{"position", m_document->position()},
                               {"undo", m_document->undoName()},
                               {"modified", m_document->modified()},
                               {"file", m_document->file().string()},
                               {"autosaved", m_autosavedRevision == m_document->revision()},
                               {"baking", live.bake.running},
                               {"settled", m_live->settled()},
                               {"referenceSamples", samples},
                               {"viewError", live.viewError ? live.viewError->text() : ""},
                               {"bakeError", live.bake.error ? live.bake.error->text() : ""},
                               {"windowWidth", width},
                               {"windowHeight", height}};
  const std::string text = "{\"state\": " + state.dump() + ",\n" + m_itemLog.toJson().substr(1);
  if (text == m_itemLogText) return;
  // A reader sees either the last frame's items or this one's.
  if (base::writeFileAtomically(m_options.itemLog, text).ok()) m_itemLogText = text;
}

}  // namespace sward::editor
