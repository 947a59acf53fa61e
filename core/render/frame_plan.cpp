#include "render/frame_plan.h"

#include <cmath>
#include <sstream>
#include <utility>

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

Result<terrain::Terrain> terrainOf(const project::Project& project, const JobContext& job) {
  return terrain::makeTerrain(project.terrain, project.folder, job);
}

std::vector<project::Problem> terrainProblems(const project::Project& project) {
  const Result<terrain::Terrain> made = terrainOf(project);
  if (!made) {
    const Error& error = made.error();
    return {{true, error.where.empty() ? "terrain" : error.where, error.what, error.remedy}};
  }
  std::vector<project::Problem> problems;
  for (const std::string& warning : made->warnings) problems.push_back({false, "terrain.heightmap", warning, ""});
  if (!made->field) return problems;
  for (std::size_t i = 0; i < project.views.size(); ++i) {
    const glm::dvec3& eye = project.views[i].position;
    const double ground = made->field->height(glm::dvec2(eye));
    if (eye.z >= ground) continue;
    std::ostringstream height;
    height.imbue(std::locale::classic());
    height.precision(4);
    height << ground;
    problems.push_back({false, "views[" + std::to_string(i) + "].position",
                        "the view stands below the ground, which is at " + height.str() + " m there",
                        "Raise it; it is drawn from the ground otherwise."});
  }
  return problems;
}

}  // namespace sward::render
