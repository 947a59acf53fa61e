#pragma once

#include "base/job.h"
#include "base/result.h"
#include "scene/patch.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// What a voxel of a periodic patch holds of its leaves, by index (z * columns + y) * columns + x, z from the ground
/// up.
struct LeafArea {
  static constexpr int kLines = 64;  ///< through a voxel along one axis, 8 x 8 of them

  int columns = 0, layers = 0;
  glm::dvec3 voxelM{0.0};  ///< size of a voxel, metres
  /// S = sum of area times n n^T over the voxel's volume, 1/m: xx, xy, xz, yy, yz, zz.
  std::vector<std::array<float, 6>> tensor;
  /// How many of the kLines lines along x, y and z meet a leaf within the voxel: what of it is opaque. S alone does not
  /// tell: leaves may hide one another or stand side by side, and both sides of a solid are one obstacle.
  std::vector<std::array<std::uint8_t, 3>> blocked;
};

/// Cuts every triangle exactly at the voxels' faces; what lies under the ground is left out, what rounding puts above
/// heightM belongs to the top layer. Alpha counts in S by its mean over each part of a triangle, in `blocked` as the
/// chance of a line. Triangles of closed parts (mesh::triangleSides) count half in S: it is the area of leaves, and a
/// leaf with two modelled sides is one leaf. Same bytes on any number of threads. Errors: a vertex or transform that is
/// not finite, a patch without a size, sizes below 1 or over 2^23 voxels; Error::cancelled().
Result<LeafArea> leafArea(std::shared_ptr<const scene::Patch> patch, int columns, int layers, const JobContext& job);

}  // namespace sward::trace
