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

/// How a patch is cut into voxels, and how they are kept.
struct VoxelOptions {
  int columns = 128;  ///< voxels along each side of the patch
  int layers = 16;    ///< over its height
  enum class Form : std::uint8_t {
    Tensor,   ///< all six numbers of S, floats: coarse voxels, and the yardstick
    Dominant  ///< a direction (3 bytes) and a density (1 byte, square-root coded): four bytes a voxel
  } form = Form::Dominant;
};

/// The leaf area of a periodic patch by voxels, as a medium that light crosses (science.md section 1, marched
/// transmittance): S = sum of area times n n^T per volume, in 1/m; extinction toward l from S.
class VoxelDensity {
 public:
  /// Errors: a vertex or a transform that is not finite, sizes below 1; Error::cancelled(). Alpha (masked or blended)
  /// counts by its mean over each part of a triangle. Same bytes on any number of threads.
  static Result<std::shared_ptr<const VoxelDensity>> create(std::shared_ptr<const scene::Patch> patch,
                                                            const VoxelOptions& options, const JobContext& job);
  virtual ~VoxelDensity() = default;

  virtual std::uint64_t bytes() const = 0;  ///< as stored
  /// Extinction in 1/m of the voxel at (x, y, layer from the ground up) toward the unit vector l.
  virtual double extinction(int x, int y, int z, const glm::dvec3& l) const = 0;
  /// Optical depth from a point (metres, in the patch square; 0 <= z) toward l, l.z >= 0, out of the grass, `lead`
  /// metres of the way left out: the leaf's own voxel must not shade it. Infinite ways (l.z = 0) end after some
  /// patches.
  virtual double opticalDepth(const glm::dvec3& from, const glm::dvec3& l, double lead) const = 0;
  /// The dominant unit normal of the voxel that holds the point, and the share of S's trace that it explains; zero
  /// where nothing is.
  struct Dominant {
    glm::dvec3 normal{0.0};
    double share = 0.0;
  };
  virtual Dominant dominant(const glm::dvec3& at) const = 0;
};

}  // namespace sward::trace
