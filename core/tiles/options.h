#pragma once

#include <cstdint>

namespace sward::tiles {

enum class SeamMethod : std::uint8_t { DynamicProgramming, GraphCut };
enum class SeamDomain : std::uint8_t {
  Disc,
  Square
};  ///< lights over which a seam's cost is integrated; Square is the paper's
enum class MapMethod : std::uint8_t { ScanOrder, Hashed };

struct TileOptions {
  int resolution = 64;     ///< texels along a tile's side
  int coloursPerAxis = 3;  ///< 1 to 4
  int tilesPerPair = 2;    ///< tiles for every (south, west) pair: 3 * 3 * 2 = 18
  int overlap = 12;        ///< texels of the overlap band about each diagonal, on each side, along x or y; up to a
                           ///< quarter of the resolution
  int apron = 8;           ///< texels round a tile: 2^k serves mip levels up to k
  SeamMethod seam = SeamMethod::DynamicProgramming;
  SeamDomain domain = SeamDomain::Disc;
  int mapWidth = 1024;  ///< cells of the ground's tile map
  int mapHeight = 1024;
  MapMethod map = MapMethod::ScanOrder;
  std::uint64_t seed = 1;
  bool operator==(const TileOptions&) const = default;
};

}  // namespace sward::tiles
