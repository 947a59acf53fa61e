#include "tiles/synthetic_patch.h"
#include "tiles/tile_set.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace sward::tiles {
namespace {

using testing::colourOf;
using testing::strokePatch;
using testing::tileCount;

constexpr int kPatch = 256;
constexpr int kPitch = 32;
constexpr int kLevels = 4;

const std::vector<SeamColumn>& patch() {
  static const std::vector<SeamColumn> columns = strokePatch(kPatch, 1200, 7);
  return columns;
}

const TileSet& tileSet() {
  static const TileSet set = makeTileSet(patch(), kPatch, kPitch, {}, {}).value();
  return set;
}

/// A value per column with an outline: coverage times colour.
double valueOf(std::uint32_t column) {
  const SeamColumn& c = patch()[column];
  return static_cast<double>(c.coverage) * static_cast<double>(c.meanColour[0].y);
}

/// A square picture.
struct Picture {
  int size = 0;
  std::vector<double> values;
  double at(int x, int y) const { return values[static_cast<std::size_t>(y * size + x)]; }
};

Picture halved(const Picture& fine) {
  Picture coarse{fine.size / 2, {}};
  for (int y = 0; y < coarse.size; ++y) {
    for (int x = 0; x < coarse.size; ++x) {
      coarse.values.push_back(0.25 * (fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y) + fine.at(2 * x, 2 * y + 1) +
                                      fine.at(2 * x + 1, 2 * y + 1)));
    }
  }
  return coarse;
}

std::array<Picture, kLevels> mipsOf(Picture picture) {
  std::array<Picture, kLevels> mips;
  for (Picture& level : mips) {
    level = picture;
    picture = halved(picture);
  }
  return mips;
}

template <typename Value>
Picture aproned(int tile, const Value& value) {
  const TileSet& set = tileSet();
  Picture picture{set.side(), {}};
  for (int y = -set.apron; y < set.resolution + set.apron; ++y) {
    for (int x = -set.apron; x < set.resolution + set.apron; ++x) picture.values.push_back(value(tile, x, y));
  }
  return picture;
}

double filteredValue(int tile, int x, int y) {
  double sum = 0.0;
  for (const WeightedColumn& source : texelSources(tileSet(), tile, x, y)) {
    sum += static_cast<double>(source.weight) * valueOf(source.column);
  }
  return sum;
}

/// The farthest that the mean of a texel's sources may lie from any one of them.
double spread(int tile, int x, int y) {
  double low = 1e30;
  double high = -1e30;
  float largest = 0.0f;
  float least = 1.0f;
  for (const WeightedColumn& source : texelSources(tileSet(), tile, x, y)) {
    low = std::min(low, valueOf(source.column));
    high = std::max(high, valueOf(source.column));
    largest = std::max(largest, source.weight);
    least = std::min(least, source.weight);
  }
  return (high - low) * static_cast<double>(1.0f - least);
}

struct Joint {
  double worstAway = 0.0;   ///< largest difference away from the corners
  double worstExcess = -1;  ///< largest difference less its bound near the corners
  double squares = 0.0;     ///< of the differences near the corners
  int near = 0;
  int away = 0;
};

/// Compares a strip of a tile's apron, one texel wide at this level and along the whole edge, with what its neighbour
/// shows there.
template <typename Strip>
void compareStrips(const Strip& own, const Strip& bound, const Strip& neighbour, int length, int level, Joint& joint) {
  // A texel 2^k - 1 deep may belong to the neighbour's other edges while it is no farther than twice that from the
  // corner: the band is as wide as the distance to the corner.
  const int nearCorner = level == 0 ? 1 : 2;
  for (int i = 0; i < length; ++i) {
    const double difference = std::abs(own(i) - neighbour(i));
    if (i >= nearCorner && i < length - nearCorner) {
      joint.worstAway = std::max(joint.worstAway, difference);
      ++joint.away;
    } else {
      joint.worstExcess = std::max(joint.worstExcess, difference - bound(i));
      joint.squares += difference * difference;
      ++joint.near;
    }
  }
}

TEST(Apron, EveryMatchingPairJoinsWithoutASeamAtMips0To3) {
  const TileSet& set = tileSet();
  ASSERT_EQ(set.apron, 8);
  std::vector<std::array<Picture, kLevels>> mips;
  std::vector<std::array<Picture, kLevels>> bounds;
  for (int tile = 0; tile < tileCount(set); ++tile) {
    mips.push_back(mipsOf(aproned(tile, filteredValue)));
    bounds.push_back(mipsOf(aproned(tile, spread)));
  }
  double meanSquare = 0.0;
  for (std::uint32_t column = 0; column < kPatch * kPatch; ++column) meanSquare += valueOf(column) * valueOf(column);
  meanSquare /= kPatch * kPatch;

  for (int level = 0; level < kLevels; ++level) {
    const auto k = static_cast<std::size_t>(level);
    const int apron = set.apron >> level;
    const int length = set.resolution >> level;
    Joint joint;
    for (std::size_t a = 0; a < mips.size(); ++a) {
      for (std::size_t b = 0; b < mips.size(); ++b) {
        using Strip = std::function<double(int)>;
        const auto row = [&](const auto& pictures, std::size_t tile, int y) -> Strip {
          return [&, tile, y](int i) { return pictures[tile][k].at(apron + i, apron + y); };
        };
        const auto column = [&](const auto& pictures, std::size_t tile, int x) -> Strip {
          return [&, tile, x](int i) { return pictures[tile][k].at(apron + x, apron + i); };
        };
        if (set.tiles[a].edges[kEast] == set.tiles[b].edges[kWest]) {
          compareStrips(column(mips, a, length), column(bounds, a, length), column(mips, b, 0), length, level, joint);
          compareStrips(column(mips, b, -1), column(bounds, b, -1), column(mips, a, length - 1), length, level, joint);
        }
        if (set.tiles[a].edges[kNorth] == set.tiles[b].edges[kSouth]) {
          compareStrips(row(mips, a, length), row(bounds, a, length), row(mips, b, 0), length, level, joint);
          compareStrips(row(mips, b, -1), row(bounds, b, -1), row(mips, a, length - 1), length, level, joint);
        }
      }
    }
    EXPECT_GT(joint.away, 4 * 18 * 6);
    EXPECT_LT(joint.worstAway, 1e-12) << level;
    EXPECT_LT(joint.worstExcess, 1e-6) << level;
    // Root mean square of what differs near corners, of the picture's own: under a half texel by texel (the corner
    // texels alone), and less as texels average, though not by half a level: neighbouring texels resemble each other.
    const double relative = std::sqrt(joint.squares / joint.near / meanSquare);
    RecordProperty("corner_rms_level_" + std::to_string(level), std::to_string(relative));
    constexpr std::array kBounds{0.5, 0.25, 0.2, 0.2};
    EXPECT_LT(relative, kBounds[k]) << level;
  }
}

TEST(Apron, WhatAMapShowsIsAlwaysAmongTheSources) {
  const TileSet& set = tileSet();
  constexpr int kCells = 24;
  const auto map = makeTileMap(set, kCells, kCells, MapMethod::ScanOrder, 3);
  ASSERT_TRUE(map.ok());
  const int size = set.resolution;
  for (int cy = 1; cy + 1 < kCells; ++cy) {
    for (int cx = 1; cx + 1 < kCells; ++cx) {
      const auto tileAt = [&](int x, int y) {
        return static_cast<int>(map->tiles[static_cast<std::size_t>(y * kCells + x)]);
      };
      for (int y = -set.apron; y < size + set.apron; ++y) {
        for (int x = -set.apron; x < size + set.apron; ++x) {
          const int dx = x < 0 ? -1 : x >= size ? 1 : 0;
          const int dy = y < 0 ? -1 : y >= size ? 1 : 0;
          if (dx == 0 && dy == 0) continue;
          const std::uint32_t shown = set.patchColumn(tileAt(cx + dx, cy + dy), x - dx * size, y - dy * size);
          bool found = false;
          for (const WeightedColumn& source : texelSources(set, tileAt(cx, cy), x, y)) {
            found = found || (source.column == shown && source.weight > 0.0f);
          }
          ASSERT_TRUE(found) << cx << ' ' << cy << ": " << x << ' ' << y;
        }
      }
    }
  }
}

TEST(Apron, WeightsSumToOneAndColumnsAreDistinct) {
  const TileSet& set = tileSet();
  std::size_t single = 0;
  for (int tile = 0; tile < tileCount(set); ++tile) {
    for (int y = -set.apron; y < set.resolution + set.apron; ++y) {
      for (int x = -set.apron; x < set.resolution + set.apron; ++x) {
        const auto sources = texelSources(set, tile, x, y);
        ASSERT_FALSE(sources.empty());
        double sum = 0.0;
        for (std::size_t i = 0; i < sources.size(); ++i) {
          sum += static_cast<double>(sources[i].weight);
          for (std::size_t j = 0; j < i; ++j) ASSERT_NE(sources[i].column, sources[j].column);
        }
        ASSERT_NEAR(sum, 1.0, 1e-6);
        const bool inside = std::min(x, y) >= 0 && std::max(x, y) < set.resolution;
        if (inside) {
          ASSERT_EQ(sources[0].column, set.patchColumn(tile, x, y));
        }
        if (sources.size() == 1) ++single;
      }
    }
  }
  // The corners are a small part: 64 + 8 + 8 squared less what may vary.
  EXPECT_GT(single, set.tiles.size() * (64 * 64 + 4 * 8 * 40));
}

TEST(Apron, SmallSetsHaveSourcesToo) {
  for (const auto& [colours, perPair] : {std::pair{1, 1}, {2, 1}, {2, 2}, {2, 4}, {3, 1}, {4, 3}}) {
    TileOptions options;
    options.resolution = 32;
    options.overlap = 8;
    options.coloursPerAxis = colours;
    options.tilesPerPair = perPair;
    const auto set = makeTileSet(patch(), kPatch, 16, options, {});
    ASSERT_TRUE(set.ok());
    for (int tile = 0; tile < tileCount(*set); ++tile) {
      for (const int y : {-8, -1, 0, 31, 32, 39}) {
        for (const int x : {-8, -1, 0, 31, 32, 39}) ASSERT_FALSE(texelSources(*set, tile, x, y).empty());
      }
    }
  }
}

}  // namespace
}  // namespace sward::tiles
