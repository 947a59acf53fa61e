#include "render/frame_plan.h"

#include <cmath>

namespace sward::render {

Result<scene::Daylight> daylightOf(const project::Project& project) {
  SWARD_ASSIGN(const glm::dvec3 sun, scene::sunDirection(project.sun));
  return scene::Daylight(sun, project.sun, project.sky);
}

Result<Frame> planFrame(const project::Project& project, const scene::View& view, const scene::Daylight& daylight,
                        double addedEv) {
  Frame frame;
  SWARD_ASSIGN(frame.camera, scene::cameraFromView(view));
  frame.width = project.output.width;
  frame.height = project.output.height;
  frame.exposure = daylight.autoExposure() * std::exp2(view.exposureEv + addedEv);
  frame.options = project.render;
  return frame;
}

}  // namespace sward::render
