#include "app/application.h"

#include "document/document_io.h"
#include "document/edits.h"
#include "widgets/theme.h"

#include <array>
#include <cstdlib>

#include <imgui.h>
#include <imgui_impl_opengl3.h>

namespace sward::editor {

gpu::Device Application::device() const {
  if (m_options.device) return *m_options.device;
  const auto preferred = gpu::deviceFromName(m_preferences.device.empty() ? "auto" : m_preferences.device);
  return preferred.ok() ? *preferred : gpu::Device::Auto;
}

void Application::setDialogActions() {
  m_dialogActions.useTemplate = [this](const std::string& name) { startFromTemplate(name); };
  m_dialogActions.recover = [this](const std::filesystem::path& autosave) { recoverFrom(autosave); };
  m_dialogActions.preferencesChanged = [this] { m_styleChanged = true; };
  m_dialogActions.rememberPreferences = [this] {
    if (const auto saved = savePreferences(m_preferences); !saved.ok()) notice(saved.error().text());
  };
  m_dialogActions.chooseOutput = [this](std::function<void(const std::filesystem::path&)> then) { chooseOutput(then); };
  m_dialogActions.browse = [this](const std::string& where, const std::string& files) { browse(where, files); };
  m_dialogActions.notice = [this](const std::string& text) { notice(text); };
  m_dialogActions.wake = m_wake;
}

void Application::drawDialogs(int width, int height) {
  const LiveState& live = m_live->state();
  const std::string viewRenderer =
      live.device ? live.device->api + ", " + live.device->renderer + ", OpenGL " + live.device->version
                  : std::string("none yet");
  m_dialogs.draw({*m_document, m_actions, m_preferences, m_ui, m_dialogActions, m_options.version, m_gl.versionText(),
                  viewRenderer, m_options.cacheFolder, m_options.threads, device(), width, height});
  if (const auto chosen = m_fileDialog.draw()) {
    // The next question may open the dialog again.
    const auto then = std::exchange(m_fileChosen, nullptr);
    if (then) then(*chosen);
  }
}

void Application::refreshStyle(float screenScale) {
  if (!std::exchange(m_styleChanged, false)) return;
  const float scale = m_preferences.uiScale > 0.0 ? static_cast<float>(m_preferences.uiScale) : screenScale;
  applyTheme(m_preferences.theme == ThemeChoice::Light ? ThemeKind::Light : ThemeKind::Dark, scale);
  for (const std::string& missing : loadFonts(*ImGui::GetIO().Fonts, theme().scale)) notice(missing);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Application::openDocumentation() {
  namespace fs = std::filesystem;
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  for (fs::path folder = program.parent_path(); !code && folder.has_relative_path(); folder = folder.parent_path()) {
    const fs::path readme = folder / "README.md";
    if (!fs::exists(readme, code)) continue;
    // xdg-open goes on by itself; where there is none, the path is what helps.
    const std::string command = "xdg-open '" + readme.string() + "' > /dev/null 2>&1 &";
    if (std::system("command -v xdg-open > /dev/null 2>&1") == 0 && std::system(command.c_str()) == 0) return;
    return notice("The documentation is " + readme.string());
  }
  notice("The documentation is the README of Sward's source");
}

}  // namespace sward::editor
