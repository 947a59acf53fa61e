#pragma once

#include "wither/points.h"
#include "wither/strand.h"
#include "wither/texel.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::bake {

/// What every weathering degree of a sward is aged from: its blades at rest as points, in the grid that they become
/// voxels of.
struct TexelRest {
  wither::TexelGrid grid;
  std::vector<wither::Strand> strands;
  wither::Points points;
  std::vector<glm::vec3> soil;  ///< TexelBake::soil
};

}  // namespace sward::bake
