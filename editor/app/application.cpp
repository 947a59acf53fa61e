#include "app/application.h"

#include "document/edits.h"
#include "widgets/theme.h"

#include <algorithm>

#include <imgui.h>

namespace sward::editor {
namespace {

/// Notices fade and go by themselves.
constexpr double kToastSeconds = 0.1;

}  // namespace

Application::Application(ApplicationOptions options, LoadedPreferences loaded, const UiGl& gl,
                         std::function<void()> wake)
    : m_options(std::move(options)), m_preferences(std::move(loaded.preferences)), m_gl(gl), m_wake(std::move(wake)) {
  for (const std::string& message : loaded.messages) notice(message);
  const auto remembered = [&](const char* panel, float& size) {
    const auto found = m_preferences.panelSizes.find(panel);
    if (found != m_preferences.panelSizes.end()) size = static_cast<float>(found->second);
  };
  remembered("outliner", m_layout.left);
  remembered("inspector", m_layout.right);
  remembered("bottom", m_layout.bottom);
  if (!m_options.itemLog.empty()) setItemLog(&m_itemLog);
  LiveLink::Options live;
  live.cacheFolder = m_options.cacheFolder;
  live.cacheLimitBytes = m_preferences.cacheLimitBytes;
  live.threads = m_options.threads;
  live.device = device();
  live.wake = m_wake;
  m_live = std::make_unique<LiveLink>(gl, live);
  registerActions();
  setDialogActions();
  openAtStart();
  if (m_options.unattended) return;
  if (m_preferences.showHints) m_dialogs.openHints();
  RecoveryList recoverable = findRecoverable();
  if (!recoverable.usable.empty() || !recoverable.damaged.empty()) m_dialogs.offerRecovery(std::move(recoverable));
}

Application::~Application() {
  setItemLog(nullptr);
}

void Application::shutDown(bool interrupted) {
  // An interrupt asks nobody: what is unsaved stays for the next start.
  if (interrupted && m_document->modified()) {
    (void)m_autosave.write(*m_document);
  } else {
    m_autosave.clear();
  }
  m_preferences.panelSizes["outliner"] = m_layout.left;
  m_preferences.panelSizes["inspector"] = m_layout.right;
  m_preferences.panelSizes["bottom"] = m_layout.bottom;
  (void)savePreferences(m_preferences);
}

bool Application::poll(double seconds) {
  m_seconds = seconds;
  const bool changed = m_live->poll();
  autosave();
  watchFiles();
  return changed || m_dialogs.pictureRunning() || m_noticed;
}

std::optional<double> Application::nextWake() const {
  std::optional<double> wake = m_live->nextWake();
  const auto sooner = [&](double at) { wake = wake ? std::min(*wake, at) : at; };
  if (m_toasts.needFrames()) sooner(m_seconds + kToastSeconds);
  if (m_ui.playingDay || m_ui.season.running || m_viewport.flying()) sooner(m_seconds + 1.0 / 30.0);
  return wake;
}

void Application::playSeason(double seconds) {
  // A frame that was held up does not make the season jump.
  const double elapsed = std::clamp(seconds - m_lastFrame, 0.0, 0.1);
  m_lastFrame = seconds;
  if (!m_ui.season.running) return;
  advancePlay(m_ui.season, m_document->project(), elapsed);
  m_ui.lastMotion = seconds;
}

void Application::frame(double seconds, int width, int height) {
  playSeason(seconds);
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
  m_toasts.draw({0.0f, 0.0f}, {static_cast<float>(width), static_cast<float>(height) - px(30.0f)});
  m_live->update(*m_document, m_ui, m_viewport.width(), m_viewport.height(), seconds);
  writeItemLog(width, height);
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
  m_toasts.add(Severity::Info, text);
  m_noticed = true;
  if (m_wake) m_wake();
}

}  // namespace sward::editor
