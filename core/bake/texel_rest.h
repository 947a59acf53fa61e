#pragma once

#include "wither/strand.h"
#include "wither/texel.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::bake {

/// A sward at rest as voxels, and the strands that they hang on: what takes long to make of what every weathering
/// degree is aged from. Its points (wither::texelToPoints) follow from it.
struct TexelRest {
  wither::Texel texel;
  std::vector<wither::Attachment> attachments;  ///< one a stored voxel, or none
  std::vector<wither::Strand> strands;
  std::vector<glm::vec3> soil;  ///< TexelBake::soil
};

}  // namespace sward::bake
