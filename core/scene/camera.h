#pragma once

#include "base/result.h"
#include "scene/options.h"

#include <glm/glm.hpp>

namespace sward::scene {

inline constexpr double kSensorWidthMm = 36.0;

/// A pinhole camera in world space; right, up and forward are orthonormal.
struct Camera {
  glm::dvec3 position{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0};
  glm::dvec3 up{0.0, 0.0, 1.0};
  glm::dvec3 forward{0.0, 1.0, 0.0};
  double tanHalfWidth = 0.5;  ///< tangent of half the horizontal field of view

  /// Unit direction through image point (x, y), both in [0, 1] from the top left, for an image width / height of
  /// `aspect`.
  glm::dvec3 rayDirection(double x, double y, double aspect) const;
};

/// The view's camera. Looking straight up or down, north is up in the picture. Errors: position equals target, a value
/// that is not finite, a focal length of 0.
Result<Camera> cameraFromView(const View& view);

}  // namespace sward::scene
