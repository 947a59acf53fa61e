#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// Which place of the patch stands at each place of the ground: tiles as plain values (the owner maps of
/// tiles::TileSet, the cells of tiles::TileMap), so that the reference traces the very ground that a renderer draws.
/// bake::groundPlan makes one of a ground. The world's origin is the south-west corner of the map's middle cell
/// (mapWidth / 2, mapHeight / 2); the map repeats beyond its borders.
struct GroundPlan {
  double patchSideM = 1.0;
  int patchTexels = 256;  ///< pixseries along the patch's side
  int tileTexels = 64;    ///< along a tile's side
  /// Add to a tile texel to get its patch texel (modulo patchTexels): [tile][edge].
  std::vector<std::array<glm::ivec2, 4>> offsets;
  /// Which edge's diamond owns a texel: [tile][y][x], x east, y north.
  std::vector<std::uint8_t> owner;
  int mapWidth = 1, mapHeight = 1;
  std::vector<std::uint8_t> map;  ///< tile of each cell, row by row from the south-west

  double tileSideM() const { return patchSideM * tileTexels / patchTexels; }
};

}  // namespace sward::trace
