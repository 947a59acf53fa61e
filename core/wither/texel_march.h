#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <limits>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// The extinctions of a texel's voxels toward one direction, 1/m, for many marches along it. Of a voxel's leaves a
/// share has its normal, the others face everywhere: density (share |n.l| + (1 - share) / 2), the form of
/// trace::DominantVoxel, with the share from S.
class TexelExtinction {
 public:
  /// `l`: unit. Errors: Error::cancelled().
  static Result<TexelExtinction> create(const Texel& texel, const glm::dvec3& l, const JobContext& job);
  float operator[](std::size_t voxel) const { return m_extinction[voxel]; }
  float share(std::size_t voxel) const { return m_share[voxel]; }

 private:
  std::vector<float> m_extinction, m_share;
};

/// Part of a voxel's leaves that have its normal, in [0, 1]; 0 for a voxel without one.
double normalShare(const Voxel& voxel);
double extinction(const Voxel& voxel, const glm::dvec3& l);

/// Optical depth from a place (metres from the block's corner; the block repeats in x and y) along a unit direction to
/// where it leaves the block at the top or the bottom: the voxels' extinctions times the lengths in them, found exactly
/// (Amanatides and Woo 1987), empty bricks passed in one step. Ends once it is `enough`, and after kFarthestBlocks
/// blocks sideways. 0 from outside the height of the block.
double opticalDepth(const Texel& texel, const TexelExtinction& medium, const glm::dvec3& from, const glm::dvec3& l,
                    double enough = std::numeric_limits<double>::infinity());
inline constexpr double kFarthestBlocks = 64.0;

}  // namespace sward::wither
