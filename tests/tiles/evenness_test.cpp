#include "tiles/evenness.h"

#include "tiles/layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace sward::tiles {
namespace {

constexpr int kPatch = 128;
constexpr std::array<std::pair<int, int>, 4> kFlowers{{{20, 30}, {75, 18}, {100, 90}, {40, 101}}};

std::vector<SeamColumn> patchOf(const std::function<float(int, int)>& brightness) {
  std::vector<SeamColumn> columns(kPatch * kPatch);
  for (int y = 0; y < kPatch; ++y) {
    for (int x = 0; x < kPatch; ++x) {
      SeamColumn& column = columns[static_cast<std::size_t>(y * kPatch + x)];
      column.coverage = 1.0f;
      column.meanColour[0] = glm::vec3(brightness(x, y));
    }
  }
  return columns;
}

TileSet setOf(const std::vector<glm::ivec2>& diamonds) {
  TileSet set;
  set.resolution = 32;
  set.patchResolution = kPatch;
  set.tiles = tileColours(3, 2);
  set.diamonds = diamonds;
  return set;
}

std::vector<std::vector<glm::ivec2>> layouts() {
  return spreadDiamonds(kPatch, 16, 6, 64, 5);
}

float hashedBrightness(int x, int y) {
  const double value = std::sin(12.9898 * x + 78.233 * y) * 43758.5453;
  return static_cast<float>(value - std::floor(value));
}

TEST(Unevenness, IsNoughtForAUniformPatch) {
  EXPECT_EQ(unevenness(setOf(layouts().front()), patchOf([](int, int) { return 0.3f; })), 0.0);
}

TEST(Unevenness, IsSmallForNoiseAndLargeForRows) {
  const TileSet set = setOf(layouts().front());
  // Rows and columns of noise average over 18 tiles of 32 texels cut from 6 diamonds: far under a tenth of its
  // variance.
  const double noise = unevenness(set, patchOf(hashedBrightness));
  EXPECT_GT(noise, 0.0);
  EXPECT_LT(noise, 0.1);
  // A wave of the tile's own length stands in phase in every diamond whose place is a multiple of it.
  const double rows = unevenness(set, patchOf([](int x, int) {
                                   return static_cast<float>(0.5 + 0.5 * std::sin(2.0 * std::numbers::pi * x / 32.0));
                                 }));
  EXPECT_GT(rows, 2.0 * noise);
}

TEST(Unevenness, IgnoresWhatIsNotFinite) {
  std::vector<SeamColumn> columns = patchOf(hashedBrightness);
  columns[77].meanColour[0] = glm::vec3(NAN);
  EXPECT_TRUE(std::isfinite(unevenness(setOf(layouts().front()), columns)));
}

TEST(Unevenness, TheChosenLayoutIsAmongTheEvenest) {
  // A few bright flowers on a plain lawn: the landmarks that show rows.
  const auto columns = patchOf([](int x, int y) {
    for (const auto& [fx, fy] : kFlowers) {
      if ((x - fx) * (x - fx) + (y - fy) * (y - fy) < 12) return 1.0f;
    }
    return 0.2f + 0.05f * hashedBrightness(x, y);
  });
  TileOptions options;
  options.resolution = 32;
  options.overlap = 6;
  const auto set = makeTileSet(columns, kPatch, 16, options, {});
  ASSERT_TRUE(set.ok());
  std::vector<double> all;
  for (const auto& layout : layouts()) all.push_back(unevenness(setOf(layout), columns));
  std::sort(all.begin(), all.end());
  EXPECT_LT(unevenness(*set, columns), all[all.size() / 2]);
}

}  // namespace
}  // namespace sward::tiles
