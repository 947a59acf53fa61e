#pragma once

#include "base/result.h"
#include "trace/ground_plan.h"

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/trace: where a ray over a tiled ground is on the patch.
namespace sward::trace {

/// A GroundPlan ready for rays. Places of the world are counted in texels from its origin.
class TiledGround {
 public:
  /// Errors: sizes that are not positive, arrays of other lengths than those give, tiles or owners that do not exist.
  static Result<TiledGround> create(const GroundPlan& plan);

  int patchTexels() const { return m_patchTexels; }
  double texelM() const { return m_texelM; }
  /// Add to a texel of the world to get the patch texel that stands there, modulo the patch; in [0, patchTexels).
  glm::ivec2 shiftAt(std::int64_t x, std::int64_t y) const { return shiftAt(siteOf(x, y)); }

 private:
  friend class GroundWalk;
  /// The texel of a tile, with what walks need.
  struct Texel {
    std::uint16_t edge = 0;       ///< whose diamond owns it
    std::uint16_t clearance = 0;  ///< the square of texels up to so far away shows the same piece of the patch
  };
  /// A texel of the world by its cell of the map and within that cell's tile.
  struct Site {
    int cellX = 0, cellY = 0;  ///< of the map, wrapped
    int x = 0, y = 0;          ///< within the tile
    int baseX = 0, baseY = 0;  ///< world texel of the tile's corner, modulo the patch
  };
  Site siteOf(std::int64_t x, std::int64_t y) const;
  std::size_t tileOf(const Site& site) const {
    return m_map[static_cast<std::size_t>(site.cellY) * static_cast<std::size_t>(m_mapWidth) +
                 static_cast<std::size_t>(site.cellX)];
  }
  const Texel& texelOf(const Site& site, std::size_t tile) const {
    const auto side = static_cast<std::size_t>(m_tileTexels);
    return m_texels[(tile * side + static_cast<std::size_t>(site.y)) * side + static_cast<std::size_t>(site.x)];
  }
  glm::ivec2 shiftAt(const Site& site) const;
  void measureClearance();

  double m_texelM = 1.0;
  int m_patchTexels = 1, m_tileTexels = 1, m_mapWidth = 1, m_mapHeight = 1;
  int m_tileModPatch = 0;             ///< a tile's side modulo the patch's
  std::vector<glm::ivec2> m_offsets;  ///< [tile][edge], each in [0, patchTexels)
  std::vector<Texel> m_texels;        ///< [tile][y][x]
  std::vector<std::uint8_t> m_map;
};

/// Part of a ray that sees one piece of the patch, in the patch's square.
struct WalkSegment {
  glm::vec3 origin{0.0f};  ///< metres
  float length = 0.0f;     ///< metres
  double start = 0.0;      ///< distance along the whole ray
};

/// Cuts a ray into segments, front to back, each over one piece of the patch and inside its square. Borders are
/// half-open: a segment ends where the next begins, at the same number.
class GroundWalk {
 public:
  /// Pieces of the patch that a ray may cross before it is given up: only rays that hardly rise or sink in a ground
  /// with hardly a plant come so far (some kilometres).
  static constexpr int kMaxSegments = 4096;

  GroundWalk() = default;
  /// From a point of the world (metres, x and y of the straight grid, z >= 0) along a unit vector as far as `end`.
  GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end);
  /// Through the periodic patch instead, laid so that patch texel = world texel + shift.
  GroundWalk(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end,
             const glm::ivec2& shift);

  /// The next segment, or false once the ray has ended or was given up.
  bool next(const TiledGround& ground, WalkSegment& out);
  /// Add to a world texel of the last segment to get its patch texel, modulo the patch.
  const glm::ivec2& shift() const { return m_shift; }
  bool givenUp() const { return m_segments > kMaxSegments; }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  /// One horizontal axis of the ray, in texels.
  struct Axis {
    double origin = 0.0, direction = 0.0, inverse = 0.0;
    std::int64_t texel = 0;  ///< of the world, where the walk is
    /// Distance at which the ray leaves texels [texel - reach, texel + reach].
    double leaves(int reach) const {
      if (direction == 0.0) return kNever;
      return (static_cast<double>(direction > 0.0 ? texel + reach + 1 : texel - reach) - origin) * inverse;
    }
  };
  void start(const TiledGround& ground, const glm::dvec3& origin, const glm::dvec3& direction, double end);
  void step(const TiledGround& ground, bool alongX, double t, int reach);
  void moveSite(const TiledGround& ground, std::int64_t dx, std::int64_t dy);

  Axis m_x, m_y;
  double m_z = 0.0, m_slope = 0.0;
  double m_t = 0.0, m_end = 0.0;
  TiledGround::Site m_site;
  TiledGround::Texel m_texel;
  glm::ivec2 m_shift{0};
  int m_segments = 0;
  bool m_periodic = false;
};

}  // namespace sward::trace
