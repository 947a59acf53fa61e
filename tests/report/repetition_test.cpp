#include "report/repetition.h"

#include "base/random.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

tiles::TileMap mapOf(int side, int tiles, const std::function<int(int, int)>& tileAt) {
  tiles::TileMap map{side, side, {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) map.tiles.push_back(static_cast<std::uint8_t>(tileAt(x, y) % tiles));
  }
  return map;
}

TEST(MapRepetition, FindsThePeriodOfAPeriodicMap) {
  base::Random random(5);
  std::vector<int> cells(15);
  for (int& cell : cells) cell = static_cast<int>(random.uniform() * 8.0);
  // Repeats after five cells along x and after three along y; both are lags where everything agrees.
  const MapRepetition found =
      repetitionOf(mapOf(60, 8, [&](int x, int y) { return cells[static_cast<std::size_t>(y % 3 * 5 + x % 5)]; }), 6);
  EXPECT_DOUBLE_EQ(found.excess, 1.0);
  EXPECT_EQ(found.lag.x % 5, 0);
  EXPECT_EQ(found.lag.y % 3, 0);
}

TEST(MapRepetition, ChanceAloneIsNone) {
  base::Random random(6);
  const MapRepetition found =
      repetitionOf(mapOf(256, 18, [&](int, int) { return static_cast<int>(random.uniform() * 18.0); }), 6);
  // The largest of 84 lags of independent cells: about three standard deviations sqrt(e (1 - e) / cells) / (1 - e).
  EXPECT_LT(found.excess, 5.0 * std::sqrt(1.0 / 18.0 / (256.0 * 256.0)));
  EXPECT_GT(found.excess, 0.0);
}

/// Tiles of 16 pixels filled with noise; every `distinct`-th tile along a row is the same.
image::Image tiledNoise(int distinct) {
  image::Image picture(256, 256, 3);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const auto tile = static_cast<std::uint64_t>(x / 16 % distinct), row = static_cast<std::uint64_t>(y / 16);
      const std::uint64_t bits = base::mix64(tile, row, static_cast<std::uint64_t>(y % 16 * 16 + x % 16));
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = base::unitFloat(bits);
    }
  }
  return picture;
}

TEST(PictureRepetition, FindsATileThatComesAgain) {
  const PictureRepetition found = repetitionOf(tiledNoise(3), 16.0, 4);
  EXPECT_EQ(found.lag, glm::ivec2(3, 0));
  // The mean of a box of other tiles is taken out, which leaves a little less than one.
  EXPECT_GT(found.atTiles, 0.95);
  // Noise at other lags: 200 x 200 pixels, so 5 / 200.
  EXPECT_LT(found.between, 0.03);
}

TEST(PictureRepetition, NoiseDoesNotRepeat) {
  const PictureRepetition found = repetitionOf(tiledNoise(16), 16.0, 4);
  EXPECT_LT(found.atTiles, 0.03);
}

TEST(PictureRepetition, AFlatPictureHasNone) {
  const PictureRepetition found = repetitionOf(image::Image(64, 64, 3, 0.25f), 16.0, 2);
  EXPECT_NEAR(found.atTiles, 0.0, 1.0);
  EXPECT_TRUE(std::isfinite(found.atTiles));
}

}  // namespace
}  // namespace sward::report
