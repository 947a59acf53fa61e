#pragma once

#include "base/hash.h"
#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::bake {

/// The user's cache folder: $XDG_CACHE_HOME/sward, else ~/.cache/sward.
std::filesystem::path defaultCacheFolder();

/// Content-addressed files on disk. Safe with several processes: entries are written to a temporary and renamed, and
/// verified by a checksum when read; a damaged entry is removed and counts as absent. The least recently used entries
/// go when the folder passes its limit.
class DiskCache {
 public:
  /// Creates the folder when needed. A folder that cannot be written is an error; use a cache-less run then.
  static Result<DiskCache> open(const std::filesystem::path& folder, std::uint64_t limitBytes = std::uint64_t{4} << 30);

  std::optional<std::vector<std::byte>> get(const std::string& kind, const base::Hash128& key) const;
  /// Whether there is an entry, sound or damaged.
  bool contains(const std::string& kind, const base::Hash128& key) const;
  /// A full disk is an error; the bake itself goes on without the entry.
  Result<void> put(const std::string& kind, const base::Hash128& key, std::span<const std::byte> payload);
  /// Bytes of all entries.
  std::uint64_t size() const;
  const std::filesystem::path& folder() const { return m_folder; }

 private:
  void trim();
  std::filesystem::path m_folder;
  std::uint64_t m_limitBytes = 0;
  std::uint64_t m_untrimmedBytes = 0;  ///< written since the folder was last measured
};

}  // namespace sward::bake
