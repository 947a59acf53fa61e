#include "document/autosave.h"

#include "base/file.h"
#include "document/recovery_file.h"
#include "document/user_folders.h"

#include <algorithm>
#include <atomic>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".autosave";
/// Twice what a project file may hold, since its text stands in a JSON string.
constexpr std::uint64_t kMaxBytes = std::uint64_t{32} << 20;

fs::path lockOf(const fs::path& autosave) {
  return fs::path(autosave).replace_extension(".lock");
}

std::chrono::system_clock::time_point timeOf(std::int64_t unixSeconds) {
  return std::chrono::system_clock::time_point(std::chrono::seconds(unixSeconds));
}

bool isNewer(const fs::path& file, std::int64_t unixSeconds) {
  struct stat info {};
  return !file.empty() && ::stat(file.c_str(), &info) == 0 && info.st_mtime > unixSeconds;
}

/// A name that no other autosave of this folder has, with its lock taken.
std::optional<FileLock> claimName(const fs::path& folder, fs::path& file) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    file = folder / (std::to_string(::getpid()) + "-" + std::to_string(counter++) + kExtension);
    std::error_code code;
    // One of a process that is gone, whose number this one has now, is somebody's work.
    if (fs::exists(file, code)) continue;
    if (auto lock = FileLock::take(lockOf(file))) return lock;
  }
  return std::nullopt;
}

/// ".NAME.tmp12-3.autosave", half written when its program was killed, is NAME's.
std::optional<fs::path> ownerOfTemporary(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::size_t end = name.find(".tmp");
  if (name.empty() || name.front() != '.' || end == std::string::npos || file.extension() != kExtension) return {};
  return file.parent_path() / (name.substr(1, end - 1) + kExtension);
}

std::vector<fs::path> filesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
    files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Removes what belongs to no autosave, of programs that are gone.
void removeLeftovers(const std::vector<fs::path>& files) {
  std::error_code code;
  for (const fs::path& file : files) {
    if (const auto owner = ownerOfTemporary(file)) {
      if (auto lock = FileLock::take(lockOf(*owner))) {
        fs::remove(file, code);
        if (!fs::exists(*owner, code)) lock->remove();
      }
    } else if (file.extension() == ".lock" && !fs::exists(fs::path(file).replace_extension(kExtension), code)) {
      if (auto lock = FileLock::take(file)) lock->remove();
    }
  }
}

Result<RecoveryFile> readRecovery(const fs::path& file) {
  SWARD_ASSIGN(const std::string text, base::readTextFile(file, kMaxBytes));
  return parseRecovery(text, file);
}

Error heldElsewhere(const fs::path& file) {
  return Error::failed("another window has this document", file.string(), "Look for it there.");
}

}  // namespace

fs::path recoveryFolder() {
  const fs::path folder = stateFolder();
  return folder.empty() ? folder : folder / "recovery";
}

std::optional<FileLock> FileLock::take(const fs::path& file) {
  // Another program may remove the file between the opening and the lock; the lock would then be on a file without a
  // name, which nobody else can see.
  for (int attempt = 0; attempt < 100; ++attempt) {
    FileLock lock;
    lock.m_file = file;
    lock.m_fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (lock.m_fd < 0 || ::flock(lock.m_fd, LOCK_EX | LOCK_NB) != 0) return std::nullopt;
    struct stat ours {
    }, named{};
    if (::fstat(lock.m_fd, &ours) != 0) return std::nullopt;
    if (::stat(file.c_str(), &named) == 0 && ours.st_ino == named.st_ino && ours.st_dev == named.st_dev) return lock;
  }
  return std::nullopt;
}

FileLock::FileLock(FileLock&& other) noexcept : m_fd(std::exchange(other.m_fd, -1)), m_file(std::move(other.m_file)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(m_fd, other.m_fd);
  std::swap(m_file, other.m_file);
  return *this;
}

FileLock::~FileLock() {
  if (m_fd >= 0) ::close(m_fd);
}

void FileLock::remove() {
  if (m_fd < 0) return;
  ::unlink(m_file.c_str());
  ::close(std::exchange(m_fd, -1));
}

Autosave::Autosave(fs::path folder) : m_folder(std::move(folder)) {
  if (m_folder.empty()) return;
  std::error_code code;
  const bool isNew = fs::create_directories(m_folder, code);
  if (isNew) fs::permissions(m_folder, fs::perms::owner_all, code);
}

Result<bool> Autosave::update(const Document& document, Time now, double intervalSeconds) {
  if (!document.modified()) {
    clear();
    return false;
  }
  if (m_written && m_revision == document.revision()) return false;
  if (m_last && now - *m_last < std::chrono::duration<double>(intervalSeconds)) return false;
  m_last = now;
  SWARD_TRY(write(document));
  return true;
}

Result<void> Autosave::write(const Document& document) {
  if (m_folder.empty()) {
    return Error::failed("there is no folder for autosaves", "", "Set HOME or XDG_STATE_HOME; save by hand for now.");
  }
  std::error_code code;
  RecoveryFile content;
  content.title = document.title();
  content.file = document.file();
  content.project = document.project();
  if (!content.project.folder.empty()) content.folder = fs::absolute(content.project.folder, code);
  content.unixSeconds =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
  content.processId = ::getpid();
  SWARD_ASSIGN(const std::string text, recoveryText(content));
  if (!m_lock.held()) {
    auto lock = claimName(m_folder, m_file);
    if (!lock) {
      return Error::failed("autosaves cannot be written", m_folder.string(),
                           "Check its permissions and the space on that disk; save by hand for now.");
    }
    m_lock = std::move(*lock);
  }
  SWARD_TRY(base::writeFileAtomically(m_file, text));
  m_written = true;
  m_revision = document.revision();
  return {};
}

void Autosave::clear() {
  if (!m_lock.held()) return;
  std::error_code code;
  fs::remove(m_file, code);
  m_lock.remove();
  m_written = false;
}

RecoveryList findRecoverable(const fs::path& folder) {
  RecoveryList list;
  if (folder.empty()) return list;
  const std::vector<fs::path> files = filesIn(folder);
  removeLeftovers(files);
  std::vector<std::pair<std::int64_t, Recoverable>> found;
  for (const fs::path& file : files) {
    if (file.extension() != kExtension || ownerOfTemporary(file)) continue;
    const auto lock = FileLock::take(lockOf(file));
    if (!lock) continue;
    const Result<RecoveryFile> content = readRecovery(file);
    if (!content.ok()) {
      list.damaged.push_back({file, content.error()});
      continue;
    }
    found.push_back({content->unixSeconds,
                     {file, content->title, content->file, timeOf(content->unixSeconds),
                      isNewer(content->file, content->unixSeconds)}});
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& entry : found) list.usable.push_back(std::move(entry.second));
  return list;
}

Result<Document> recover(const fs::path& recoverable, Autosave& autosave) {
  auto lock = FileLock::take(lockOf(recoverable));
  if (!lock) return heldElsewhere(recoverable);
  SWARD_ASSIGN(RecoveryFile content, readRecovery(recoverable));
  Document document(std::move(content.project), std::move(content.file));
  document.markUnsaved();
  SWARD_TRY(autosave.write(document));
  std::error_code code;
  fs::remove(recoverable, code);
  lock->remove();
  return document;
}

Result<void> discardRecoverable(const fs::path& recoverable) {
  auto lock = FileLock::take(lockOf(recoverable));
  if (!lock) return heldElsewhere(recoverable);
  std::error_code code;
  fs::remove(recoverable, code);
  if (code) return Error::failed("cannot remove the autosave: " + code.message(), recoverable.string());
  lock->remove();
  return {};
}

}  // namespace sward::editor
