#include "panels/view_edits.h"

#include "bake/withering.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <algorithm>
#include <cmath>

namespace sward::editor {
namespace {

constexpr double kLowestDeg = -10.0, kHighestDeg = 90.0;

}  // namespace

scene::SunAngles sunAnglesOf(const project::Project& project) {
  if (!project.sun.byMoment) return project.sun.angles;
  const auto direction = scene::sunDirection(project.sun);
  return direction.ok() ? scene::anglesFromDirection(*direction) : project.sun.angles;
}

void turnSun(project::Project& project, double azimuthDeg, double elevationDeg) {
  scene::SunAngles angles = sunAnglesOf(project);
  angles.azimuthDeg = std::fmod(std::fmod(angles.azimuthDeg + azimuthDeg, 360.0) + 360.0, 360.0);
  angles.elevationDeg = std::clamp(angles.elevationDeg + elevationDeg, kLowestDeg, kHighestDeg);
  project.sun.byMoment = false;
  project.sun.angles = angles;
}

bool drawsTexels(const project::Project& project) {
  return bake::drawnAsTexels(project);
}

render::ViewMode shownMode(const UiState& ui, const project::Project& project) {
  return drawsTexels(project) ? render::ViewMode{} : ui.mode;
}

CompareState shownComparison(const UiState& ui, const project::Project& project) {
  CompareState compare = ui.compare;
  if (drawsTexels(project)) compare.other = CompareState::Other::Reference;
  return compare;
}

}  // namespace sward::editor
