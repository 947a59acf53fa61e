#pragma once

#include "base/bytes.h"
#include "base/job.h"
#include "base/result.h"
#include "tiles/options.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::tiles {

enum Edge : std::uint8_t { kSouth = 0, kWest = 1, kNorth = 2, kEast = 3 };

/// One pixseries as a seam sees it.
struct SeamColumn {
  std::array<std::array<float, 10>, 2> coefficients{};  ///< reflected, transmitted: b of lptBasis
  std::array<glm::vec3, 2> meanColour{};  ///< coverage-weighted mean reflectance and transmittance over occupied layers
  float coverage = 0.0f;                  ///< of the whole column, 1 - product of (1 - alpha_i)
};

/// Cost of a seam between two pixseries: sum over RGB of c^T G c with c the difference of colour times coefficients
/// summed over the two responses (equations 8 and 9 in closed form), weighted by the mean coverage. A column without
/// coverage shows nothing, whatever its coefficients; values that are not finite count as 0.
double seamCost(const SeamColumn& a, const SeamColumn& b, std::span<const double, 100> gram);

struct Tile {
  std::array<std::uint8_t, 4> edges{};  ///< colours, indexed by Edge; horizontal edges (south, north) and vertical ones
                                        ///< (west, east) have colours of their own
};

/// Edge-coloured tiles cut from a periodic patch of patchResolution^2 pixseries. Tile texel (x, y), x east and y north,
/// the origin at the tile's south-west corner. Texels outside [0, resolution) belong to the apron.
struct TileSet {
  int resolution = 64;
  int apron = 8;
  int coloursPerAxis = 3;
  int patchResolution = 256;
  std::vector<Tile> tiles;
  /// Patch texel at the middle of an edge of each colour: first the horizontal edges' colours, then the vertical ones'.
  std::vector<glm::ivec2> diamonds;
  /// Which edge's diamond owns a texel, [tile][y][x] over resolution^2: an Edge. The outermost row or column along an
  /// edge is that edge's own; of the corner texels, which lie on two, the south-west is the south edge's, and so round.
  std::vector<std::uint8_t> owner;
  /// Of each tile, summed along its seams: seamCost at both texels of every pair of 4-neighbours that a seam parts.
  std::vector<double> seamCosts;

  int side() const { return resolution + 2 * apron; }
  /// Patch column (y * patchResolution + x) that tile texel (x, y) in [0, resolution)^2 shows.
  std::uint32_t patchColumn(int tile, int x, int y) const;
  /// Add to a tile texel to get its patch texel (modulo patchResolution), for the half-diamond of `edge` of `tile`.
  glm::ivec2 patchOffset(int tile, Edge edge) const;
};

/// Chooses diamonds (far apart on the patch, at multiples of `pitch` texels so that blade slabs line up), assembles
/// every tile and cuts its seams; of equally spread diamonds those whose seams cost least. `columns` has
/// patchResolution^2 entries. Errors: a patch smaller than a diamond, odd sizes, an overlap that does not fit, a pitch
/// that does not divide the patch and half a tile. A cancelled job returns Error::cancelled(). Same bytes on any number
/// of threads. `diamonds`, when there are as many as the set needs and each lies on the pitch, are taken instead of
/// chosen: for a picture that changes without its tiles jumping.
Result<TileSet> makeTileSet(std::span<const SeamColumn> columns, int patchResolution, int pitch,
                            const TileOptions& options, const JobContext& job,
                            std::span<const glm::ivec2> diamonds = {});

/// What a texel of the tile with its apron shows: one patch column, or in the apron a mean of several that may stand
/// there (one entry for all neighbours that agree, with their summed weight). x, y in [-apron, resolution + apron).
/// Weights sum to 1.
struct WeightedColumn {
  std::uint32_t column = 0;
  float weight = 1.0f;
};
std::vector<WeightedColumn> texelSources(const TileSet& set, int tile, int x, int y);

/// The blades bound to a tile: for a slab of the tile and a texel along it, which slab of the patch is seen there and
/// where.
struct BladeOwner {
  std::uint16_t slab = 0;      ///< of the patch, counted along +x (planes normal to x) or +y
  std::uint16_t position = 0;  ///< patch texel along the plane, in slice texels
};
/// [axis 0: planes normal to x, 1: normal to y][tile][slab of the tile][texel along the plane], by the owner on the
/// slab's middle line; tile slabs are as wide as patch slabs (patchResolution / blades texels).
std::vector<BladeOwner> bladeOwners(const TileSet& set, int blades);

/// Tile indices of the ground, row by row from the south-west; row y, column x at [y * width + x].
struct TileMap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> tiles;
};
/// Scan order: each cell takes at random one of the tiles that match its left and lower neighbours, less likely one
/// that stands near by already; and the map joins itself (its last column matches the first, its last row the first),
/// so that it may be repeated, wherever the set allows it: with two tiles a pair, or more, and some sixteen cells a
/// side. Hashed: any cell by itself, from hashed edge colours; needs the complete set (error
/// otherwise). Sides from 1 to 32768.
Result<TileMap> makeTileMap(const TileSet& set, int width, int height, MapMethod method, std::uint64_t seed);

void save(base::ByteWriter& out, const TileSet& set);
bool load(base::ByteReader& in, TileSet& set);

}  // namespace sward::tiles
