#include "app/application.h"

#include "document/edits.h"
#include "widgets/theme.h"

#include <algorithm>

#include <imgui.h>

namespace sward::editor {

Application::Application(ApplicationOptions options, PreferencesLoad loaded, const UiGl& gl, std::function<void()> wake)
    : m_options(std::move(options)),
      m_preferences(std::move(loaded.preferences)),
      m_gl(gl),
      m_wake(std::move(wake)),
      m_autosave(std::make_unique<Autosave>(m_preferences.autosaveSeconds)),
      m_watch(std::make_unique<FileWatch>()) {
  if (!loaded.message.empty()) notice(loaded.message);
  m_layout.left = m_preferences.layoutOr("left", m_layout.left);
  m_layout.right = m_preferences.layoutOr("right", m_layout.right);
  m_layout.bottom = m_preferences.layoutOr("bottom", m_layout.bottom);
  if (!m_options.itemLog.empty()) setItemLog(&m_itemLog);
  LiveLink::Options live;
  live.cacheFolder = m_options.cacheFolder;
  live.cacheLimitBytes = m_preferences.cacheLimitBytes;
  live.threads = m_options.threads;
  live.device = m_options.device.value_or(m_preferences.deviceOrAuto());
  live.wake = m_wake;
  m_live = std::make_unique<LiveLink>(gl, live);
  registerActions();
  setDialogActions();
  openAtStart();
  if (m_preferences.showHints) m_dialogs.openHints();
  auto recoverable = findRecoverable();
  if (!recoverable.empty()) m_dialogs.offerRecovery(std::move(recoverable));
}

Application::~Application() {
  setItemLog(nullptr);
}

void Application::shutDown(bool interrupted) {
  // An interrupt asks nobody: what is unsaved stays for the next start.
  if (interrupted && m_document->modified()) {
    m_autosave->writeNow(*m_document);
    m_autosave->keep();
  } else {
    m_autosave->discard();
  }
  m_preferences.layout["left"] = m_layout.left;
  m_preferences.layout["right"] = m_layout.right;
  m_preferences.layout["bottom"] = m_layout.bottom;
  (void)savePreferences(m_preferences);
}

bool Application::poll(double seconds) {
  m_seconds = seconds;
  const bool changed = m_live->poll();
  m_autosave->tick(*m_document, seconds);
  watchFiles();
  return changed || m_dialogs.pictureRunning() || m_noticed;
}

std::optional<double> Application::nextWake() const {
  std::optional<double> wake = m_live->nextWake();
  const auto sooner = [&](double at) { wake = wake ? std::min(*wake, at) : at; };
  if (const auto toast = m_toasts.nextWake()) sooner(*toast);
  if (m_ui.playingDay || m_viewport.flying()) sooner(m_seconds + 1.0 / 30.0);
  return wake;
}

void Application::frame(double seconds, int width, int height) {
  m_seconds = seconds;
  m_noticed = false;
  m_itemLog.beginFrame();
  m_ui.selection = followSelection(m_ui.selection, m_document->project());
  m_ui.inputActive = false;
  handleShortcuts();
  drawMenuBar();
  PanelContext panels = context(seconds);
  drawPanels(panels, width, height);
  drawDialogs(width, height);
  m_palette.draw(m_actions, width, height);
  m_toasts.draw(width, height, seconds);
  m_live->update(*m_document, m_ui, m_viewport.width(), m_viewport.height(), seconds);
  logState();
  writeItemLog();
}

void Application::frameShown(double milliseconds) {
  m_stalls.add(milliseconds, m_live->state().bake.running);
}

std::string Application::title() const {
  const std::string name = m_document->file().empty() ? "Untitled" : m_document->file().filename().string();
  return (m_document->modified() ? "* " : "") + name + " - Sward";
}

void Application::edit(const std::string& name, const std::function<void(project::Project&)>& change,
                       const std::string& mergeKey) {
  m_document->edit(name, change, mergeKey);
}

void Application::closeStep() {
  m_document->closeStep();
}

void Application::run(const std::string& action) {
  m_actions.run(action);
}

void Application::notice(const std::string& text) {
  m_toasts.add(text, m_seconds);
  m_noticed = true;
  if (m_wake) m_wake();
}

}  // namespace sward::editor
