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

/// The baked light directions; an error when there are none, or one points below the horizon or is not finite.
Result<std::vector<glm::dvec3>> lightDirections(const LightOptions& options);

}  // namespace sward::scene
