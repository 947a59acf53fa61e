#include "app/application.h"

#include "document/edits.h"
#include "panels/camera_control.h"
#include "panels/view_edits.h"
#include "widgets/icons.h"

#include "project/presets.h"

#include <algorithm>

#include <imgui.h>

namespace sward::editor {
namespace {

std::vector<Shortcut> keys(std::initializer_list<const char*> texts) {
  std::vector<Shortcut> shortcuts;
  for (const char* text : texts) shortcuts.push_back(Shortcut::parse(text));
  return shortcuts;
}

}  // namespace

void Application::registerActions() {
  registerFileActions();
  registerEditActions();
  registerPlantActions();
  registerViewActions();
  registerHelpActions();
}

void Application::registerFileActions() {
  m_actions.add({.id = "file.new",
                 .menu = "File",
                 .label = "New...",
                 .help = "Start a project from a template",
                 .icon = icon::kNew,
                 .shortcuts = keys({"Ctrl+N"}),
                 .run = [this] { whenSaved([this] { m_dialogs.openTemplates(); }); }});
  m_actions.add({.id = "file.open",
                 .menu = "File",
                 .label = "Open...",
                 .help = "Open a .sward file",
                 .icon = icon::kFolder,
                 .shortcuts = keys({"Ctrl+O"}),
                 .run = [this] { chooseProject(); }});
  m_actions.add({.id = "file.save",
                 .menu = "File",
                 .label = "Save",
                 .help = "Write the project to its file",
                 .icon = icon::kSave,
                 .shortcuts = keys({"Ctrl+S"}),
                 .run = [this] { save(); },
                 .separatorBefore = true});
  m_actions.add({.id = "file.saveAs",
                 .menu = "File",
                 .label = "Save as...",
                 .help = "Write the project to another file and go on there",
                 .icon = icon::kSaveAs,
                 .shortcuts = keys({"Ctrl+Shift+S"}),
                 .run = [this] { saveAs(); }});
  m_actions.add({.id = "file.revert",
                 .menu = "File",
                 .label = "Revert",
                 .help = "Go back to what the file says; a step that can be undone",
                 .icon = icon::kReset,
                 .run = [this] { revert(); },
                 .enabled = [this] { return !m_document->file().empty(); }});
  m_actions.add({.id = "file.render",
                 .menu = "File",
                 .label = "Render picture...",
                 .help = "Draw a view at full quality to a PNG or EXR file",
                 .icon = icon::kImage,
                 .shortcuts = keys({"F12"}),
                 .run = [this] { m_dialogs.openRender(*m_document, m_ui); },
                 .separatorBefore = true});
  m_actions.add({.id = "file.quit",
                 .menu = "File",
                 .label = "Quit",
                 .help = "Close the editor",
                 .icon = icon::kPower,
                 .shortcuts = keys({"Ctrl+Q"}),
                 .run = [this] { closeRequested(); },
                 .separatorBefore = true});
}

void Application::registerEditActions() {
  m_actions.add(
      {.id = "edit.undo",
       .menu = "Edit",
       .label = "Undo",
       .help = "Take the last step back",
       .icon = icon::kUndo,
       .shortcuts = keys({"Ctrl+Z"}),
       .run =
           [this] {
             m_document->undo();
             afterHistory();
           },
       .enabled = [this] { return m_document->canUndo(); },
       .currentLabel =
           [this] { return m_document->canUndo() ? "Undo: " + m_document->undoName() : std::string("Undo"); }});
  m_actions.add(
      {.id = "edit.redo",
       .menu = "Edit",
       .label = "Redo",
       .help = "Do the step again that was taken back",
       .icon = icon::kRedo,
       .shortcuts = keys({"Ctrl+Shift+Z", "Ctrl+Y"}),
       .run =
           [this] {
             m_document->redo();
             afterHistory();
           },
       .enabled = [this] { return m_document->canRedo(); },
       .currentLabel =
           [this] { return m_document->canRedo() ? "Redo: " + m_document->redoName() : std::string("Redo"); }});
  m_actions.add({.id = "edit.palette",
                 .menu = "Edit",
                 .label = "Command palette...",
                 .help = "Find any command by its name",
                 .icon = icon::kSearch,
                 .shortcuts = keys({"Ctrl+P", "Ctrl+Shift+P"}),
                 .run = [this] { m_palette.open(); },
                 .separatorBefore = true});
  m_actions.add({.id = "edit.preferences",
                 .menu = "Edit",
                 .label = "Preferences...",
                 .help = "Scale, theme, cache, device, autosave",
                 .icon = icon::kSettings,
                 .shortcuts = keys({"Ctrl+,"}),
                 .run = [this] { m_dialogs.openPreferences(); }});
}

void Application::registerPlantActions() {
  for (const project::PlantPreset& preset : project::plantPresets()) {
    m_actions.add({.id = "plant.add." + preset.name,
                   .menu = "Plant",
                   .label = "Add " + preset.name,
                   .help = preset.description,
                   .icon = icon::kLeaf,
                   .run = [this, &preset] {
                     std::optional<std::size_t> added;
                     edit("add " + preset.name, [&](project::Project& p) { added = addPlant(p, preset.plant); }, {});
                     if (added) m_ui.selection = selectPlant(m_document->project(), *added);
                   }});
  }
  const auto plantChosen = [this] { return m_ui.selection.kind == Selection::Kind::Plant; };
  m_actions.add({.id = "plant.addFromFile",
                 .menu = "Plant",
                 .label = "Add from glTF file...",
                 .help = "Use a mesh of your own as a plant",
                 .icon = icon::kImport,
                 .shortcuts = keys({"Ctrl+I"}),
                 .run = [this] { choosePlantFile(); },
                 .separatorBefore = true});
  m_actions.add({.id = "plant.duplicate",
                 .menu = "Plant",
                 .label = "Duplicate",
                 .help = "A second plant like the chosen one",
                 .icon = icon::kDuplicate,
                 .shortcuts = keys({"Ctrl+D"}),
                 .run =
                     [this] {
                       const std::size_t i = m_ui.selection.index;
                       edit("duplicate plant", [i](project::Project& p) { duplicatePlant(p, i); }, {});
                       m_ui.selection = selectPlant(m_document->project(), i + 1);
                     },
                 .enabled = plantChosen,
                 .separatorBefore = true});
  m_actions.add({.id = "plant.remove",
                 .menu = "Plant",
                 .label = "Remove",
                 .help = "Take the chosen plant out of the patch",
                 .icon = icon::kDelete,
                 .shortcuts = keys({"Shift+Del"}),
                 .run =
                     [this] {
                       const std::size_t i = m_ui.selection.index;
                       edit("remove plant", [i](project::Project& p) { removePlant(p, i); }, {});
                     },
                 .enabled = plantChosen});
}

void Application::registerViewActions() {
  m_actions.add({.id = "view.frame",
                 .menu = "View",
                 .label = "Frame selection",
                 .help = "Move the camera so that the patch fills the picture",
                 .icon = icon::kFrameAll,
                 .shortcuts = keys({"F"}),
                 .run = [this] { frameSelection(); }});
  m_actions.add({.id = "view.top",
                 .menu = "View",
                 .label = "Look from above",
                 .help = "Straight down, north up",
                 .icon = icon::kCompass,
                 .shortcuts = keys({"7"}),
                 .run = [this] { lookFrom(StandardView::Top); }});
  m_actions.add({.id = "view.front",
                 .menu = "View",
                 .label = "Look from the south",
                 .help = "Near the ground, to the north",
                 .icon = icon::kCamera,
                 .shortcuts = keys({"1"}),
                 .run = [this] { lookFrom(StandardView::Front); }});
  m_actions.add({.id = "view.side",
                 .menu = "View",
                 .label = "Look from the east",
                 .help = "Near the ground, to the west",
                 .icon = icon::kCamera,
                 .shortcuts = keys({"3"}),
                 .run = [this] { lookFrom(StandardView::Side); }});
  m_actions.add({.id = "view.next",
                 .menu = "View",
                 .label = "Next saved view",
                 .help = "Put the camera where the next view is",
                 .icon = icon::kNext,
                 .shortcuts = keys({"N"}),
                 .run = [this] { nextView(); },
                 .enabled = [this] { return !m_document->project().views.empty(); }});
  m_actions.add({.id = "view.save",
                 .menu = "View",
                 .label = "Save camera as view",
                 .help = "Keep the camera's place in the project, for renders by name",
                 .icon = icon::kAdd,
                 .shortcuts = keys({"Ctrl+B"}),
                 .run = [this] { saveView(); },
                 .separatorBefore = true});
  m_actions.add({.id = "view.update",
                 .menu = "View",
                 .label = "Update the chosen view",
                 .help = "Move the chosen view of the project to where the camera is",
                 .icon = icon::kTarget,
                 .run = [this] { updateView(); },
                 .enabled = [this] { return m_ui.selection.kind == Selection::Kind::View; }});
  m_actions.add({.id = "view.remove",
                 .menu = "View",
                 .label = "Remove the chosen view",
                 .help = "Take the chosen view out of the project",
                 .icon = icon::kDelete,
                 .run = [this] { removeView(); },
                 .enabled = [this] { return m_ui.selection.kind == Selection::Kind::View; }});
  m_actions.add({.id = "view.compare",
                 .menu = "View",
                 .label = "Compare two methods",
                 .help = "Split the picture: your method left, another right",
                 .icon = icon::kCompare,
                 .shortcuts = keys({"C"}),
                 .run = [this] { m_ui.compare.on = !m_ui.compare.on; },
                 .checked = [this] { return m_ui.compare.on; },
                 .separatorBefore = true});
  m_actions.add(
      {.id = "view.sunTool",
       .menu = "View",
       .label = "Drag the sun",
       .help = "A left drag in the picture moves the sun (or hold L)",
       .icon = icon::kSun,
       .shortcuts = keys({"U"}),
       .run = [this] { m_ui.tool = m_ui.tool == ViewportTool::Sun ? ViewportTool::Orbit : ViewportTool::Sun; },
       .checked = [this] { return m_ui.tool == ViewportTool::Sun; }});
  m_actions.add({.id = "season.play",
                 .menu = "View",
                 .label = "Play the season",
                 .help = "Show the sward wither; the project stays as it is",
                 .icon = icon::kPlay,
                 .shortcuts = keys({"Space"}),
                 .run =
                     [this] {
                       togglePlay(m_ui, m_document->project());
                       m_ui.bottomTab = BottomTab::Season;
                       m_ui.showBottom = true;
                     },
                 .checked = [this] { return m_ui.season.running; },
                 .separatorBefore = true});
  m_actions.add({.id = "season.stop",
                 .menu = "View",
                 .label = "Back to the project's weathering",
                 .help = "Show the weathering degree that the project has",
                 .icon = icon::kStop,
                 .run =
                     [this] {
                       m_ui.season.running = false;
                       m_ui.season.at.reset();
                     },
                 .enabled = [this] { return m_ui.season.at.has_value(); }});
  const auto toggle = [this](const char* id, const char* label, const char* shortcut, bool UiState::*shown,
                             bool first) {
    m_actions.add({.id = id,
                   .menu = "View",
                   .label = label,
                   .help = std::string("Show or hide the ") + label,
                   .icon = icon::kViewList,
                   .shortcuts = keys({shortcut}),
                   .run = [this, shown] { m_ui.*shown = !(m_ui.*shown); },
                   .checked = [this, shown] { return m_ui.*shown; },
                   .separatorBefore = first});
  };
  toggle("view.outliner", "Outliner", "F2", &UiState::showOutliner, true);
  toggle("view.inspector", "Inspector", "F3", &UiState::showInspector, false);
  toggle("view.bottom", "Curves and timeline", "F4", &UiState::showBottom, false);
  m_actions.add({.id = "bake.cancel",
                 .menu = "View",
                 .label = "Stop baking",
                 .help = "Cancel the running bake; the next edit starts again",
                 .icon = icon::kStop,
                 .run = [this] { m_live->cancelBake(); },
                 .enabled = [this] { return m_live->state().bake.running; },
                 .separatorBefore = true});
}

void Application::registerHelpActions() {
  m_actions.add({.id = "help.hints",
                 .menu = "Help",
                 .label = "First steps",
                 .help = "Five things to try",
                 .icon = icon::kHelp,
                 .run = [this] { m_dialogs.openHints(); }});
  m_actions.add({.id = "help.shortcuts",
                 .menu = "Help",
                 .label = "Keyboard and mouse",
                 .help = "All shortcuts",
                 .icon = icon::kKeyboard,
                 .shortcuts = keys({"F1"}),
                 .run = [this] { m_dialogs.openShortcuts(); }});
  m_actions.add({.id = "help.docs",
                 .menu = "Help",
                 .label = "Open the documentation",
                 .help = "README and the reference of the project's format",
                 .icon = icon::kFile,
                 .run = [this] { openDocumentation(); }});
  m_actions.add({.id = "help.about",
                 .menu = "Help",
                 .label = "About Sward",
                 .help = "Version, libraries, renderer",
                 .icon = icon::kInfo,
                 .run = [this] { m_dialogs.openAbout(); },
                 .separatorBefore = true});
}

void Application::handleShortcuts() {
  const std::vector<Shortcut> keys = std::exchange(m_keys, {});
  const bool popup = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  if (popup || m_fileDialog.isOpen()) return;
  for (const Shortcut& key : keys) {
    const Action* action = m_actions.forShortcut(key, ImGui::GetIO().WantTextInput);
    if (action != nullptr && action->isEnabled()) action->run();
  }
}

void Application::afterHistory() {
  m_ui.selection = followSelection(m_ui.selection, m_document->project());
  if (m_ui.boundView && *m_ui.boundView >= m_document->project().views.size()) m_ui.boundView.reset();
}

void Application::frameSelection() {
  const project::Project& project = m_document->project();
  const double height = m_live->state().ground ? m_live->state().ground->heightM : 0.3;
  editor::frame(m_ui.camera, {0.0, 0.0, 0.5 * height}, 0.6 * project.patch.sideM, m_viewport.aspect());
  cameraMoved();
}

void Application::lookFrom(StandardView from) {
  look(m_ui.camera, from, std::max(glm::length(m_ui.camera.position - m_ui.camera.target), 1.0));
  cameraMoved();
}

void Application::cameraMoved() {
  m_ui.boundView.reset();
  m_ui.lastMotion = m_seconds;
}

void Application::nextView() {
  const auto& views = m_document->project().views;
  const std::size_t next = m_ui.boundView ? (*m_ui.boundView + 1) % views.size() : 0;
  m_ui.camera = views[next];
  m_ui.boundView = next;
  m_ui.lastMotion = m_seconds;
}

void Application::saveView() {
  std::optional<std::size_t> added;
  edit("add view", [&](project::Project& p) { added = addView(p, m_ui.camera); }, {});
  if (!added) return;
  m_ui.selection = selectView(m_document->project(), *added);
  m_ui.boundView = added;
}

void Application::updateView() {
  const std::size_t index = m_ui.selection.index;
  edit("move view", [&](project::Project& p) { editor::updateView(p, index, m_ui.camera); }, {});
  m_ui.boundView = index;
}

void Application::removeView() {
  const std::size_t index = m_ui.selection.index;
  edit("remove view", [index](project::Project& p) { editor::removeView(p, index); }, {});
  m_ui.boundView.reset();
}

}  // namespace sward::editor
