#pragma once

#include <cmath>

#include <glm/glm.hpp>

/// What the picture of a ground has beside its plants and their light, for whatever draws it: the renderer's shaders
/// repeat this page (shaders/ground/constants.glsl, surface.glsl, sky.glsl).
namespace sward::scene {

inline constexpr double kBendM = 19.0;          ///< length of the waves that bend the tiles' grid
inline constexpr double kBendPhaseTurns = 0.4;  ///< of the shift along y against that along x
/// Nearer to the eye than this the layers of a shell are left out, and a ray's bend is that of a place so far away.
inline constexpr double kNearestM = 0.12;

inline constexpr double kSunDiscRad = 0.00465;  ///< angular radius of the disc as it is drawn
inline constexpr double kSunLimbRad = 0.0007;   ///< half the width of its soft edge
inline constexpr double kSunDiscGain =
    60.0;  ///< the disc's radiance over the sun's irradiance, far under the real 14700

/// A sine's stand-in: a smoothed triangle in [-1, 1], its period one turn.
inline double bendWave(double turns) {
  const double triangle = std::abs(turns - std::floor(turns) - 0.5) * 4.0 - 1.0;
  return triangle * (1.5 - 0.5 * triangle * triangle);
}
/// The shift of the tiles' grid at a place of the world: what is seen there stands at place + shift on the straight
/// grid. Each axis is moved by the place on the other.
inline glm::dvec2 gridBend(const glm::dvec2& placeM, double largestM) {
  return largestM * glm::dvec2(bendWave(placeM.y / kBendM), bendWave(placeM.x / kBendM + kBendPhaseTurns));
}

/// How much of the disc's radiance is seen at an angle from its centre, as GLSL's smoothstep has it.
inline double sunDiscShare(double angleRad) {
  const double low = kSunDiscRad - kSunLimbRad, high = kSunDiscRad + kSunLimbRad;
  const double t = glm::clamp((angleRad - low) / (high - low), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

}  // namespace sward::scene
