#pragma once

#include "base/hash.h"
#include "base/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

namespace sward::bake {

/// Hashes of asset files, remembered by path for as long as a file's size and time of change stay the same, so that an
/// edit of something else reads no asset again.
class AssetHashes {
 public:
  /// Of a file's bytes. Errors: it is missing or unreadable.
  Result<base::Hash128> file(const std::filesystem::path& path);
  /// Of the bytes of a glTF file and of everything it draws in.
  Result<base::Hash128> gltf(const std::filesystem::path& path);

 private:
  struct Stamp {
    std::uint64_t bytes = 0;
    std::int64_t changedNs = 0;
    bool operator==(const Stamp&) const = default;
  };
  struct Known {
    Stamp stamp;
    base::Hash128 hash;
    std::vector<std::filesystem::path> closure;  ///< of a glTF file; empty until asked for
  };
  Result<Known*> known(const std::filesystem::path& path);
  std::map<std::filesystem::path, Known> m_known;
};

}  // namespace sward::bake
