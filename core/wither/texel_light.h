#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// What lights a texel: a sun without a size and a sky of one radiance.
struct TexelLight {
  glm::dvec3 toSun{0.0, 0.0, 1.0};  ///< unit
  glm::dvec3 sunIrradiance{0.0};    ///< on a plane that faces the sun, linear RGB
  glm::dvec3 skyRadiance{0.0};      ///< mean over the upper hemisphere
};

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

/// Radiance that a voxel's leaves send to an eye on their normal's side and on the other: sunlight that came through
/// the texel to them (transmittance exp(-tau), science.md section 1), reflected where the sun stands on the eye's side,
/// else transmitted; and skylight in the same way.
struct LitVoxel {
  glm::vec3 front{0.0f}, back{0.0f};  ///< linear RGB radiance
  float sun = 0.0f;                   ///< transmittance toward the sun, 0 to 1; 0 with the sun under the horizon
};
struct LitTexel {
  std::vector<LitVoxel> voxels;  ///< one a voxel of the texel
  std::vector<float> groundSun;  ///< transmittance from the ground toward the sun, [y][x]
};
/// One sweep toward the sun (sweepDepths): what stands between, from one voxel out of each voxel's middle on. `sky`:
/// sweptSky of the texel. Errors: a sky of another texel; Error::cancelled().
Result<LitTexel> lightTexel(const Texel& texel, const TexelSky& sky, const TexelLight& light, const JobContext& job);

}  // namespace sward::wither
