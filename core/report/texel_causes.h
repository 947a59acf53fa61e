#pragma once

#include "bake/ground_bake.h"
#include "base/job.h"
#include "base/result.h"
#include "project/project.h"
#include "render/renderer.h"
#include "report/ground_truth.h"
#include "report/row.h"

#include <memory>
#include <span>
#include <vector>

/// Private to section texel_render: what single steps cost.
namespace sward::report {

/// Grounds that differ from the project's in one step; each is lit once and serves all views.
struct TexelCauseGrounds {
  std::shared_ptr<const bake::GroundBake> project, dull, voxelised;
};
Result<TexelCauseGrounds> texelCauseGrounds(const project::Project& project,
                                            std::shared_ptr<const bake::GroundBake> ground, const JobContext& job);

struct TexelCauseInput {
  render::Renderer& renderer;  ///< its ground is replaced
  const GroundTruth& truth;
  const TexelCauseGrounds& grounds;
  std::span<const render::Frame> frames;  ///< of one size; the method is Texels
  int samples = 6;                        ///< of each of two references
};
/// Rows cause_voxels, cause_light, cause_sky, cause_sun_disc, cause_bounces, cause_points and cause_highlight of every
/// frame.
Result<std::vector<std::vector<Row>>> texelCauseRows(const TexelCauseInput& input, const JobContext& job);

}  // namespace sward::report
