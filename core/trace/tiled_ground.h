#pragma once

#include "base/result.h"
#include "scene/patch.h"
#include "trace/ground_plan.h"
#include "trace/height_field.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/trace: where a ray over a tiled ground is on the patch.
namespace sward::trace {

/// A GroundPlan ready for rays through a patch. Places of the world are counted in texels from its origin.
class TiledGround {
 public:
  /// Errors: sizes that are not positive, arrays of other lengths than those give, tiles or owners that do not exist.
  /// `patch` must have finite vertices.
  static Result<TiledGround> create(const GroundPlan& plan, const scene::Patch& patch);

  int patchTexels() const { return m_patchTexels; }
  double texelM() const { return m_texelM; }
  /// Add to a texel of the world to get the patch texel that stands there, modulo the patch; in [0, patchTexels).
  glm::ivec2 shiftAt(std::int64_t x, std::int64_t y) const;

 private:
  friend class GroundWalk;
  /// A texel of a tile as rays toward one quadrant (east or west, north or south) see it.
  struct Texel {
    std::uint8_t edge : 2 = 0;   ///< whose diamond owns it
    std::uint8_t reach : 6 = 0;  ///< the square of so many more texels ahead shows the same piece of the patch
    std::uint8_t top = 0;        ///< nothing in that square stands higher, in HeightField::unitM
  };
  using Texels = std::vector<Texel>;  ///< [tile][y][x]
  /// A texel of the world by its cell of the map and within that cell's tile.
  struct Site {
    int cellX = 0, cellY = 0;  ///< of the map, wrapped
    int x = 0, y = 0;          ///< within the tile
    int baseX = 0, baseY = 0;  ///< world texel of the tile's corner, modulo the patch
    std::size_t tile = 0;      ///< of the cell
  };
  Site siteOf(std::int64_t x, std::int64_t y) const;
  std::size_t tileOf(const Site& site) const {
    return m_map[static_cast<std::size_t>(site.cellY) * static_cast<std::size_t>(m_mapWidth) +
                 static_cast<std::size_t>(site.cellX)];
  }
  std::size_t texelIndex(const Site& site) const {
    const auto side = static_cast<std::size_t>(m_tileTexels);
    return (site.tile * side + static_cast<std::size_t>(site.y)) * side + static_cast<std::size_t>(site.x);
  }
  void look(const GroundPlan& plan, const HeightField& heights, int quadrant);

  double m_texelM = 1.0, m_heightUnit = 1.0;
  int m_patchTexels = 1, m_tileTexels = 1, m_mapWidth = 1, m_mapHeight = 1;
  int m_tileModPatch = 0;             ///< a tile's side modulo the patch's
  std::vector<glm::ivec2> m_offsets;  ///< [tile][edge], each in [0, patchTexels)
  std::array<Texels, 4> m_quadrants;  ///< bit 0: westward, bit 1: southward
  std::vector<std::uint8_t> m_map;
};

/// Part of a ray that sees one piece of the patch, in the patch's square.
struct WalkSegment {
  glm::vec3 origin{0.0f};  ///< metres
  float length = 0.0f;     ///< metres
  double start = 0.0;      ///< distance along the whole ray
};

/// Cuts a ray into segments, front to back, each over one piece of the patch and inside its square, leaving out what
/// passes above everything. Borders are half-open: a segment ends where the next begins, at the same number.
class GroundWalk {
 public:
  /// Pieces of the patch that a ray may cross before it is given up: only rays that hardly rise or sink in a ground
  /// with hardly a plant come so far (some kilometres).
  static constexpr int kMaxPieces = 4096;

  GroundWalk() = default;
  /// From a point of the world (metres, x and y of the straight grid, z >= 0) along a unit vector as far as `end`.
  GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end);
  /// Through the periodic patch instead, laid so that patch texel = world texel + shift.
  GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end,
             const glm::ivec2& shift);

  /// The next segment, or false once the ray has ended or was given up.
  bool next(WalkSegment& out);
  /// Add to a world texel of the last segment to get its patch texel, modulo the patch.
  glm::ivec2 shift() const;
  bool givenUp() const { return m_pieces > kMaxPieces; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  /// One horizontal axis of the ray, in texels.
  struct Axis {
    double origin = 0.0, direction = 0.0, inverse = 0.0;
    std::int64_t texel = 0;  ///< of the world, where the walk is
    /// Distance at which the ray leaves its texel and `reach` more ahead.
    double leaves(int reach) const {
      if (direction == 0.0) return kNever;
      return (static_cast<double>(direction > 0.0 ? texel + reach + 1 : texel - reach) - origin) * inverse;
    }
    double at(double t) const { return origin + t * direction; }
  };
  /// A piece of the patch under the ray: which patch texel stood where it began, and where it ends at the latest.
  struct Piece {
    std::int64_t x = 0, y = 0;            ///< world texel
    int patchX = 0, patchY = 0;           ///< patch texel there
    double borderX = 0.0, borderY = 0.0;  ///< distances to the borders of the patch's square
  };
  void start(const glm::dvec3& origin, const glm::dvec3& direction, double end);
  void look();
  glm::ivec2 shiftHere() const;
  Piece beginPiece() const;
  bool walkPiece(const Piece& piece, WalkSegment& out);
  void step(bool alongX, double t, int reach);
  void moveSite(std::int64_t dx, std::int64_t dy);

  const TiledGround* m_ground = nullptr;
  const TiledGround::Texel* m_texels = nullptr;  ///< of the ray's quadrant; null for the periodic patch
  Axis m_x, m_y;
  double m_z = 0.0, m_slope = 0.0;
  double m_t = 0.0, m_end = 0.0;
  TiledGround::Site m_site;
  TiledGround::Texel m_texel;
  glm::ivec2 m_offset{0};  ///< patch texel = tile texel + offset; of the periodic patch, of the world's texel
  Piece m_piece;
  int m_pieces = 0;
};

}  // namespace sward::trace
