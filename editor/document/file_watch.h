#pragma once

#include "document/document.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace sward::editor {

struct FileEvent {
  enum class What {
    Changed,  ///< other content
    Removed,  ///< not there any more (or no regular file)
    Appeared  ///< there again, or for the first time
  };
  std::filesystem::path file;
  What what = What::Changed;
  bool isProject = false;  ///< the document's own file; else an asset
  bool operator==(const FileEvent&) const = default;
};

/// Notices that another program changed the document's file or one of its assets, by looking at size, time and identity
/// of each once a second: in place, or by a new file renamed over the old one; also on file systems that send no
/// notices. A look is one stat(2) a file; the project alone is read again, and only when it was touched.
/// The project's own file counts as changed when it says another project than the one saved or opened: our own saves, a
/// touch and another layout of the text are no news.
class FileWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Watches `file`, which says `saved` as far as we know: call it after opening and after every save. An empty file,
  /// of a document never saved, is not watched. Assets stay watched.
  void watchProject(const std::filesystem::path& file, Snapshot saved);
  /// Watches these files (absolute or from the working folder; a glTF with its closure), and no other assets. Those
  /// watched before keep what is known of them, so that it can be called whenever the project changed.
  void watchAssets(const std::vector<std::filesystem::path>& files);

  /// Looks when a second has passed since the last look. A change is told once, at the first look that finds it
  /// settled: equal to the look before, so that a file half written is not read.
  std::vector<FileEvent> poll(Time now);
  /// Looks at the project's file at once: it says something else than what was saved, or is gone. To ask before a save.
  bool projectDiffers() const;

 private:
  /// What tells two contents of a path apart without reading it.
  struct Stamp {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t seconds = 0, nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };
  using Look = std::optional<Stamp>;  ///< nothing: no regular file is there
  struct Watched {
    Look known;                   ///< as last told
    std::optional<Look> pending;  ///< another one, seen at the last look
  };
  static Look look(const std::filesystem::path& file);
  /// The settled change of one file, if there is one.
  static std::optional<FileEvent::What> check(const std::filesystem::path& file, Watched& watched);
  bool saysSaved() const;

  std::filesystem::path m_project;
  Snapshot m_saved;
  Watched m_projectState;
  bool m_projectTold = false;  ///< it differs, and that was told
  std::map<std::filesystem::path, Watched> m_assets;
  std::optional<Time> m_last;
};

}  // namespace sward::editor
