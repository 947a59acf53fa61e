#include "export/plants.h"

#include "bake/plants.h"
#include "export/folder.h"
#include "mesh/gltf_write.h"

#include <cctype>
#include <set>
#include <string>

namespace sward::exporting {
namespace {

namespace fs = std::filesystem;

/// The name with everything that a file system or a URI may refuse turned into '_'.
std::string fileNameOf(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
    out += plain ? c : '_';
  }
  return out.empty() ? "plant" : out.substr(0, 80);
}

}  // namespace

Result<std::vector<fs::path>> exportPlants(const project::Project& project, const fs::path& folder,
                                           const JobContext& job) {
  SWARD_TRY(makeFolder(folder));
  std::vector<fs::path> files;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    const project::Plant& plant = project.patch.plants[i];
    std::string base = fileNameOf(plant.name);
    if (!taken.insert(base).second) base += "-plant" + std::to_string(i + 1);
    const int variants = bake::variantCount(plant);
    for (int variant = 0; variant < variants; ++variant) {
      if (job.cancelled()) return Error::cancelled();
      SWARD_ASSIGN(const mesh::Model model, bake::plantModel(project, i, variant));
      const std::string number = variants > 1 ? "-" + std::to_string(variant + 1) : "";
      files.push_back(folder / (base + number + ".glb"));
      SWARD_TRY(mesh::writeGlb(files.back(), model));
      if (job.onProgress) {
        job.onProgress(plant.name, (static_cast<double>(i) + (variant + 1.0) / variants) /
                                       static_cast<double>(project.patch.plants.size()));
      }
    }
  }
  return files;
}

}  // namespace sward::exporting
