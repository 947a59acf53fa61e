#include "document/file_watch.h"

#include <sys/stat.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kPeriod{1};

}  // namespace

FileWatch::Look FileWatch::look(const fs::path& file) {
  struct stat info {};
  if (::stat(file.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
  return Stamp{info.st_dev, info.st_ino, static_cast<std::uint64_t>(info.st_size), info.st_mtim.tv_sec,
               info.st_mtim.tv_nsec};
}

void FileWatch::watchProject(const fs::path& file, Snapshot saved) {
  m_project = file;
  m_saved = std::move(saved);
  // A change between the opening and this moment is found too: the first look compares what the file says.
  m_projectState = {Stamp{}, std::nullopt};
  m_projectTold = false;
}

void FileWatch::watchAssets(const std::vector<fs::path>& files) {
  std::map<fs::path, Watched> assets;
  for (const fs::path& file : files) {
    const auto old = m_assets.find(file);
    assets.emplace(file, old != m_assets.end() ? old->second : Watched{look(file), std::nullopt});
  }
  m_assets = std::move(assets);
}

std::optional<FileEvent::What> FileWatch::check(const fs::path& file, Watched& watched) {
  const Look now = look(file);
  if (now == watched.known) {
    watched.pending.reset();
    return std::nullopt;
  }
  if (!watched.pending || *watched.pending != now) {
    watched.pending = now;
    return std::nullopt;
  }
  const bool was = watched.known.has_value();
  watched.known = now;
  watched.pending.reset();
  if (!now) return FileEvent::What::Removed;
  return was ? FileEvent::What::Changed : FileEvent::What::Appeared;
}

bool FileWatch::saysSaved() const {
  const Result<project::Project> there = project::load(m_project);
  return there.ok() && m_saved != nullptr && *there == *m_saved;
}

std::vector<FileEvent> FileWatch::poll(Time now) {
  if (m_last && now - *m_last < kPeriod) return {};
  m_last = now;
  std::vector<FileEvent> events;
  if (!m_project.empty()) {
    if (const auto what = check(m_project, m_projectState)) {
      const bool differs = *what == FileEvent::What::Removed || !saysSaved();
      // Back at what was saved is news to whoever was told that it differs.
      if (differs || m_projectTold) events.push_back({m_project, *what, true});
      m_projectTold = differs;
    }
  }
  for (auto& [file, watched] : m_assets) {
    if (const auto what = check(file, watched)) events.push_back({file, *what, false});
  }
  return events;
}

bool FileWatch::projectDiffers() const {
  return !m_project.empty() && !saysSaved();
}

}  // namespace sward::editor
