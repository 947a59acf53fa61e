#pragma once

#include "base/job.h"
#include "base/result.h"
#include "project/project.h"
#include "render/renderer.h"
#include "report/ground_truth.h"
#include "report/row.h"
#include "scene/sun_sky.h"

#include <span>
#include <string>
#include <vector>

/// Private to section texel_render: how a way to draw answers to where the sun stands.
namespace sward::report {

/// What is drawn and its truth; both are lit anew, and left in the daylight of `daylight`.
struct SunSubject {
  std::string method;
  render::Renderer& renderer;
  GroundTruth& truth;
  render::Frame frame;  ///< with the method to draw by
};
struct SunInput {
  const project::Project& project;
  scene::Daylight daylight;
  int samples = 16;  ///< of the references
};

/// Rows METHOD_sun_behind, _across and _against: the project's sun at its height, in the back of the eye, from the
/// right, and ahead. Exposure stays. Errors of linear radiance, and relative_bias, reference_mean, sun_azimuth_deg,
/// sun_elevation_deg and phase_deg (between the directions to the eye and to the sun) in the parameters.
Result<std::vector<Row>> sunRows(const SunInput& input, const SunSubject& subject, const JobContext& job);

}  // namespace sward::report
