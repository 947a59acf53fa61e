#include "tiles/tile_set.h"

#include "base/check.h"
#include "base/random.h"

#include <string>

namespace sward::tiles {

namespace {

std::uint32_t pick(std::uint64_t bits, std::size_t count) {
  return static_cast<std::uint32_t>(((bits >> 32) * count) >> 32);
}

using Choice = std::vector<std::uint8_t>;  ///< tiles that may stand in a cell

/// How many of the filled cells within two of (x, y), knight's moves included, hold `tile`.
unsigned repeatsNear(const TileMap& map, int x, int y, std::uint8_t tile) {
  static constexpr std::array<std::array<int, 2>, 10> kNear{
      {{-1, 0}, {-2, 0}, {0, -1}, {0, -2}, {-1, -1}, {1, -1}, {-2, -1}, {2, -1}, {-1, -2}, {1, -2}}};
  unsigned repeats = 0;
  for (const auto& [dx, dy] : kNear) {
    const int nx = x + dx;
    const int ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= map.width) continue;
    const std::size_t at = static_cast<std::size_t>(ny) * static_cast<std::size_t>(map.width);
    if (map.tiles[at + static_cast<std::size_t>(nx)] == tile) ++repeats;
  }
  return repeats;
}

/// One of the choice at random, a tile four times less likely for each copy of it near by: copies side by side are what
/// the eye catches first. All tiles are still used within a tenth equally often, and no distance is favoured.
std::uint8_t pickTile(const TileMap& map, int x, int y, const Choice& choice, std::uint64_t bits) {
  std::array<std::uint64_t, 256> ends;  // running sums of the weights
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < choice.size(); ++i) {
    sum += std::uint64_t{1} << (2 * (10 - repeatsNear(map, x, y, choice[i])));
    ends[i] = sum;
  }
  const std::uint64_t point = ((bits >> 32) * sum) >> 32;  // sum <= 2^28
  std::size_t chosen = 0;
  while (ends[chosen] <= point) ++chosen;
  return choice[chosen];
}

TileMap scanOrderMap(const TileSet& set, int width, int height, std::uint64_t seed) {
  constexpr std::size_t kAny = 4;  // no neighbour: one more than the largest colour
  std::array<std::array<Choice, kAny + 1>, kAny + 1> matching;
  for (std::size_t tile = 0; tile < set.tiles.size(); ++tile) {
    const auto& edges = set.tiles[tile].edges;
    for (const std::size_t south : {static_cast<std::size_t>(edges[kSouth]), kAny}) {
      for (const std::size_t west : {static_cast<std::size_t>(edges[kWest]), kAny}) {
        matching[south][west].push_back(static_cast<std::uint8_t>(tile));
      }
    }
  }
  TileMap map{width, height, {}};
  const auto stride = static_cast<std::size_t>(width);
  map.tiles.resize(stride * static_cast<std::size_t>(height));
  std::size_t at = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++at) {
      const std::size_t south = y > 0 ? set.tiles[map.tiles[at - stride]].edges[kNorth] : kAny;
      const std::size_t west = x > 0 ? set.tiles[map.tiles[at - 1]].edges[kEast] : kAny;
      const std::uint64_t bits = base::mix64(seed, static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
      map.tiles[at] = pickTile(map, x, y, matching[south][west], bits);
    }
  }
  return map;
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
