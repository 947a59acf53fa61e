#include "tiles/synthetic_patch.h"
#include "tiles/tile_set.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace sward::tiles {
namespace {

using testing::strokePatch;

TileSet makeSet(int colours, int perPair) {
  TileOptions options;
  options.resolution = 16;
  options.overlap = 4;
  options.apron = 4;
  options.coloursPerAxis = colours;
  options.tilesPerPair = perPair;
  static const std::vector<SeamColumn> columns = strokePatch(64, 80, 2);
  return makeTileSet(columns, 64, 8, options, {}).value();
}

const Tile& tileAt(const TileSet& set, const TileMap& map, int x, int y) {
  return set.tiles[map.tiles[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                             static_cast<std::size_t>(x)]];
}

void expectMatches(const TileSet& set, const TileMap& map) {
  ASSERT_EQ(map.tiles.size(), static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  for (const std::uint8_t tile : map.tiles) ASSERT_LT(tile, set.tiles.size());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (x > 0) {
        ASSERT_EQ(tileAt(set, map, x - 1, y).edges[kEast], tileAt(set, map, x, y).edges[kWest]);
      }
      if (y > 0) {
        ASSERT_EQ(tileAt(set, map, x, y - 1).edges[kNorth], tileAt(set, map, x, y).edges[kSouth]);
      }
    }
  }
}

TEST(TileMap, ScanOrderMatchesNeighboursAtAnySize) {
  for (const auto& [colours, perPair] : {std::pair{1, 1}, {2, 1}, {2, 2}, {2, 4}, {3, 1}, {3, 2}, {3, 9}, {4, 16}}) {
    const TileSet set = makeSet(colours, perPair);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 57}, {57, 1}, {2, 2}, {100, 63}}) {
      const auto map = makeTileMap(set, width, height, MapMethod::ScanOrder, 9);
      ASSERT_TRUE(map.ok());
      expectMatches(set, *map);
    }
  }
  const TileSet set = makeSet(3, 2);
  const auto map = makeTileMap(set, 1000, 1000, MapMethod::ScanOrder, 1);
  ASSERT_TRUE(map.ok());
  expectMatches(set, *map);
}

/// Edges between the last and the first column or row that do not match.
int openJoins(const TileSet& set, const TileMap& map) {
  int open = 0;
  for (int y = 0; y < map.height; ++y)
    open += tileAt(set, map, map.width - 1, y).edges[kEast] != tileAt(set, map, 0, y).edges[kWest];
  for (int x = 0; x < map.width; ++x)
    open += tileAt(set, map, x, map.height - 1).edges[kNorth] != tileAt(set, map, x, 0).edges[kSouth];
  return open;
}

TEST(TileMap, ScanOrderJoinsItself) {
  for (const auto& [colours, perPair] : {std::pair{2, 2}, {2, 4}, {3, 2}, {3, 3}, {3, 9}, {4, 2}, {4, 16}}) {
    const TileSet set = makeSet(colours, perPair);
    for (const auto& [width, height] : {std::pair{16, 16}, {17, 40}, {64, 31}, {333, 65}}) {
      for (const std::uint64_t seed : {1, 2, 3}) {
        const auto map = makeTileMap(set, width, height, MapMethod::ScanOrder, seed);
        ASSERT_TRUE(map.ok());
        expectMatches(set, *map);
        EXPECT_EQ(openJoins(set, *map), 0)
            << colours << " colours, " << perPair << " a pair, " << width << " x " << height << ", seed " << seed;
      }
    }
  }
  // One tile a pair leaves no choice: two joins in three are left open, which also shows that they are counted.
  const TileSet forced = makeSet(3, 1);
  const auto map = makeTileMap(forced, 64, 64, MapMethod::ScanOrder, 1);
  ASSERT_TRUE(map.ok());
  EXPECT_GT(openJoins(forced, *map), 0);
}

TEST(TileMap, SameSeedSameMap) {
  const TileSet set = makeSet(3, 2);
  const auto a = makeTileMap(set, 80, 40, MapMethod::ScanOrder, 1);
  const auto b = makeTileMap(set, 80, 40, MapMethod::ScanOrder, 1);
  const auto c = makeTileMap(set, 80, 40, MapMethod::ScanOrder, 2);
  ASSERT_TRUE(a.ok() && b.ok() && c.ok());
  EXPECT_EQ(a->tiles, b->tiles);
  EXPECT_NE(a->tiles, c->tiles);
}

TEST(TileMap, HashedMatchesAndDoesNotDependOnTheSize) {
  for (const auto& [colours, perPair] : {std::pair{1, 1}, {2, 4}, {3, 9}, {4, 16}}) {
    const TileSet set = makeSet(colours, perPair);
    const auto large = makeTileMap(set, 300, 200, MapMethod::Hashed, 5);
    const auto small = makeTileMap(set, 31, 17, MapMethod::Hashed, 5);
    ASSERT_TRUE(large.ok() && small.ok());
    expectMatches(set, *large);
    for (int y = 0; y < 17; ++y) {
      for (int x = 0; x < 31; ++x) {
        ASSERT_EQ(small->tiles[static_cast<std::size_t>(y * 31 + x)],
                  large->tiles[static_cast<std::size_t>(y * 300 + x)]);
      }
    }
    std::set<std::uint8_t> used(large->tiles.begin(), large->tiles.end());
    EXPECT_EQ(used.size(), set.tiles.size());
  }
}

TEST(TileMap, WrongRequestsAreNamed) {
  const TileSet set = makeSet(3, 2);
  const auto hashed = makeTileMap(set, 10, 10, MapMethod::Hashed, 1);
  ASSERT_FALSE(hashed.ok());
  EXPECT_NE(hashed.error().what.find("complete set of 81"), std::string::npos) << hashed.error().text();
  for (const auto& [width, height] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {1 << 30, 1 << 30}}) {
    EXPECT_FALSE(makeTileMap(set, width, height, MapMethod::ScanOrder, 1).ok());
  }
}

double chiSquare(const TileSet& set, const TileMap& map) {
  std::vector<int> count(set.tiles.size());
  for (const std::uint8_t tile : map.tiles) ++count[tile];
  const double expected = static_cast<double>(map.tiles.size()) / static_cast<double>(set.tiles.size());
  double sum = 0.0;
  for (const int n : count) sum += (n - expected) * (n - expected) / expected;
  return sum;
}

TEST(TileMap, EveryTileIsUsedAboutEquallyOften) {
  const TileSet set = makeSet(3, 2);
  // 17 degrees of freedom: 40.8 is exceeded by chance once in a thousand.
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto map = makeTileMap(set, 40, 40, MapMethod::ScanOrder, seed);
    ASSERT_TRUE(map.ok());
    EXPECT_LT(chiSquare(set, *map), 40.8) << seed;
  }
  // Keeping copies apart favours some tiles a little: over a whole ground, none by more than a tenth.
  const auto ground = makeTileMap(set, 1024, 1024, MapMethod::ScanOrder, 1);
  ASSERT_TRUE(ground.ok());
  std::vector<double> share(set.tiles.size());
  for (const std::uint8_t tile : ground->tiles) share[tile] += 18.0 / (1024.0 * 1024.0);
  for (const double s : share) EXPECT_NEAR(s, 1.0, 0.1);
  // Hashed maps are independent of one another's cells but for shared edges: exactly uniform.
  const TileSet complete = makeSet(2, 4);
  const auto hashed = makeTileMap(complete, 100, 100, MapMethod::Hashed, 1);
  ASSERT_TRUE(hashed.ok());
  EXPECT_LT(chiSquare(complete, *hashed), 37.7);  // 15 degrees of freedom, one in a thousand
}

/// How often two cells `dx`, `dy` apart hold the same tile, over chance.
double repeatsAt(const TileMap& map, std::size_t tiles, int dx, int dy) {
  long same = 0;
  long all = 0;
  for (int y = 0; y + dy < map.height; ++y) {
    for (int x = std::max(0, -dx); x < map.width && x + dx < map.width; ++x) {
      same += map.tiles[static_cast<std::size_t>(y * map.width + x)] ==
              map.tiles[static_cast<std::size_t>((y + dy) * map.width + x + dx)];
      ++all;
    }
  }
  return static_cast<double>(same) / static_cast<double>(all) * static_cast<double>(tiles);
}

TEST(TileMap, NoDistanceRepeats) {
  const TileSet set = makeSet(3, 2);
  const auto map = makeTileMap(set, 256, 256, MapMethod::ScanOrder, 1);
  ASSERT_TRUE(map.ok());
  double peak = 0.0;
  for (int dy = 0; dy <= 32; ++dy) {
    for (int dx = -32; dx <= 32; ++dx) {
      if (dy == 0 && dx <= 0) continue;
      peak = std::max(peak, repeatsAt(*map, set.tiles.size(), dx, dy));
    }
  }
  RecordProperty("largest_repeat_over_chance", std::to_string(peak));
  EXPECT_LT(peak, 1.35);  // a periodic ground has 18 at its period
  // Copies side by side are rarer than chance has them.
  for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}) {
    EXPECT_LT(repeatsAt(*map, set.tiles.size(), dx, dy), 0.75) << dx << ' ' << dy;
  }
}

}  // namespace
}  // namespace sward::tiles
