#pragma once

#include "bake/bake.h"
#include "render/renderer.h"
#include "report/ground_truth.h"
#include "report/row.h"

#include <memory>
#include <vector>

/// Private to section grassland: what single steps cost.
namespace sward::report {

/// The project's ground, and others in which one step is exact; null where there is none to compare with.
struct CauseGrounds {
  std::shared_ptr<const bake::GroundBake> project;
  std::shared_ptr<const bake::GroundBake> whole;  ///< no coefficients cut off; null where the project cuts off none
  std::shared_ptr<const bake::GroundBake> fine;   ///< the same with 16 bits
  std::shared_ptr<const bake::GroundBake> exact;  ///< light traced for the very sun, 16 bits
};
/// Errors: those of a bake.
Result<CauseGrounds> bakeCauseGrounds(const project::Project& project, std::shared_ptr<const bake::GroundBake> ground,
                                      bake::Baker& baker, const JobContext& job);

struct CauseInput {
  render::Renderer& renderer;  ///< its ground is replaced, and the project's own put back
  const GroundTruth& truth;
  const CauseGrounds& grounds;
  render::Frame frame;
  int samples = 8;  ///< of each of two references
};
/// Rows cause_range_clamp, cause_quantisation, cause_fit, cause_layers, cause_blending, cause_tiling, cause_sky,
/// cause_sun_disc and cause_bounces; one whose ground is missing or lays its tiles otherwise is left out.
Result<std::vector<Row>> causeRows(const CauseInput& input, const JobContext& job);

}  // namespace sward::report
