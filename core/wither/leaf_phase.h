#pragma once

#include <glm/glm.hpp>

namespace sward::wither {

/// Of leaves that face every way: the mean of |n.l| |n.v| over those that show the sun (l) and the eye (v) the same
/// side, and over those that show them different ones, of all. With b the angle between l and v, `cosine` its cosine:
/// ((pi - b) cos b + sin b) / 3 pi and (sin b - b cos b) / 3 pi (integrals over the lune of normals between l and v).
struct LeafSidesSeen {
  double same = 0.0, different = 0.0;
};
LeafSidesSeen leafSidesSeen(double cosine);

/// What such leaves send to the eye over what they send in the mean over all eyes, if they let through `passed` times
/// what they reflect: 8 (same + passed different) / (1 + passed). With the sun behind the eye the lit sides are seen,
/// against it those that are lit from behind. 0 <= passed.
double leafPhase(double cosine, double passed);

/// Means over a level's leaves, by which a renderer that keeps one radiance a side applies leafPhase() to a ray as a
/// whole, times 1 + unordered sun (leafPhase - 1): what voxels keep by their normals knows where the eye stands
/// already.
struct PhaseMeans {
  double unordered = 0.0;  ///< part of the leaves that face every way: 1 - normalShare
  glm::dvec3 passed{1.0};  ///< transmittance over reflectance, linear RGB
  glm::dvec3 sun{0.0};     ///< part of their radiance that is the sun's, linear RGB
};

}  // namespace sward::wither
