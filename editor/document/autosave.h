#pragma once

#include "document/document.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::editor {

/// Where autosaves lie unless a test says otherwise: stateFolder()/recovery.
std::filesystem::path recoveryFolder();

/// A file that is held by this process (flock), and let go by the system however the process ends.
class FileLock {
 public:
  FileLock() = default;
  /// Takes the lock; nothing when another holds it or the file cannot be made.
  static std::optional<FileLock> take(const std::filesystem::path& file);
  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  /// Lets go and removes the file.
  void remove();
  bool held() const { return m_fd >= 0; }

 private:
  int m_fd = -1;
  std::filesystem::path m_file;
};

/// Keeps a copy of one document's unsaved state, so that a crash or a kill costs seconds. The copy goes when the
/// document is saved or undone to its saved state, and by clear(), which a window calls when it is closed in peace.
/// Destroying the Autosave leaves the copy: a stack that is unwound by an error must not take the user's work along.
/// Belongs to the UI thread; it writes one small file (some 10 kB) at a time.
class Autosave {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Makes the folder when it is missing, for the user alone (0700); the first write says why when that fails.
  explicit Autosave(std::filesystem::path folder = recoveryFolder());
  Autosave(const Autosave&) = delete;
  Autosave& operator=(const Autosave&) = delete;

  /// Called every now and then: writes when the document is modified, in another state than was written last, and
  /// `intervalSeconds` have passed since the last write. True when it wrote. After an error it waits as long as after a
  /// write, so that a full disk is told once an interval.
  Result<bool> update(const Document& document, Time now, double intervalSeconds);
  /// Writes at once.
  Result<void> write(const Document& document);
  /// Removes the copy; what the user closed without saving was their choice.
  void clear();
  /// The file of the copy; empty before the first write.
  const std::filesystem::path& file() const { return m_file; }

 private:
  std::filesystem::path m_folder;
  std::filesystem::path m_file;
  FileLock m_lock;
  bool m_written = false;
  std::uint64_t m_revision = 0;
  std::optional<Time> m_last;
};

/// An unsaved document of a program that is gone.
struct Recoverable {
  std::filesystem::path autosave;
  std::string title;
  std::filesystem::path file;  ///< of the document; empty when it was never saved
  std::chrono::system_clock::time_point time;
  bool fileIsNewer = false;  ///< the document's file was written after the autosave
};

struct DamagedAutosave {
  std::filesystem::path autosave;
  Error problem;
};

struct RecoveryList {
  std::vector<Recoverable> usable;  ///< newest first
  std::vector<DamagedAutosave> damaged;
};

/// The autosaves in `folder` that no running program holds. Leftovers without an autosave (locks, half-written
/// temporaries) of programs that are gone are removed.
RecoveryList findRecoverable(const std::filesystem::path& folder = recoveryFolder());

/// The recovered document, marked unsaved, with its original file. `autosave` holds its first copy when this returns,
/// and the old one is removed only then. An error when another program took it meanwhile, or it is damaged.
Result<Document> recover(const std::filesystem::path& recoverable, Autosave& autosave);

/// Removes an autosave that the user does not want (or a damaged one); one that a running program holds stays.
Result<void> discardRecoverable(const std::filesystem::path& recoverable);

}  // namespace sward::editor
