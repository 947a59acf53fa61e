#pragma once

#include "base/job.h"
#include "base/result.h"
#include "trace/patch_scene.h"
#include "wither/texel.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::report {

/// The texel of half the voxels whose density and spread are means over the eight children, as if leaves were spread
/// evenly: what levels of detail are compared with. Directions and materials are left out. Errors: a grid whose half is
/// not of whole bricks.
Result<wither::Texel> meanDensityHalved(const wither::Texel& texel);

/// What is let through from everywhere in a block upward, along each of some directions.
struct LetThrough {
  std::vector<double> mean;   ///< one a direction, 0 to 1
  std::vector<double> error;  ///< standard error of the mean, as if rays were independent
};
/// `side` x `side` rays a direction, one over each cell of the ground, at random places of it and at heights evenly
/// from bottom to top.
/// Directions: unit, z > 0. Errors: Error::cancelled().
Result<LetThrough> marchedThrough(const wither::Texel& texel, const std::vector<glm::dvec3>& directions, int side,
                                  const JobContext& job);
Result<LetThrough> tracedThrough(const trace::PatchScene& scene, const std::vector<glm::dvec3>& directions, int side,
                                 const JobContext& job);

}  // namespace sward::report
