#include "report/speed_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::report {
namespace {

constexpr double kEyeM = 1.7;

}  // namespace

SpeedView grazingView(double tileSideM) {
  const double distanceM = 0.5 * kTilesInView * tileSideM;
  return {"grazing", std::asin(std::min(kEyeM / distanceM, 1.0)) * 180.0 / std::numbers::pi, distanceM};
}

scene::View viewOf(const SpeedView& view) {
  const double slant = view.slantDeg * std::numbers::pi / 180.0;
  scene::View out;
  out.name = view.name;
  out.target = glm::dvec3(0.13, 0.07, 0.0);
  // Looking a little off north, so that no family of planes lies along the picture.
  const double across = std::cos(slant) * view.distanceM;
  out.position = out.target + glm::dvec3(-0.3 * across, -std::sqrt(0.91) * across, std::sin(slant) * view.distanceM);
  out.focalLengthMm = kSpeedFocalLengthMm;
  return out;
}

Result<scene::Camera> cameraOf(const SpeedView& view) {
  return scene::cameraFromView(viewOf(view));
}

}  // namespace sward::report
