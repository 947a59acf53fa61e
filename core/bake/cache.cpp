#include "bake/cache.h"

#include "base/file.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sward::bake {
namespace {

namespace fs = std::filesystem;

/// Stands after the payload, so that reading an entry moves no bytes. Trivially copyable without padding.
struct Trailer {
  std::uint64_t magic = kMagic;
  std::uint64_t version = kVersion;
  std::uint64_t payloadBytes = 0;
  std::uint64_t checksumHigh = 0;
  std::uint64_t checksumLow = 0;

  static constexpr std::uint64_t kMagic = 0x656b616264726177;  // "wardbake"
  static constexpr std::uint64_t kVersion = 1;
  bool operator==(const Trailer&) const = default;
};

Trailer trailerOf(std::span<const std::byte> payload) {
  const base::Hash128 checksum = base::hashBytes(payload);
  Trailer trailer;
  trailer.payloadBytes = payload.size();
  trailer.checksumHigh = checksum.high;
  trailer.checksumLow = checksum.low;
  return trailer;
}

fs::path entryPath(const fs::path& folder, const std::string& kind, const base::Hash128& key) {
  const std::string name = key.hex();
  return folder / kind / name.substr(0, 2) / (name + ".bake");
}

/// True when the bytes are a whole entry; cuts the trailer off.
bool unwrap(std::vector<std::byte>& data) {
  if (data.size() < sizeof(Trailer)) return false;
  Trailer trailer;
  const std::size_t payload = data.size() - sizeof(Trailer);
  std::memcpy(&trailer, data.data() + payload, sizeof(Trailer));
  if (trailer.magic != Trailer::kMagic || trailer.payloadBytes != payload) return false;
  if (!(trailer == trailerOf(std::span(data).first(payload)))) return false;
  data.resize(payload);
  return true;
}

Error writeError(const fs::path& path) {
  return Error::failed(std::string("cannot write a cache entry: ") + std::strerror(errno), path.string(),
                       errno == ENOSPC ? "Free some space on that disk, or choose another with --cache."
                                       : "Choose another folder with --cache.");
}

Result<void> writeEntry(const fs::path& path, std::span<const std::byte> payload) {
  const Trailer trailer = trailerOf(payload);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return writeError(path);
  const bool written = (payload.empty() || std::fwrite(payload.data(), payload.size(), 1, file) == 1) &&
                       std::fwrite(&trailer, sizeof(trailer), 1, file) == 1;
  const int code = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written) errno = code;
  if (!written || !closed) return writeError(path);
  return {};
}

struct Entry {
  fs::path path;
  std::uint64_t bytes = 0;
  std::int64_t usedNs = 0;
};

/// All entries; files that vanish meanwhile (another process trims too) are left out. Temporary files of processes
/// that died an hour ago or more are removed.
std::vector<Entry> listEntries(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code code;
  fs::recursive_directory_iterator item(folder, fs::directory_options::skip_permission_denied, code);
  for (; !code && item != fs::recursive_directory_iterator(); item.increment(code)) {
    struct stat info {};
    const fs::path path = item->path();
    if (path.extension() != ".bake" || ::lstat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) continue;
    if (path.filename().string().front() == '.') {
      if (::time(nullptr) - info.st_mtim.tv_sec > 3600) ::unlink(path.c_str());
      continue;
    }
    entries.push_back({path, static_cast<std::uint64_t>(info.st_size),
                       std::int64_t{info.st_mtim.tv_sec} * 1000000000 + info.st_mtim.tv_nsec});
  }
  return entries;
}

}  // namespace

fs::path defaultCacheFolder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  // The XDG base directory specification: a relative path is to be ignored.
  if (cache != nullptr && *cache == '/') return fs::path(cache) / "sward";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return fs::path(home) / ".cache" / "sward";
  return fs::temp_directory_path() / ("sward-cache-" + std::to_string(::getuid()));
}

Result<DiskCache> DiskCache::open(const fs::path& folder, std::uint64_t limitBytes) {
  std::error_code code;
  fs::create_directories(folder, code);
  if (!fs::is_directory(folder) || ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) {
    const std::string why = code ? code.message() : std::strerror(errno);
    return Error::failed("cannot use the cache folder: " + why, folder.string(), "Choose another with --cache.");
  }
  DiskCache cache;
  cache.m_folder = folder;
  cache.m_limitBytes = limitBytes;
  cache.m_untrimmedBytes = limitBytes;  // measured at the first put
  return cache;
}

std::optional<std::vector<std::byte>> DiskCache::get(const std::string& kind, const base::Hash128& key) const {
  const fs::path path = entryPath(m_folder, kind, key);
  auto data = base::readFile(path);
  if (!data.ok()) return std::nullopt;
  if (!unwrap(*data)) {
    ::unlink(path.c_str());
    return std::nullopt;
  }
  // Marks the use: many disks are mounted without access times.
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
  return std::move(data).value();
}

bool DiskCache::contains(const std::string& kind, const base::Hash128& key) const {
  std::error_code code;
  return fs::is_regular_file(entryPath(m_folder, kind, key), code);
}

Result<void> DiskCache::put(const std::string& kind, const base::Hash128& key, std::span<const std::byte> payload) {
  const fs::path path = entryPath(m_folder, kind, key);
  std::error_code code;
  fs::create_directories(path.parent_path(), code);
  SWARD_TRY(
      base::writeThroughTemporary(path, [&](const fs::path& temporary) { return writeEntry(temporary, payload); }));
  m_untrimmedBytes += payload.size() + sizeof(Trailer);
  if (m_untrimmedBytes > m_limitBytes / 16) trim();
  return {};
}

std::uint64_t DiskCache::size() const {
  std::uint64_t bytes = 0;
  for (const Entry& entry : listEntries(m_folder)) bytes += entry.bytes;
  return bytes;
}

void DiskCache::trim() {
  m_untrimmedBytes = 0;
  std::vector<Entry> entries = listEntries(m_folder);
  std::uint64_t bytes = 0;
  for (const Entry& entry : entries) bytes += entry.bytes;
  if (bytes <= m_limitBytes) return;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.usedNs < b.usedNs; });
  // A tenth more than needed goes, so that not every put trims.
  const std::uint64_t target = m_limitBytes - m_limitBytes / 10;
  for (const Entry& entry : entries) {
    if (bytes <= target) break;
    ::unlink(entry.path.c_str());
    bytes -= entry.bytes;
  }
}

}  // namespace sward::bake
