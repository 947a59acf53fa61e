#pragma once

#include "project/project.h"

#include <string>
#include <string_view>
#include <vector>

namespace sward::project {

/// A plant to start from.
struct PlantPreset {
  std::string name;         ///< for people: "Meadow grass"
  std::string description;  ///< one line
  Plant plant;  ///< called like the preset in lower case; density where it grows alone, and a usual share of a meadow
};

/// Grasses from low to tall, then flowers, then clovers. None needs a file.
const std::vector<PlantPreset>& plantPresets();

/// The plant of a preset by its name; the default plant when there is none of that name.
Plant plantFromPreset(std::string_view name);

}  // namespace sward::project
