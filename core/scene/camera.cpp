#include "scene/camera.h"

#include <cmath>

namespace sward::scene {
namespace {

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

glm::dvec3 Camera::rayDirection(double x, double y, double aspect) const {
  const double across = (2.0 * x - 1.0) * tanHalfWidth;
  const double upward = (1.0 - 2.0 * y) * tanHalfWidth / aspect;
  return glm::normalize(forward + across * right + upward * up);
}

Result<Camera> cameraFromView(const View& view) {
  const std::string where = "view \"" + view.name + "\"";
  if (!finite(view.position) || !finite(view.target)) {
    return Error::badInput("position or target is not finite", where, "Give numbers in metres.");
  }
  if (!(view.focalLengthMm > 0.0) || !std::isfinite(view.focalLengthMm)) {
    return Error::badInput("the focal length is not above 0", where, "Give millimetres, such as 35.");
  }
  const glm::dvec3 look = view.target - view.position;
  if (!(glm::length(look) > 1e-9)) {
    return Error::badInput("position and target are the same point", where, "Move one of them.");
  }
  Camera camera;
  camera.position = view.position;
  camera.forward = glm::normalize(look);
  // Looking along the vertical, "up" in the picture is north: the world's up has no direction there.
  const bool vertical = std::hypot(camera.forward.x, camera.forward.y) < 1e-6;
  const glm::dvec3 guide = vertical ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
  camera.right = glm::normalize(glm::cross(camera.forward, guide));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.tanHalfWidth = 0.5 * kSensorWidthMm / view.focalLengthMm;
  return camera;
}

}  // namespace sward::scene
