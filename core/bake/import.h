#pragma once

#include "base/result.h"
#include "project/project.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sward::bake {

/// A plant made of a mesh, and what was chosen for it.
struct ImportedPlant {
  project::Plant plant;            ///< share 0: that is for the caller, who knows the others'
  int slices = 16;                 ///< layers that its parts ask for: the project's own number, or more
  std::vector<std::string> notes;  ///< for people: each choice with the value's path, as if it were plant 0
};

/// A plant of the project from a glTF file, so that its first picture is a good one: as tall as the project's grass
/// unless its own metres are a grass's, at most 0.3 of the patch wide, as many as make a dense sward (a leaf area index
/// of 5, closed parts counting half; 4 to 1500 a square metre), dark colours brightened, green where the file has no
/// colour. `folder` is the project's; empty while it lies nowhere. Reads the whole mesh: large ones take seconds.
Result<ImportedPlant> plantFromMesh(const std::filesystem::path& mesh, const project::Project& project,
                                    const std::filesystem::path& folder);

}  // namespace sward::bake
