#pragma once

#include "project/project.h"

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sward::project {

/// One file that a project names: where its path stands in the document, such as "patch.plants[2].gltf.path", the path
/// as written there, and whether the project uses it now (a plant of another kind keeps its glTF path).
struct AssetReference {
  std::string where;
  std::string path;
  bool used = true;
};

/// Every asset path that is not empty, in the order of the document.
std::vector<AssetReference> assets(const Project& project);

/// How a project in `folder` names `file`: relative where that is possible, with symbolic links of folders followed, so
/// that ".." means what the system takes it for; absolute when `folder` is empty (the project lies nowhere yet).
std::string assetPath(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Moves projects to another folder: rewrites asset paths so that they name the same files from there, and sets the
/// folder. Paths that someone wrote as absolute stay so; those of a project that lay nowhere yet become relative.
/// Answers are kept, so that a long history of states costs a few look-ups.
class AssetRebase {
 public:
  explicit AssetRebase(std::filesystem::path folder) : m_folder(std::move(folder)) {}
  void apply(Project& project);

 private:
  std::string rebased(const std::string& path, const std::filesystem::path& from);
  std::filesystem::path m_folder;
  std::map<std::pair<std::string, std::string>, std::string> m_known;
};

/// The assets in use that are not there as regular files.
std::vector<AssetReference> missingAssets(const Project& project);

/// Points the asset at `where` (see AssetReference) to `file`, and every other reference to the same old path too.
/// An error when there is no asset at `where`, or `file` is not there.
Result<void> relocate(Project& project, const std::string& where, const std::filesystem::path& file);

}  // namespace sward::project
