#pragma once

#include "bake/bake.h"
#include "base/job.h"
#include "base/result.h"
#include "project/project.h"
#include "report/ground_truth.h"
#include "scene/patch.h"

#include <memory>

/// Private to section texel_render: the blades behind a texel, and texels that differ in one step.
namespace sward::report {

/// The blades that a project's texels are made from, withered as meshes: every plant in its own way. Densities of
/// mingled samples are not in it (TexelBaker scales voxels by them).
Result<scene::Patch> witheredBlades(const project::Project& project);

/// A ground whose finest level is that of so many columns; null where it has no such level.
std::shared_ptr<const bake::GroundBake> coarserGround(const std::shared_ptr<const bake::GroundBake>& ground,
                                                      int columns);
/// The same ground of voxels without gloss.
std::shared_ptr<const bake::GroundBake> dullGround(const bake::GroundBake& ground, const JobContext& job);
/// The same ground voxelised from the blades as they are, without points between.
Result<std::shared_ptr<const bake::GroundBake>> voxelisedGround(const bake::GroundBake& ground,
                                                                const scene::Patch& blades, const JobContext& job);

/// Bytes of a ground of texels: what its voxels and soil see of the sky, and all.
struct TexelBytes {
  std::uint64_t sky = 0, total = 0;
};
TexelBytes bytesOf(const bake::TexelBake& texels);

}  // namespace sward::report
