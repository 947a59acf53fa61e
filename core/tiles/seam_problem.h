#pragma once

#include "tiles/tile_set.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::tiles {

inline constexpr std::array kEdges{kSouth, kWest, kNorth, kEast};
inline constexpr bool isHorizontal(Edge edge) {
  return edge == kSouth || edge == kNorth;
}

/// One corner of a tile and the two edges that meet there. Local coordinates (u, v) of a texel or lattice point count
/// from the corner inward: u along x, v along y, so that the horizontal edge's side of the diagonal is v < u.
struct Corner {
  Edge horizontal, vertical;
  bool flipX, flipY;
  /// Owner of the diagonal texels where the band leaves no choice. It goes round the tile, so that the straight cut is
  /// the same after a quarter turn, and each of the four texels about a map corner shows another of the four edges.
  Edge diagonal;
};
inline constexpr std::array<Corner, 4> kCorners{
    Corner{kSouth, kWest, false, false, kSouth}, Corner{kSouth, kEast, true, false, kEast},
    Corner{kNorth, kEast, true, true, kNorth}, Corner{kNorth, kWest, false, true, kWest}};

/// Which of the four half-diamonds may own each texel, a bit (1 << Edge) each, [y][x]. A half-diamond reaches past the
/// tile's diagonals by the overlap, but never farther than the texel lies from the corner: the band narrows to nothing
/// at the corners, and the outermost texels of an edge are its own.
std::vector<std::uint8_t> permittedOwners(int resolution, int overlap);

/// Pixseries as vectors whose squared distance is the unweighted cost of a seam: c^T G c = |L^T c|^2 with G = L L^T,
/// one ten-vector for each of R, G, B.
class SeamSpace {
 public:
  SeamSpace(std::span<const SeamColumn> columns, std::span<const double, 100> gram, const JobContext& job);
  /// seamCost of two columns.
  double cost(std::uint32_t a, std::uint32_t b) const;

 private:
  static constexpr std::size_t kSize = 30;
  std::vector<float> m_vectors;
  std::vector<float> m_coverage;
};

/// The labelling problem of one tile: who owns each texel, at least cost along the seams.
struct SeamProblem {
  static constexpr double kForbidden = std::numeric_limits<double>::infinity();
  int resolution = 0;
  int overlap = 0;
  std::span<const std::uint8_t> permitted;  ///< permittedOwners
  std::vector<double> costs;  ///< [texel][pair]: seamCost of what two half-diamonds would show at the texel

  std::size_t texel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(resolution) + static_cast<std::size_t>(x);
  }
  bool permits(std::size_t at, Edge edge) const { return (permitted[at] >> edge & 1U) != 0; }
  double costAt(std::size_t at, std::uint8_t a, std::uint8_t b) const { return costs[at * 6 + kPair[a][b]]; }
  /// Cost of a seam between two neighbouring texels owned by a and b (Kwatra et al. 2003, equation 1).
  double between(std::size_t p, std::size_t q, std::uint8_t a, std::uint8_t b) const {
    return a == b ? 0.0 : costAt(p, a, b) + costAt(q, a, b);
  }
  /// Summed over all pairs of 4-neighbours.
  double energy(std::span<const std::uint8_t> owner) const;

 private:
  static constexpr std::array<std::array<std::uint8_t, 4>, 4> kPair{
      {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
};

/// The problem of one tile; offsets[edge] leads from a tile texel to the patch texel of that edge's half-diamond.
SeamProblem makeSeamProblem(const SeamSpace& space, int patchResolution, int resolution, int overlap,
                            std::span<const std::uint8_t> permitted, const std::array<glm::ivec2, 4>& offsets);

/// Least-cost monotone seams from the four corners to a common meeting point, which is searched for as well (Efros and
/// Freeman 2001 along each half-diagonal). Never costs more than the straight diagonals.
std::vector<std::uint8_t> dynamicProgrammingSeams(const SeamProblem& problem);

/// Betters `owner` by alpha expansions, each a minimum cut (Kwatra et al. 2003; Boykov et al. 2001). Never costs more.
void graphCutSeams(const SeamProblem& problem, std::vector<std::uint8_t>& owner);

/// A texel of the periodic patch as an index of its columns.
inline std::uint32_t wrappedColumn(glm::ivec2 texel, int patchResolution) {
  const auto wrap = [patchResolution](int v) {
    const int m = v % patchResolution;
    return m < 0 ? m + patchResolution : m;
  };
  return static_cast<std::uint32_t>(wrap(texel.y)) * static_cast<std::uint32_t>(patchResolution) +
         static_cast<std::uint32_t>(wrap(texel.x));
}

/// Middle of an edge in tile texels.
inline glm::ivec2 edgeMiddle(int resolution, Edge edge) {
  const int half = resolution / 2;
  switch (edge) {
    case kSouth:
      return {half, 0};
    case kWest:
      return {0, half};
    case kNorth:
      return {half, resolution};
    default:
      return {resolution, half};
  }
}

}  // namespace sward::tiles
