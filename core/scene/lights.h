#pragma once

#include "base/result.h"
#include "scene/options.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::scene {

/// Unit vector toward a sun at these angles: x east, y north, z up; azimuth clockwise from north.
glm::dvec3 directionFromAngles(const SunAngles& angles);
SunAngles anglesFromDirection(const glm::dvec3& direction);

/// `count` unit vectors over the upper hemisphere, z descending, equal solid angles (spherical Fibonacci lattice,
/// Swinbank and Purser 2006): z_i = 1 - (i + 1/2) / count, azimuth i times the golden angle.
std::vector<glm::dvec3> fibonacciHemisphere(int count);

/// Lights of each ring from the lowest up, the zenith last. Azimuths are spread evenly, the first of the first ring in
/// the north. Invalid options (RingOptions' ranges) give no lights.
std::vector<glm::dvec3> ringLights(const RingOptions& options);

/// Lights along the sun's path, day by day in the order of the dates, morning to evening: the middles of `positions`
/// equal spans of the time that the sun spends above lowestDeg (the whole day where it never sets below that). Even in
/// time is even along the path. Days on which it never rises that high give no lights; nor do dates that do not exist.
std::vector<glm::dvec3> sunPathLights(const SunPathOptions& options);

/// The baked light directions; an error when there are none, or one points below the horizon or is not finite.
Result<std::vector<glm::dvec3>> lightDirections(const LightOptions& options);

}  // namespace sward::scene
