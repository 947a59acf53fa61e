#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/strand.h"
#include "wither/texel.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// The point based structure (TVT paper, section 2.3): points that stand for a texel's leaves. Arrays of one length.
struct Points {
  std::vector<glm::vec3> positions;  ///< metres, beside the strand they hang on: they may leave the block sideways
  std::vector<glm::vec3> normals;    ///< unit; zero: a vein
  std::vector<glm::vec3> tangents;   ///< unit or zero
  /// Mean of n n^T over the leaves it stands for, in the order of Voxel::spread; trace at most 1. What a round stem
  /// keeps when the normals around it cancel.
  std::vector<std::array<float, 6>> spread;
  std::vector<glm::vec3> diffuse;
  std::vector<glm::vec3> transmitted;
  std::vector<float> specular;
  std::vector<float> areaM2;  ///< the leaf area a point stands for: its mass
  std::vector<Attachment> attachments;

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
  void resize(std::size_t count);
  double totalAreaM2() const;
};

/// Points at random places of a texel's voxels: floor(x) and by chance one more, x = `proportion` times the voxel's
/// leaf area over its face (proportion times density times edge). They inherit what the voxel holds and hang where it
/// hangs. Leaf area: a voxel with x >= 1 shares its own area among its points exactly. Where x < 1 a point, if there is
/// one, stands for 1 / x times the voxel's area, which is right in the mean; one common factor then makes the sum over
/// all of these voxels exact. A texel that holds something gives at least one point. `attachments`: one a voxel,
/// indices into `strands`, or empty: all points rest. Points stand beside their strand's vein where the block is
/// repeated, so that those of a strand that leaves the block hang together. Sorted by strand. Same points on any number
/// of threads. Errors: attachments that do not fit; a proportion not in (0, 1000]; Error::cancelled().
Result<Points> texelToPoints(const Texel& texel, std::span<const Attachment> attachments,
                             std::span<const Strand> strands, double proportion, std::uint64_t seed,
                             const JobContext& job);

/// Points nearer than `thresholdM` to a point before them that was not merged itself become one with the nearest such:
/// areas add, positions and attributes are means weighted by area, directions are made unit again or stay zero where
/// they cancel; it hangs where the first of them did. No two points that were farther apart than 2 thresholdM merge. A
/// threshold of 0 or less merges nothing. Time and memory follow the points.
Points mergePoints(const Points& points, double thresholdM);

/// Splats points into a texel: w = a exp(-d^2 / 2 sigma^2), d in voxels from the voxel's centre, over 3^3 voxels, or
/// 5^3 for sigma above 0.7, a such that each point's weights sum to 1. density = sum area w / volume, attributes are
/// means weighted by area w, directions unit or zero where they cancel to a thousandth (TVT paper, section 2.3, with
/// the decisions of science.md section 4). Periodic in x and y; above the top and under the ground points count as on
/// it, and layers that are not there take no weight, so that the leaf area is kept to 1e-5 of it. Sigma counts as at
/// least 0.1. Time follows the points and the bricks they touch. Same bytes on any number of threads. Errors: a point
/// that is not finite; the grid's; Error::cancelled().
Result<Texel> pointsToTexel(const Points& points, const TexelGrid& grid, double sigmaVoxels, const JobContext& job);

}  // namespace sward::wither
