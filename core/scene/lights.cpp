#include "scene/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::scene {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;

}  // namespace

glm::dvec3 directionFromAngles(const SunAngles& angles) {
  const double azimuth = angles.azimuthDeg * kDegrees;
  const double elevation = angles.elevationDeg * kDegrees;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

SunAngles anglesFromDirection(const glm::dvec3& direction) {
  const double horizontal = std::hypot(direction.x, direction.y);
  double azimuth = horizontal > 0.0 ? std::atan2(direction.x, direction.y) / kDegrees : 0.0;
  if (azimuth < 0.0) azimuth += 360.0;
  return {azimuth, std::atan2(direction.z, horizontal) / kDegrees};
}

std::vector<glm::dvec3> fibonacciHemisphere(int count) {
  const double goldenAngle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<glm::dvec3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (i + 0.5) / count;
    const double radius = std::sqrt((1.0 - z) * (1.0 + z));
    directions.emplace_back(radius * std::cos(i * goldenAngle), radius * std::sin(i * goldenAngle), z);
  }
  return directions;
}

std::vector<glm::dvec3> ringLights(const RingOptions& options) {
  std::vector<glm::dvec3> directions;
  for (int ring = 0; ring < options.rings; ++ring) {
    const double part = options.rings > 1 ? static_cast<double>(ring) / (options.rings - 1) : 0.0;
    const double elevation = options.lowestDeg + part * (options.highestDeg - options.lowestDeg);
    for (int i = 0; i < options.lightsPerRing; ++i) {
      const double azimuth = 360.0 * (i + 0.5 * (ring % 2)) / options.lightsPerRing;
      directions.push_back(directionFromAngles({azimuth, elevation}));
    }
  }
  if (options.zenith) directions.emplace_back(0.0, 0.0, 1.0);
  return directions;
}

namespace {

Result<std::vector<glm::dvec3>> checkedRings(const RingOptions& rings) {
  const bool finite = std::isfinite(rings.lowestDeg) && std::isfinite(rings.highestDeg);
  if (!finite || rings.lowestDeg < 0.0 || rings.highestDeg > 90.0 || rings.lowestDeg > 90.0 || rings.highestDeg < 0.0) {
    return Error::badInput("a ring of lights is not between 0 and 90 degrees", "lights.rings",
                           "Grass is lit from above the horizon.");
  }
  std::vector<glm::dvec3> directions = ringLights(rings);
  if (directions.empty()) {
    return Error::badInput("there are no lights", "lights.rings", "Give at least one ring with one light.");
  }
  return directions;
}

Result<std::vector<glm::dvec3>> checkedSunPath(const SunPathOptions& path) {
  if (!(std::abs(path.latitudeDeg) <= 90.0) || !(path.lowestDeg >= 0.0 && path.lowestDeg < 90.0)) {
    return Error::badInput("there is no such latitude or lowest elevation", "lights.sunPath",
                           "Latitude is -90 to 90 degrees north; the lowest elevation 0 to less than 90.");
  }
  std::vector<glm::dvec3> directions = sunPathLights(path);
  if (directions.empty()) {
    return Error::badInput("there are no lights: on these dates the sun never stands higher than " +
                               std::to_string(static_cast<int>(path.lowestDeg)) + " degrees here",
                           "lights.sunPath", "Add a date in summer, lower lowestDeg, or choose another latitude.");
  }
  return directions;
}

}  // namespace

Result<std::vector<glm::dvec3>> lightDirections(const LightOptions& options) {
  if (options.pattern == LightPattern::Rings) return checkedRings(options.rings);
  if (options.pattern == LightPattern::SunPath) return checkedSunPath(options.sunPath);
  if (options.pattern == LightPattern::Fibonacci) {
    if (options.count < 1) {
      return Error::badInput("there are no lights", "lights.count", "Give at least 1; 15 is a good number.");
    }
    return fibonacciHemisphere(options.count);
  }
  if (options.directions.empty()) {
    return Error::badInput("there are no lights", "lights.directions",
                           "List directions, or use the pattern fibonacci.");
  }
  std::vector<glm::dvec3> directions;
  for (std::size_t i = 0; i < options.directions.size(); ++i) {
    const SunAngles& angles = options.directions[i];
    const std::string where = "lights.directions[" + std::to_string(i) + "]";
    if (!std::isfinite(angles.azimuthDeg) || !std::isfinite(angles.elevationDeg)) {
      return Error::badInput("the light's direction is not finite", where, "Give degrees.");
    }
    if (angles.elevationDeg < 0.0 || angles.elevationDeg > 90.0) {
      return Error::badInput("the light's elevation is not between 0 and 90 degrees", where,
                             "Grass is lit from above the horizon.");
    }
    directions.push_back(directionFromAngles(angles));
  }
  return directions;
}

}  // namespace sward::scene
