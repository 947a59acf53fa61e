#include "bake/asset_hashes.h"

#include "base/file.h"
#include "mesh/gltf_read.h"

#include <sys/stat.h>

namespace sward::bake {

Result<AssetHashes::Known*> AssetHashes::known(const std::filesystem::path& path) {
  struct stat info {};
  const bool there = ::stat(path.c_str(), &info) == 0;
  const Stamp stamp{static_cast<std::uint64_t>(info.st_size),
                    std::int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec};
  if (const auto found = m_known.find(path); there && found != m_known.end() && found->second.stamp == stamp) {
    return &found->second;
  }
  m_known.erase(path);
  // The stamp is older than the bytes: a change in between is seen the next time.
  SWARD_ASSIGN(const std::vector<std::byte> data, base::readFile(path));
  Known& made = m_known[path];
  made.stamp = stamp;
  made.hash = base::hashBytes(data);
  return &made;
}

Result<base::Hash128> AssetHashes::file(const std::filesystem::path& path) {
  SWARD_ASSIGN(const Known* entry, known(path));
  return entry->hash;
}

Result<base::Hash128> AssetHashes::gltf(const std::filesystem::path& path) {
  SWARD_ASSIGN(Known* const entry, known(path));
  if (entry->closure.empty()) {
    SWARD_ASSIGN(entry->closure, mesh::gltfClosure(path));
  }
  base::Hasher hasher;
  for (const auto& part : std::vector<std::filesystem::path>(entry->closure)) {
    SWARD_ASSIGN(const base::Hash128 hash, file(part));
    hasher.add(std::string_view(part.filename().native())).add(hash);
  }
  return hasher.finish();
}

}  // namespace sward::bake
