#pragma once

#include "base/job.h"
#include "base/result.h"
#include "scene/patch.h"
#include "wither/strand.h"
#include "wither/texel.h"

#include <vector>

namespace sward::wither {

/// Specular of every voxel that is made from meshes, which say nothing of their gloss: a leaf's wax is alike
/// everywhere.
inline constexpr float kLeafSpecular = 0.3f;

/// A texel of a patch at rest, and what its voxels hang on.
struct VoxelisedPatch {
  Texel texel;
  std::vector<Attachment> attachments;  ///< one a stored voxel: of most of its area; empty without strands
};

/// Voxelises every triangle of a periodic patch, cut exactly at the voxels' faces, so that the densities integrate to
/// the leaf area (triangles of closed parts, mesh::triangleSides, count half, as in trace::leafArea) and no voxel that
/// a leaf passes through is left out. Tangents follow the rise of s over each triangle; without strands they are zero.
/// What lies under the ground or above the grid is left out. Same bytes on any number of threads. Errors: a vertex or
/// transform that is not finite, a patch of another side than the grid's; Error::cancelled().
Result<VoxelisedPatch> voxelise(const scene::Patch& patch, const TexelGrid& grid, const PatchStrands* strands,
                                const JobContext& job);

}  // namespace sward::wither
