#include "export/frame_manifest.h"

#include "base/file.h"
#include "base/hash.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sward::exporting {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

/// Holds a file's lock, so that no other process changes it meanwhile. Where locks are not to be had (some network file
/// systems) it holds nothing: two processes that record at the same moment may then lose an entry, whose frame is drawn
/// again at the next run.
class FileLock {
 public:
  explicit FileLock(const fs::path& file) {
    // Whoever had the lock before has put another file in the place of the one that was opened.
    while (true) {
      m_fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (m_fd < 0) return;
      while (::flock(m_fd, LOCK_EX) != 0) {
        if (errno != EINTR) return;
      }
      struct stat held {
      }, there{};
      if (::fstat(m_fd, &held) != 0) return;
      if (::stat(file.c_str(), &there) == 0 && held.st_ino == there.st_ino && held.st_dev == there.st_dev) return;
      ::close(std::exchange(m_fd, -1));
    }
  }
  ~FileLock() {
    if (m_fd >= 0) ::close(m_fd);
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int m_fd = -1;
};

FrameEntry entryFrom(const Json& json) {
  FrameEntry entry;
  entry.frame = json.at("frame").get<int>();
  entry.file = json.at("file").get<std::string>();
  entry.weathering = json.at("weathering").get<double>();
  entry.key = json.at("key").get<std::string>();
  entry.hash = json.at("hash").get<std::string>();
  entry.bytes = json.at("bytes").get<std::uint64_t>();
  entry.device = json.at("device").get<std::string>();
  return entry;
}

Json jsonOf(const FrameEntry& entry) {
  return {{"frame", entry.frame}, {"file", entry.file},   {"weathering", entry.weathering}, {"key", entry.key},
          {"hash", entry.hash},   {"bytes", entry.bytes}, {"device", entry.device}};
}

std::string textOf(const FrameManifest& manifest) {
  Json json{{"format", kFormat}, {"settings", Json::parse(manifest.settings, nullptr, false)}};
  if (json["settings"].is_discarded()) json["settings"] = Json::object();
  json["frames"] = Json::array();
  for (const auto& [number, entry] : manifest.frames) json["frames"].push_back(jsonOf(entry));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

FrameManifest readManifest(const fs::path& file) {
  FrameManifest manifest;
  const auto text = base::readTextFile(file);
  if (!text.ok()) return manifest;
  try {
    const Json json = Json::parse(*text);
    if (json.at("format").get<int>() != kFormat) return manifest;
    FrameManifest read;
    read.settings = json.at("settings").dump();
    for (const Json& item : json.at("frames")) {
      FrameEntry entry = entryFrom(item);
      const int frame = entry.frame;
      read.frames.insert_or_assign(frame, std::move(entry));
    }
    return read;
  } catch (const Json::exception&) {
    return manifest;
  }
}

bool isWhole(const fs::path& folder, const FrameEntry& entry) {
  // A name that leads elsewhere is none that record() wrote.
  if (entry.file.empty() || fs::path(entry.file).filename() != entry.file) return false;
  std::error_code code;
  const fs::path file = folder / entry.file;
  if (!fs::is_regular_file(file, code) || fs::file_size(file, code) != entry.bytes) return false;
  const auto data = base::readFile(file);
  return data.ok() && base::hashBytes(*data).hex() == entry.hash;
}

Result<FrameEntry> entryOf(const fs::path& file, int frame, double weathering, const std::string& key,
                           const std::string& device) {
  SWARD_ASSIGN(const std::vector<std::byte> data, base::readFile(file));
  FrameEntry entry;
  entry.frame = frame;
  entry.file = file.filename().string();
  entry.weathering = weathering;
  entry.key = key;
  entry.hash = base::hashBytes(data).hex();
  entry.bytes = data.size();
  entry.device = device;
  return entry;
}

Result<void> record(const fs::path& file, const std::string& settings, const FrameEntry& entry) {
  const FileLock lock(file);
  FrameManifest manifest = readManifest(file);
  manifest.settings = settings;
  manifest.frames[entry.frame] = entry;
  return base::writeFileAtomically(file, textOf(manifest));
}

}  // namespace sward::exporting
