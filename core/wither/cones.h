#pragma once

#include "scene/patch.h"

#include <cstdint>

#include <glm/glm.hpp>

namespace sward::wither {

/// The paper's blades of grass (TVT, section 2.1): thin cones at random places of a block. Lengths in metres. The
/// defaults, a hundred needles of fescue, give the paper's 5,000 points at proportion 6 in a grid of 256^3 over 0.3 m.
struct ConeOptions {
  int count = 100;
  double sideM = 1.0;
  double heightM = 0.3;                      ///< of the highest
  double variation = 0.3;                    ///< heights are uniform in [1 - variation, 1] of heightM: 0 to 1
  double radiusM = 0.00015;                  ///< at the root
  double leanDeg = 12.0;                     ///< largest inclination, 0 to 80; all directions alike
  int sides = 6;                             ///< of the cone's section, at least 3
  int segments = 8;                          ///< over its height, at least 1
  glm::vec3 colour{0.105f, 0.160f, 0.034f};  ///< reflectance, linear RGB
};

/// One model a cone, so that each may age on its own. Sections are horizontal, so that a leaning cone stands on the
/// ground with all of its foot. The foot is closed: a cone is a closed part, whose leaf area is half of its surface.
/// Places, heights and inclinations follow from the seed.
scene::Patch growCones(const ConeOptions& options, std::uint64_t seed);

}  // namespace sward::wither
