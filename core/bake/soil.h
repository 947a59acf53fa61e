#pragma once

#include "base/result.h"
#include "project/project.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::bake {

/// Reflectance of the soil at each column of a periodic resolution x resolution image (rows along +y): the texture, or
/// the colour with a seeded variation over centimetres. In [0, 1].
Result<std::vector<glm::vec3>> soilColours(const project::Project& project, int resolution);

}  // namespace sward::bake
