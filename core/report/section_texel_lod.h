#pragma once

#include "report/section.h"
#include "scene/patch.h"

#include <memory>
#include <string>
#include <vector>

namespace sward::report {

/// What section `texel_lod` is measured on.
struct TexelLodSize {
  int conesColumns = 256;
  int cones = 700;  ///< the paper's densest mix
  int patchColumns = 128;
  double patchSideM = 0.5;  ///< at most, of the project's patch: a voxel is then as large as one of 256 over a metre
  int coarsest = 32;
  std::vector<double> elevationsDeg{90.0, 60.0, 45.0, 30.0, 15.0};
  int azimuths = 3;
  int marches = 64;  ///< through a texel: along a side of the ground, for every direction
  int rays = 192;    ///< through the triangles, the same
};

/// Section `texel_lod`: how much light levels of detail let through, from places all over the block upward, against
/// rays through the triangles. Of `cones` and
/// of `patch` (the project's plants, of which it needs no graphics) rows:
/// - NAME_traced: the rays themselves (Embree): time, rays a second;
/// - NAME_as_voxelised: the finest level as voxelise made it;
/// - NAME: levels that keep opacity (wither::opaque, then wither::halved), time_ms of making the level from the one
///   before, bytes in memory;
/// - NAME_mean_density: levels of the same finest one that keep the mean density instead.
/// Errors are of the mean transmittance from everywhere in the block upward, over the directions; change_rmse and
/// change_bias of it against the finest opaque level's, which is what a change of level shows. Parameters: `columns`,
/// `layers`, `voxels`; `elevations_deg` with `transmittance` and `true_transmittance`, means over the azimuths;
/// `noise`: largest standard error of a direction's mean, of both, as if rays were independent.
Result<Section> texelLodSection(const TexelLodSize& size, const project::Project& project, const JobContext& job);
Result<Section> texelLodSection(const SectionInput& input, const JobContext& job);

}  // namespace sward::report
