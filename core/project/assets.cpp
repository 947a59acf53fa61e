#include "project/assets.h"

namespace sward::project {
namespace {

namespace fs = std::filesystem;

/// Calls visit(where, path, used) for every place of a project that may name a file.
template <typename P, typename Visit>
void visitAssets(P& project, const Visit& visit) {
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    auto& plant = project.patch.plants[i];
    visit("patch.plants[" + std::to_string(i) + "].gltf.path", plant.gltf.path, plant.kind == PlantKind::Gltf);
  }
  visit(std::string("patch.soil.texture"), project.patch.soil.texture, true);
  visit(std::string("terrain.heightmap.path"), project.terrain.heightmap.path,
        project.terrain.source == terrain::Source::Heightmap);
}

/// The same file, its folder's symbolic links followed; the file itself may be a link and keeps its name.
fs::path plainPath(const fs::path& file) {
  std::error_code code;
  const fs::path absolute = fs::absolute(file, code).lexically_normal();
  if (code) return file;
  const fs::path folder = fs::weakly_canonical(absolute.parent_path(), code);
  return code ? absolute : folder / absolute.filename();
}

fs::path plainFolder(const fs::path& folder) {
  std::error_code code;
  const fs::path plain = fs::weakly_canonical(fs::absolute(folder), code).lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

}  // namespace

std::vector<AssetReference> assets(const Project& project) {
  std::vector<AssetReference> list;
  visitAssets(project, [&](std::string where, const std::string& path, bool used) {
    if (!path.empty()) list.push_back({std::move(where), path, used});
  });
  return list;
}

std::string assetPath(const fs::path& file, const fs::path& folder) {
  const fs::path plain = plainPath(file);
  if (folder.empty()) return plain.generic_string();
  const fs::path relative = plain.lexically_relative(plainFolder(folder));
  return relative.empty() ? plain.generic_string() : relative.generic_string();
}

std::string AssetRebase::rebased(const std::string& path, const fs::path& from) {
  const auto [place, isNew] = m_known.try_emplace({path, from.string()});
  if (isNew) {
    const bool keep = fs::path(path).is_absolute() && !from.empty();
    place->second = keep ? path : assetPath(from / path, m_folder);
  }
  return place->second;
}

void AssetRebase::apply(Project& project) {
  visitAssets(project, [&](const std::string&, std::string& path, bool) {
    if (!path.empty()) path = rebased(path, project.folder);
  });
  project.folder = m_folder;
}

std::vector<AssetReference> missingAssets(const Project& project) {
  std::vector<AssetReference> missing = assets(project);
  std::erase_if(missing, [&](const AssetReference& asset) {
    std::error_code code;
    return !asset.used || fs::is_regular_file(project.resolve(asset.path), code);
  });
  return missing;
}

Result<void> relocate(Project& project, const std::string& where, const fs::path& file) {
  std::error_code code;
  if (!fs::is_regular_file(file, code)) {
    return Error::badInput("the file does not exist", file.string(), "Choose another file.");
  }
  std::string old;
  bool found = false;
  visitAssets(project, [&](const std::string& place, const std::string& path, bool) {
    if (place == where) old = path, found = true;
  });
  if (!found)
    return Error::badInput("the project names no file there", where,
                           "Choose a plant, the soil's texture or the heightmap.");
  const std::string path = assetPath(file, project.folder);
  visitAssets(project, [&](const std::string& place, std::string& asset, bool) {
    if (place == where || (!old.empty() && asset == old)) asset = path;
  });
  return {};
}

}  // namespace sward::project
