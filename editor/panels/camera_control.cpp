#include "panels/camera_control.h"

#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::editor {
namespace {

constexpr double kSteepest = 1.565;  ///< radians from the level; short of the vertical, so that "up" stays up
constexpr double kLeastDistanceM = 0.05;
constexpr double kMostDistanceM = 2.0e4;
constexpr double kHalfTurn = std::numbers::pi;

struct Polar {
  double distance = 1.0, azimuth = 0.0, elevation = 0.0;  ///< of a vector; azimuth clockwise from north
};

Polar polarOf(const glm::dvec3& v) {
  Polar polar;
  polar.distance = std::max(glm::length(v), 1e-9);
  polar.azimuth = std::atan2(v.x, v.y);
  polar.elevation = std::asin(std::clamp(v.z / polar.distance, -1.0, 1.0));
  return polar;
}

glm::dvec3 vectorOf(const Polar& p) {
  const double level = p.distance * std::cos(p.elevation);
  return {level * std::sin(p.azimuth), level * std::cos(p.azimuth), p.distance * std::sin(p.elevation)};
}

double tanHalfWidth(const scene::View& view) {
  return 0.5 * scene::kSensorWidthMm / view.focalLengthMm;
}

/// Lifts the whole view when its eye is under the ground.
void keepAboveGround(scene::View& view) {
  const double lift = kLeastEyeM - view.position.z;
  if (lift <= 0.0) return;
  view.position.z += lift;
  view.target.z += lift;
}

}  // namespace

void orbit(scene::View& view, double right, double up) {
  Polar eye = polarOf(view.position - view.target);
  eye.azimuth += right * kHalfTurn;
  // The eye itself stays above the ground while the target stays where it is.
  const double lowest = std::asin(std::clamp((kLeastEyeM - view.target.z) / eye.distance, -1.0, 1.0));
  eye.elevation = std::clamp(eye.elevation + up * kHalfTurn, std::min(lowest, kSteepest), kSteepest);
  view.position = view.target + vectorOf(eye);
  keepAboveGround(view);
}

void lookAround(scene::View& view, double right, double up) {
  Polar gaze = polarOf(view.target - view.position);
  gaze.azimuth += right * kHalfTurn;
  gaze.elevation = std::clamp(gaze.elevation + up * kHalfTurn, -kSteepest, kSteepest);
  view.target = view.position + vectorOf(gaze);
}

void pan(scene::View& view, double right, double up, double aspect) {
  const auto camera = scene::cameraFromView(view);
  if (!camera.ok()) return;
  const double distance = glm::length(view.target - view.position);
  const double heightM = 2.0 * distance * camera->tanHalfWidth / aspect;
  const glm::dvec3 shift = (-right * camera->right + up * camera->up) * heightM;
  view.position += shift;
  view.target += shift;
  keepAboveGround(view);
}

void dolly(scene::View& view, double steps) {
  const glm::dvec3 away = view.position - view.target;
  const double distance = std::max(glm::length(away), 1e-9);
  const double wanted = std::clamp(distance * std::pow(0.9, steps), kLeastDistanceM, kMostDistanceM);
  view.position = view.target + away * (wanted / distance);
  keepAboveGround(view);
}

void fly(scene::View& view, double forward, double right, double up) {
  const Polar gaze = polarOf(view.target - view.position);
  const glm::dvec3 ahead{std::sin(gaze.azimuth), std::cos(gaze.azimuth), 0.0};
  const glm::dvec3 aside{ahead.y, -ahead.x, 0.0};
  const glm::dvec3 shift = ahead * forward + aside * right + glm::dvec3(0.0, 0.0, up);
  view.position += shift;
  view.target += shift;
  keepAboveGround(view);
}

void frame(scene::View& view, const glm::dvec3& centre, double radiusM, double aspect) {
  const glm::dvec3 away = view.position - view.target;
  const double across = tanHalfWidth(view) / std::max(1.0, aspect);
  const double distance =
      std::clamp(std::max(radiusM, 1e-3) / std::sin(std::atan(across)), kLeastDistanceM, kMostDistanceM);
  view.target = centre;
  view.position = centre + away * (distance / std::max(glm::length(away), 1e-9));
  keepAboveGround(view);
}

std::optional<glm::dvec3> groundPoint(const scene::View& view, double x, double y, double aspect) {
  const auto camera = scene::cameraFromView(view);
  if (!camera.ok()) return std::nullopt;
  const glm::dvec3 ray = camera->rayDirection(x, y, aspect);
  if (!(ray.z < -1e-6)) return std::nullopt;
  return camera->position - ray * (camera->position.z / ray.z);
}

void look(scene::View& view, StandardView from, double distanceM) {
  Polar eye;
  eye.distance = distanceM;
  if (from == StandardView::Top) eye = {distanceM, kHalfTurn, kSteepest};
  if (from == StandardView::Front) eye = {distanceM, kHalfTurn, 0.15};
  if (from == StandardView::Side) eye = {distanceM, 0.5 * kHalfTurn, 0.15};
  view.position = view.target + vectorOf(eye);
  keepAboveGround(view);
}

}  // namespace sward::editor
