#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// The leaf area that a voxel turns to the unit vector l, per volume, 1/m: sqrt(l^T (5 tr S S + 3 S^2) l / 8).
///
/// SGGX (Heitz et al. 2015) sees a distribution of leaves as an ellipsoid, whose section toward l is sqrt(l^T P l). P
/// shares its axes with S and has the squares of the projected areas E|n.e| along them as eigenvalues. Of S / tr S they
/// are known to be 1 for one normal (eigenvalue 1), 1/4 for normals all around (1/3), 4/pi^2 for normals around an axis
/// (1/2) and 0 for none (0): x (5 + 3 x) / 8 meets all of them, the third to 0.3 %, and needs no axes. So it is exact
/// for one leaf and for leaves without direction, where sqrt((l^T S l) tr S) is up to 15 % too high.
///
/// Density beyond the trace of S is that of leaves without a normal: they count as turned all around.
double extinction(const Voxel& voxel, const glm::dvec3& l);

/// The same for many directions, in single precision and for densities up to 1e18: extinction() is the root of the form
/// l^T P l with P = (5 tr S S + 3 S^2) / 8: xx, xy, xz, yy, yz, zz, 1/m^2. Off by 1e-6 of the voxel's density, and by
/// 1e-3 of it where the form cancels (a leaf seen edge on).
std::array<float, 6> sectionForm(const Voxel& voxel);

/// The same for one direction alone, of densities up to 1e18.
inline float sectionToward(const Voxel& voxel, const glm::vec3& l) {
  const std::array<float, 6>& s = voxel.spread;
  const float known = s[0] + s[3] + s[5], around = std::max(voxel.density - known, 0.0f), third = around / 3.0f;
  const glm::vec3 turned((s[0] + third) * l.x + s[1] * l.y + s[2] * l.z, s[1] * l.x + (s[3] + third) * l.y + s[4] * l.z,
                         s[2] * l.x + s[4] * l.y + (s[5] + third) * l.z);
  const float along = l.x * turned.x + l.y * turned.y + l.z * turned.z;
  const float square = turned.x * turned.x + turned.y * turned.y + turned.z * turned.z;
  return std::sqrt(std::max(0.625f * (known + around) * along + 0.375f * square, 0.0f));
}

/// The extinctions of a texel's voxels toward one direction, for many marches along it.
class TexelExtinction {
 public:
  /// `l`: unit. Errors: Error::cancelled().
  static Result<TexelExtinction> create(const Texel& texel, const glm::dvec3& l, const JobContext& job);
  float operator[](std::size_t voxel) const { return m_extinction[voxel]; }

 private:
  std::vector<float> m_extinction;
};

/// Part of a voxel's leaves that have its normal, in [0, 1]: of S / tr S = share n n^T + (1 - share) I / 3 the entry
/// n S n is (1 + 2 share) / 3. 0 for a voxel without a normal.
double normalShare(const Voxel& voxel);

/// From a point (metres; x and y wrap) along a unit direction until out of the grid above or below: the sum of
/// extinction times the exact length in every voxel (Amanatides and Woo 1987; empty bricks are passed in one step).
/// What is within the grid's height counts alone, wherever the point is. Ends once it is `enough`. Directions with |z|
/// under 1e-6 end after 64 sides, all others after 4096.
double opticalDepth(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& direction,
                    double enough = std::numeric_limits<double>::infinity());
/// The same with the extinctions toward `direction` at hand, and no farther than `farthestM`.
double opticalDepth(const Texel& texel, const TexelExtinction& medium, const glm::dvec3& origin,
                    const glm::dvec3& direction, double enough = std::numeric_limits<double>::infinity(),
                    double farthestM = std::numeric_limits<double>::infinity());
/// exp(-opticalDepth), in [0, 1].
double transmittance(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace sward::wither
