#pragma once

#include "base/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sward::editor {

enum class ThemeChoice { Dark, Light };

struct WindowPlace {
  int x = 0, y = 0;  ///< of the top left corner, in screen units; used when `known`
  int width = 1280, height = 800;
  bool known = false;  ///< false: wherever the system puts a window
  bool maximised = false;
  bool operator==(const WindowPlace&) const = default;
};

/// What the user set for the program as a whole.
struct Preferences {
  static constexpr std::size_t kMaxRecent = 12;

  double uiScale = 0.0;  ///< 0: from the screen; else 0.5 to 4
  ThemeChoice theme = ThemeChoice::Dark;
  std::uint64_t cacheLimitBytes = std::uint64_t{4} << 30;  ///< of baked results on the disk; 64 MiB to 1 TiB
  std::string device;                                      ///< renderer to draw with; empty: the best one found
  bool showHints = true;
  double autosaveSeconds = 10.0;                   ///< least time between two autosaves, 1 to 3600
  std::vector<std::filesystem::path> recentFiles;  ///< absolute, newest first
  WindowPlace window;
  std::map<std::string, double> panelSizes;  ///< by panel, as a share of the window or in points; the panels' business
  std::vector<std::string> openPanels;
  std::string otherKeys;  ///< JSON object of keys that this version does not know, kept for the one that wrote them
  bool operator==(const Preferences&) const = default;

  /// Puts a file first; the same file is listed once, at most kMaxRecent are kept.
  void addRecent(const std::filesystem::path& file);
  void removeRecent(const std::filesystem::path& file);
};

struct RecentFile {
  std::filesystem::path file;
  bool missing = false;  ///< not there now: a drive that is not mounted, say; it stays in the list
};
std::vector<RecentFile> recentFiles(const Preferences& preferences);

/// configFolder()/preferences.json.
std::filesystem::path preferencesFile();

struct LoadedPreferences {
  Preferences preferences;
  std::vector<std::string> messages;  ///< for the user: what could not be read, and what is used instead
};

/// Reads the file; one that is not there gives the defaults, one that is damaged too, and is renamed to FILE.bad.
/// Values of a wrong type or out of their range are replaced by their defaults, one by one, with a message each.
LoadedPreferences loadPreferences(const std::filesystem::path& file = preferencesFile());

/// Writes the file as a whole or not at all; makes its folder.
Result<void> savePreferences(const Preferences& preferences, const std::filesystem::path& file = preferencesFile());

}  // namespace sward::editor
