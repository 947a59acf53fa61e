#pragma once

#include "app/actions.h"
#include "document/autosave.h"
#include "document/document.h"
#include "document/preferences.h"
#include "live/picture_job.h"
#include "panels/ui_state.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::editor {

/// What dialogs ask the application for.
struct DialogActions {
  std::function<void(const std::string& name)> useTemplate;
  std::function<void(const std::filesystem::path& autosave)> recover;
  std::function<void()> preferencesChanged;   ///< theme or scale
  std::function<void()> rememberPreferences;  ///< writes them now: a program that is killed writes nothing
  std::function<void(std::function<void(const std::filesystem::path&)>)> chooseOutput;
  std::function<void(const std::string& where, const std::filesystem::path& file)> relocate;
  std::function<void(const std::string& where, const std::string& files)> browse;
  std::function<void(const std::string& text)> notice;
  std::function<void()> wake;  ///< from any thread: there is something new to draw
};

/// The modal windows, one at a time, and the hints of the first run.
class Dialogs {
 public:
  void openTemplates() { open(Kind::Templates); }
  void openPreferences() { open(Kind::Preferences); }
  void openShortcuts() { open(Kind::Shortcuts); }
  void openAbout() { open(Kind::About); }
  void openHints() { m_hints = true; }
  void openRender(const Document& document, const UiState& ui);
  /// "Save, don't save, cancel" about `name`.
  void askUnsaved(const std::string& name, std::function<void()> save, std::function<void()> drop);
  /// "Reload or keep mine", when the file changed on disk while there are unsaved changes.
  void askReload(const std::string& name, std::function<void()> reload);
  void offerRecovery(RecoveryList list);
  void showMissing(std::vector<std::string> wheres, std::vector<std::string> files);
  void showError(const std::string& title, const Error& error);

  bool pictureRunning() const { return m_picture != nullptr; }

  struct Input {
    const Document& document;
    const ActionTable& actions;
    Preferences& preferences;
    const UiState& ui;
    const DialogActions& act;
    std::string version;       ///< of Sward
    std::string uiRenderer;    ///< what draws the window
    std::string viewRenderer;  ///< what draws the viewport
    std::filesystem::path cacheFolder;
    int threads = 0;
    gpu::Device device = gpu::Device::Auto;
    int width = 0, height = 0;  ///< of the window
  };
  void draw(const Input& input);

 private:
  enum class Kind { None, Templates, Preferences, Shortcuts, About, Render, Unsaved, Reload, Recovery, Missing, Error };
  void open(Kind kind);
  void close();
  bool begin(const char* title, const Input& input, float width, float height = 0.0f);
  bool button(const char* label, const char* id, bool primary = false);

  void drawTemplates(const Input& input);
  void drawPreferences(const Input& input);
  void drawShortcuts(const Input& input);
  void drawAbout(const Input& input);
  void drawRender(const Input& input);
  void drawPictureProgress(const Input& input);
  void startPicture(const Input& input);
  void drawUnsaved(const Input& input);
  void drawReload(const Input& input);
  void drawRecovery(const Input& input);
  void drawMissing(const Input& input);
  void drawError(const Input& input);
  void drawHints(const Input& input);

  Kind m_kind = Kind::None;
  bool m_opening = false;
  bool m_hints = false;

  std::string m_name, m_message;
  std::function<void()> m_yes, m_no;
  RecoveryList m_recovery;
  std::vector<std::string> m_missingWhere, m_missingFile;

  struct RenderSettings {
    std::size_t view = 0;
    bool fromCamera = true;
    int width = 1280, height = 720, samples = 16;
    std::string file;
  } m_render;
  std::unique_ptr<PictureJob> m_picture;
};

}  // namespace sward::editor
