#pragma once

#include "base/job.h"
#include "base/result.h"
#include "mesh/measure.h"
#include "scene/patch.h"
#include "trace/layers.h"
#include "trace/leaf_area.h"
#include "trace/options.h"
#include "trace/voxel_form.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// How a patch is cut into voxels, and how they are kept.
struct VoxelOptions {
  int columns = 128;  ///< voxels along each side of the patch
  int layers = 32;    ///< over its height
  enum class Form : std::uint8_t {
    Tensor,    ///< six floats: coarse voxels
    Dominant,  ///< five floats: a normal, its share, a density
    Packed     ///< the same in two bytes a voxel: pairs above one another share the normal (packPair)
  } form = Form::Dominant;

  /// As wide as a texel of the slices, two to a slab: finer ones did not follow shadows better, measured on five
  /// patches, since where a leaf lies in its texel is known to a part of it alone.
  static VoxelOptions of(const SamplingOptions& sampling) {
    return {sampling.sliceResolution, 2 * sampling.slices, Form::Dominant};
  }
};

/// The leaves of a periodic patch as a medium that light crosses (science.md section 1, marched transmittance), voxel
/// by voxel. What a voxel blocks of the light along the three axes is measured (LeafArea::blocked) and kept: its
/// extinctions along the axes times its size sum to the measured -ln(transmittance), whatever the form. So leaves that
/// hide one another, the two sides of a solid and walls that fill a voxel are as dark as they are, which the area alone
/// cannot tell: on a patch of solid plants it asked for 2.4 times the extinction of their area, on thin blades for 1.1.
/// Immutable.
class VoxelDensity {
 public:
  /// Errors: as leafArea. Same bytes on any number of threads.
  static Result<std::shared_ptr<const VoxelDensity>> create(std::shared_ptr<const scene::Patch> patch,
                                                            const VoxelOptions& options, const JobContext& job);

  const VoxelOptions& options() const { return m_options; }
  std::size_t voxels() const;
  const glm::dvec3& voxelM() const { return m_voxelM; }
  const scene::Patch& patch() const { return *m_patch; }
  std::uint64_t bytes() const;  ///< as stored

  /// Extinction in 1/m of the voxel at (x, y, layer from the ground up) toward the unit vector l.
  double extinction(int x, int y, int z, const glm::dvec3& l) const { return extinctionOf(index(x, y, z), l); }
  /// The same by its index, (z * columns + y) * columns + x.
  double extinctionOf(std::size_t voxel, const glm::dvec3& l) const;
  /// Of all voxels, for VoxelMarch. Errors: Error::cancelled().
  Result<std::vector<float>> extinctions(const glm::dvec3& l, const JobContext& job) const;
  /// Optical depth from a point (metres, in the patch square; 0 <= z) toward the unit vector l, l.z >= 0, out of the
  /// grass, `leadM` metres of the way left out: the leaf's own voxel must not shade it. Goes on until it is `enough`;
  /// ways that never leave the grass end where shadow rays end. Works out every voxel's extinction on its way: for many
  /// points of one light use extinctions() and VoxelMarch.
  double opticalDepth(const glm::dvec3& from, const glm::dvec3& l, double leadM,
                      double enough = std::numeric_limits<double>::infinity()) const;
  /// The dominant unit normal of the voxel that holds the point and the share of the area that has it (voxel_form.h);
  /// both zero where nothing is.
  struct Dominant {
    glm::dvec3 normal{0.0};
    double share = 0.0;
  };
  Dominant dominant(const glm::dvec3& at) const;

  /// The same medium in two bytes a voxel. Only of Dominant.
  std::shared_ptr<const VoxelDensity> packed() const;

  /// Which sides of the surface at a hit answer light: those of a solid by the light outside alone. A slab may cut a
  /// solid open, so that its viewer sees the inner side.
  enum class Seen : std::uint8_t { BothSides, Outside, Inside };
  Seen seen(const Hit& hit) const;

 private:
  VoxelDensity(std::shared_ptr<const scene::Patch> patch, const VoxelOptions& options);
  void fill(const LeafArea& area, const JobContext& job);
  std::size_t index(int x, int y, int z) const;
  DominantVoxel voxel(std::size_t index) const;

  std::shared_ptr<const scene::Patch> m_patch;
  std::vector<std::vector<mesh::Side>> m_sides;  ///< [model][triangle]
  VoxelOptions m_options;
  glm::dvec3 m_voxelM{0.0};
  std::vector<std::array<float, 6>> m_tensor;
  std::vector<DominantVoxel> m_dominant;
  std::vector<std::uint32_t> m_packed;  ///< [pair of layers][y][x]
  float m_largest = 0.0f;               ///< density, of packed ones
};

}  // namespace sward::trace
