#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

/// Private to core/trace: one voxel of a medium of leaves, and how it is stored.
namespace sward::trace {

/// Leaves of one normal, a share of the area, among leaves of every direction alike. Extinction toward the unit vector
/// l is the leaf area that they turn to it per volume, density (share |normal.l| + (1 - share) / 2): exact for a single
/// leaf and for leaves without direction (E|n.l| = 1/2 over the sphere).
struct DominantVoxel {
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit; of either sign
  float share = 0.0f;                  ///< in [0, 1]
  float density = 0.0f;                ///< 1/m

  float extinction(const glm::vec3& l) const;
};

/// Of S = share n n^T + (1 - share) I / 3 the largest eigenvalue is (1 + 2 share) / 3 of the trace: the share of any
/// tensor is taken from that. Density: the trace.
DominantVoxel dominantOf(const std::array<float, 6>& tensor);
/// share n n^T + (1 - share) I / 3, times density.
std::array<float, 6> tensorOf(const DominantVoxel& voxel);

/// sqrt((l^T S l) tr S): what leaves of tensor S turn to l at most (Cauchy and Schwarz; exact for one normal).
double boundOf(const std::array<float, 6>& tensor, const glm::dvec3& l);

/// Two voxels, the lower in the low bits, share a normal (10 bits, hemi-octahedral) and a share (6 bits); a density
/// each (8 bits, the square root over the largest's). Error of the normal: under sqrt(6) / 31, 4.5 degrees (half a step
/// of both coordinates, where the map is steepest); of the share: under 1/126; of the square root of density: under
/// 1/510 of the largest's. `largest` > 0.
std::uint32_t packPair(const DominantVoxel& lower, const DominantVoxel& upper, float largest);
/// The voxel of a pair, upper or lower.
DominantVoxel unpack(std::uint32_t pair, bool upper, float largest);
/// What both of a pair are packed with: the normal and share of their summed tensors, densities such that each blocks
/// as much along the axes as before, together. `size` of a voxel, metres.
std::array<DominantVoxel, 2> paired(const DominantVoxel& lower, const DominantVoxel& upper, const glm::vec3& size);

/// Hemi-octahedral coordinates in [0, 1] of a vector with z >= 0, and back (Cigolle et al. 2014): the hemisphere on the
/// square |x| + |y| <= 1, turned by 45 degrees.
glm::vec2 hemiOctahedral(const glm::vec3& direction);
glm::vec3 fromHemiOctahedral(const glm::vec2& at);

}  // namespace sward::trace
