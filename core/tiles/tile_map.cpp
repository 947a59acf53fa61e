#include "tiles/scan_order.h"
#include "tiles/tile_set.h"

#include "base/check.h"
#include "base/random.h"

#include <string>

namespace sward::tiles {

namespace {

std::uint32_t pick(std::uint64_t bits, std::size_t count) {
  return static_cast<std::uint32_t>(((bits >> 32) * count) >> 32);
}

Result<TileMap> hashedMap(const TileSet& set, int width, int height, std::uint64_t seed) {
  const auto colours = static_cast<std::size_t>(set.coloursPerAxis);
  const auto key = [colours](std::size_t south, std::size_t west, std::size_t north, std::size_t east) {
    return ((south * colours + west) * colours + north) * colours + east;
  };
  std::vector<int> tileOf(colours * colours * colours * colours, -1);
  for (std::size_t tile = 0; tile < set.tiles.size(); ++tile) {
    const auto& edges = set.tiles[tile].edges;
    tileOf[key(edges[kSouth], edges[kWest], edges[kNorth], edges[kEast])] = static_cast<int>(tile);
  }
  for (const int tile : tileOf) {
    if (tile >= 0) continue;
    return Error::badInput("a hashed tile map needs the complete set of " + std::to_string(tileOf.size()) +
                               " tiles, but there are " + std::to_string(set.tiles.size()),
                           "tiles",
                           "Use " + std::to_string(colours * colours) + " tiles a pair, or the scan-order map");
  }
  // Axis 0: the edge under cell (x, y); axis 1: the edge left of it.
  const auto colour = [&](std::size_t x, std::size_t y, std::uint64_t axis) {
    return pick(base::mix64(seed, x, y, axis), colours);
  };
  TileMap map{width, height, {}};
  map.tiles.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
      const std::size_t k = key(colour(x, y, 0), colour(x, y, 1), colour(x, y + 1, 0), colour(x + 1, y, 1));
      map.tiles.push_back(static_cast<std::uint8_t>(tileOf[k]));
    }
  }
  return map;
}

}  // namespace

Result<TileMap> makeTileMap(const TileSet& set, int width, int height, MapMethod method, std::uint64_t seed) {
  SWARD_CHECK(!set.tiles.empty());
  constexpr int kLargest = 1 << 15;  // a side: a map of a gigabyte
  if (width < 1 || height < 1 || width > kLargest || height > kLargest) {
    return Error::badInput("a tile map of " + std::to_string(width) + " x " + std::to_string(height) + " cells",
                           "tiles", "Use sides from 1 to " + std::to_string(kLargest));
  }
  return method == MapMethod::Hashed ? hashedMap(set, width, height, seed) : scanOrderMap(set, width, height, seed);
}

}  // namespace sward::tiles
