#pragma once

#include "project/project.h"

#include <cstddef>
#include <optional>
#include <string>

namespace sward::editor {

/// What the inspector shows: one entry of the outliner.
struct Selection {
  enum class Kind { Ground, Plant, Lights, Tiles, Terrain, Wither, Leaf, SunSky, View, Sampling, Fit, Render };

  Kind kind = Kind::Ground;
  std::size_t index = 0;  ///< of the plant or view; 0 for the other kinds
  std::string name;       ///< of the plant or view, by which it is found again when the list changed
  bool operator==(const Selection&) const = default;
};

Selection selectPlant(const project::Project& project, std::size_t index);
Selection selectView(const project::Project& project, std::size_t index);

/// The same selection in a project that changed (by undo, say): the entry of that name where the list moved, else the
/// entry of that index, else the last; where the list is empty, the ground (plants) or the renderer (views). The result
/// always names an entry that exists.
Selection followSelection(const Selection& selection, const project::Project& project);

/// What shows the value at a path such as "patch.plants[2].gltf.path" (of a project::Problem); nothing for a path that
/// belongs nowhere, such as "name".
std::optional<Selection> selectionAt(const std::string& where, const project::Project& project);

}  // namespace sward::editor
