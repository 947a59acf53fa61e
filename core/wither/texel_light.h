#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// What lights a texel: a sun without a size and a sky of one radiance.
struct TexelLight {
  glm::dvec3 toSun{0.0, 0.0, 1.0};  ///< unit
  glm::dvec3 sunIrradiance{0.0};    ///< on a plane that faces the sun, linear RGB
  glm::dvec3 skyRadiance{0.0};      ///< mean over the upper hemisphere
};

/// Irradiance that a unit beam from l gives the two sides of leaves of which a share has the normal; the others face
/// every way, so that half of the mean |n.l| = 1/2 falls on either side.
struct LeafSides {
  float front = 0.0f, back = 0.0f;
};
inline LeafSides leafSides(const glm::vec3& normal, float share, const glm::vec3& l) {
  const float cosine = normal.x * l.x + normal.y * l.y + normal.z * l.z;
  const float any = 0.25f * (1.0f - share);
  return {share * std::max(cosine, 0.0f) + any, share * std::max(-cosine, 0.0f) + any};
}

/// How much of the sky the sides of a texel's voxels see, whatever the light: cosine-weighted shares of the upper
/// hemisphere over the side that the normal points to and over the other (of a leaf in the open, of normal n:
/// (1 + n.z) / 2 and (1 - n.z) / 2); and of the ground under every column.
struct TexelSky {
  std::vector<float> front, back;  ///< one a voxel
  std::vector<float> ground;       ///< [y][x]
};
/// From fifteen directions of the upper hemisphere (equal cosine-weighted parts, the same for every voxel), each one
/// sweep (sweepDepths). Errors: Error::cancelled().
Result<TexelSky> sweptSky(const Texel& texel, const JobContext& job);

/// How much of the sun reaches a texel: transmittances exp(-tau) (science.md section 1), 0 to 1; all 0 with the sun at
/// or under the horizon.
struct SunReach {
  std::vector<float> voxels;  ///< one a voxel, from one voxel out of its middle on (sweepDepths)
  std::vector<float> ground;  ///< from the middle of each column's foot, [y][x]
};
/// How much of the sun comes on through a voxel's own leaves: those that have its normal do not shade themselves, but
/// leaves that face every way are many and shade one another, as if the way from the voxel's middle to one voxel out
/// were all as dense. `share`: normalShare(voxel). `l`: unit.
float throughOwnLeaves(const TexelGrid& grid, const Voxel& voxel, float share, const glm::vec3& l);
/// One sweep. `toSun`: unit. Errors: Error::cancelled().
Result<SunReach> sunReach(const Texel& texel, const glm::dvec3& toSun, const JobContext& job);

/// Radiance that a voxel's leaves send to an eye on their normal's side and on the other: sunlight that reaches them,
/// reflected where the sun stands on the eye's side, else transmitted; and skylight in the same way.
struct LitVoxel {
  glm::vec3 front{0.0f}, back{0.0f};  ///< linear RGB radiance
};
class LeafShading {
 public:
  explicit LeafShading(const TexelLight& light)
      : m_toSun(light.toSun), m_sun(light.sunIrradiance / std::numbers::pi), m_sky(light.skyRadiance) {}
  /// `share`: normalShare(voxel). `skyFront`, `skyBack`: its TexelSky. `sun`: its SunReach.
  LitVoxel operator()(const Voxel& voxel, float share, float skyFront, float skyBack, float sun) const {
    const LeafSides sides = leafSides(voxel.normal, share, m_toSun);
    // Irradiance over pi of either side; the sky's radiance times the share of the sky that a side sees.
    const glm::vec3 front = m_sun * (sun * sides.front) + m_sky * skyFront;
    const glm::vec3 back = m_sun * (sun * sides.back) + m_sky * skyBack;
    return {voxel.diffuse * front + voxel.transmitted * back, voxel.diffuse * back + voxel.transmitted * front};
  }
  /// Radiance that the sun gives white leaves of both sides together: its part in front + back, over diffuse +
  /// transmitted.
  glm::vec3 fromSun(const Voxel& voxel, float share, float sun) const {
    const LeafSides sides = leafSides(voxel.normal, share, m_toSun);
    return m_sun * (sun * (sides.front + sides.back));
  }

 private:
  glm::vec3 m_toSun, m_sun, m_sky;
};

}  // namespace sward::wither
