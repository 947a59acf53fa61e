#pragma once

#include "app/actions.h"
#include "app/dialogs.h"
#include "app/live_link.h"
#include "app/palette.h"
#include "app/stall_meter.h"
#include "app/ui_gl.h"
#include "document/autosave.h"
#include "document/document.h"
#include "document/file_watch.h"
#include "document/preferences.h"
#include "panels/curve_panel.h"
#include "panels/day_panel.h"
#include "panels/inspector.h"
#include "panels/light_panel.h"
#include "panels/outliner.h"
#include "panels/season_panel.h"
#include "panels/panel_context.h"
#include "panels/camera_control.h"
#include "panels/viewport.h"
#include "widgets/file_dialog.h"
#include "widgets/item_log.h"
#include "widgets/toasts.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sward::editor {

/// How the editor is started.
struct ApplicationOptions {
  std::optional<std::filesystem::path> project;  ///< none: the sample, or what was open last
  std::vector<std::string> overrides;            ///< of --set: one unsaved edit
  std::filesystem::path cacheFolder;
  int threads = 0;
  std::optional<gpu::Device> device;  ///< none: the preferences'
  std::filesystem::path itemLog;      ///< where each frame's items are written for tests; empty: nowhere
  std::string version;
  bool unattended = false;  ///< nobody is there: no hints, no recovery of lost work, no copies for it
};

/// The editor apart from its window: document, services, panels and dialogs. One frame() call draws all of it with
/// ImGui, whatever context and event source stand behind. Belongs to the UI thread.
class Application : public EditSink {
 public:
  /// `wake` is called from any thread when frame() has something new to show. `gl` outlives the application.
  Application(ApplicationOptions options, LoadedPreferences loaded, const UiGl& gl, std::function<void()> wake);
  ~Application() override;

  /// Takes what the services have, looks after autosave and files; true when a frame should be drawn.
  bool poll(double seconds);
  /// Between ImGui::NewFrame() and ImGui::Render().
  void frame(double seconds, int width, int height);
  /// After the frame was shown: how long it took from its event.
  void frameShown(double milliseconds);

  /// Seconds at which a frame is wanted without any event; none: only when something happens.
  std::optional<double> nextWake() const;

  /// A key went down with these modifiers: the next frame runs the action that it is a shortcut of.
  void keyPressed(const Shortcut& key) { m_keys.push_back(key); }
  void dropped(const std::vector<std::filesystem::path>& files);
  /// The window's close button: asks about unsaved changes first.
  void closeRequested();
  /// Before the end: remembers the layout. `interrupted`: what is unsaved stays as an autosave for the next start.
  void shutDown(bool interrupted);
  bool wantsToQuit() const { return m_quit; }
  std::string title() const;
  /// Between frames: applies theme and scale where they changed, and loads the fonts anew. `screenScale` is what the
  /// screen asks for where the preferences leave it open.
  void refreshStyle(float screenScale);
  Preferences& preferences() { return m_preferences; }
  const StallMeter& stalls() const { return m_stalls; }
  const LiveLink& live() const { return *m_live; }
  const Document& document() const { return *m_document; }
  UiState& ui() { return m_ui; }

  // EditSink
  void edit(const std::string& name, const std::function<void(project::Project&)>& change,
            const std::string& mergeKey) override;
  void closeStep() override;
  void run(const std::string& action) override;
  void notice(const std::string& text) override;
  void browse(const std::string& path, const std::string& files) override;

 private:
  // application_actions.cpp
  void registerActions();
  void registerFileActions();
  void registerEditActions();
  void registerPlantActions();
  void registerViewActions();
  void registerHelpActions();
  void handleShortcuts();
  void afterHistory();
  void frameSelection();
  void lookFrom(StandardView from);
  void cameraMoved();
  void nextView();
  void saveView();
  void updateView();
  void removeView();
  void playSeason(double seconds);
  void openDocumentation();
  gpu::Device device() const;

  // application_files.cpp
  void openAtStart();
  void applyOverrides();
  void startFromTemplate(const std::string& name);
  void open(const std::filesystem::path& file);
  void recoverFrom(const std::filesystem::path& autosave);
  void replaceDocument(Document document);
  void showDocument(Document document);
  void showMissingAssets();
  void save(const std::function<void()>& then = {});
  void saveAs(const std::function<void()>& then = {});
  void saveDone(const std::function<void()>& then);
  void revert();
  void chooseProject();
  void choosePlantFile();
  void chooseOutput(const std::function<void(const std::filesystem::path&)>& then);
  /// Runs `then` at once, or after the user said what to do with unsaved changes.
  void whenSaved(const std::function<void()>& then);
  void addPlantFrom(const std::filesystem::path& mesh);
  void autosave();
  void watchFiles();
  void chooseFile(FileDialogOptions options, std::function<void(const std::filesystem::path&)> then);

  // application_shell.cpp
  PanelContext context(double seconds);
  void refresh(PanelContext& context);
  void drawMenuBar();
  void drawRecentMenu();
  void drawToolbar();
  void toolButton(const char* id);
  void drawCompareControls();
  void drawPanels(PanelContext& context, int width, int height);
  void drawBottom(PanelContext& context);
  void drawTab(PanelContext& context, BottomTab tab);
  void setDialogActions();
  void drawDialogs(int width, int height);
  void writeItemLog(int width, int height);

  /// Sizes of the panels round the viewport, design pixels.
  struct Layout {
    float left = 250.0f, right = 380.0f, bottom = 250.0f;
  };

  ApplicationOptions m_options;
  Preferences m_preferences;
  const UiGl& m_gl;
  std::function<void()> m_wake;
  std::unique_ptr<Document> m_document;
  Autosave m_autosave;
  std::uint64_t m_autosavedRevision = 0;  ///< of the state whose copy lies in the recovery folder
  FileWatch m_watch;
  std::uint64_t m_watchedRevision = 0;
  std::unique_ptr<LiveLink> m_live;
  ActionTable m_actions;
  UiState m_ui;
  StallMeter m_stalls;
  Toasts m_toasts;
  ItemLog m_itemLog;
  std::string m_itemLogText;

  OutlinerPanel m_outliner;
  InspectorPanel m_inspector;
  ViewportPanel m_viewport;
  CurvePanel m_curves;
  LightPanel m_lights;
  DayPanel m_day;
  SeasonPanel m_season;
  CommandPalette m_palette;
  Dialogs m_dialogs;
  DialogActions m_dialogActions;
  FileDialog m_fileDialog;
  std::function<void(const std::filesystem::path&)> m_fileChosen;

  Layout m_layout;
  std::vector<Shortcut> m_keys;  ///< pressed since the last frame
  BottomTab m_shownTab = BottomTab::Curves;
  double m_seconds = 0.0;
  double m_lastFrame = 0.0;
  bool m_quit = false;
  bool m_noticed = false;
  bool m_styleChanged = true;
};

}  // namespace sward::editor
