#include "tiles/layout.h"

#include "base/check.h"
#include "base/random.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace sward::tiles {

namespace {

/// Linear maps of a finite field of q elements, invertible, so that (south, west) -> (north, east) is one to one and
/// every colour comes equally often on every side. For q > 2 no entry is 0, so that any two edges of a tile are
/// independent; over two elements no such matrix exists.
int fieldAdd(int q, int a, int b) {
  return q == 4 ? a ^ b : (a + b) % q;
}
int fieldTwice(int q, int a) {
  // The product with the generator: 2 in Z3, alpha in GF(4).
  static constexpr std::array<int, 4> kTimesAlpha{0, 2, 3, 1};
  return q == 4 ? kTimesAlpha[static_cast<std::size_t>(a)] : (2 * a) % q;
}

/// Diamonds are squares turned by 45 degrees: they overlap by their distance in this norm.
int torusDistance(glm::ivec2 a, glm::ivec2 b, int size) {
  const glm::ivec2 d(std::abs(a.x - b.x), std::abs(a.y - b.y));
  return std::min(d.x, size - d.x) + std::min(d.y, size - d.y);
}

/// Farthest-point placement from a random start, ties settled at random.
std::vector<glm::ivec2> farthestPoints(int size, int pitch, int count, base::Random& random) {
  const int side = size / pitch;
  std::vector<int> nearest(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                           std::numeric_limits<int>::max());
  const auto place = [&](std::size_t i) {
    return pitch * glm::ivec2(static_cast<int>(i) % side, static_cast<int>(i) / side);
  };
  std::vector<glm::ivec2> points;
  while (static_cast<int>(points.size()) < count) {
    const int farthest = *std::max_element(nearest.begin(), nearest.end());
    auto pick = random.index(static_cast<std::uint32_t>(std::count(nearest.begin(), nearest.end(), farthest)));
    std::size_t chosen = 0;
    while (nearest[chosen] != farthest || pick-- > 0) ++chosen;
    points.push_back(place(chosen));
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      nearest[i] = std::min(nearest[i], torusDistance(place(i), points.back(), size));
    }
  }
  return points;
}

int leastDistance(const std::vector<glm::ivec2>& points, int size) {
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, torusDistance(points[i], points[j], size));
  }
  return least;
}

}  // namespace

std::vector<Tile> tileColours(int coloursPerAxis, int tilesPerPair) {
  const int q = coloursPerAxis;
  std::vector<Tile> tiles;
  for (int south = 0; south < q; ++south) {
    for (int west = 0; west < q; ++west) {
      for (int i = 0; i < tilesPerPair; ++i) {
        // Diagonals first: the tiles of a pair differ in both edges as long as they can.
        const int shiftNorth = i % q;
        const int shiftEast = (i + i / q) % q;
        const int east = q == 2 ? south : fieldAdd(q, south, fieldTwice(q, west));
        const auto colour = [](int value) { return static_cast<std::uint8_t>(value); };
        tiles.push_back({{colour(south), colour(west), colour(fieldAdd(q, fieldAdd(q, south, west), shiftNorth)),
                          colour(fieldAdd(q, east, shiftEast))}});
      }
    }
  }
  return tiles;
}

std::vector<std::vector<glm::ivec2>> spreadDiamonds(int patchResolution, int pitch, int count, int most,
                                                    std::uint64_t seed) {
  SWARD_CHECK_LE(count, (patchResolution / pitch) * (patchResolution / pitch));
  constexpr int kTrials = 512;
  base::Random random(base::mix64(seed, 0x6469616d6f6e6473ULL));
  std::vector<std::vector<glm::ivec2>> layouts;
  int best = -1;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<glm::ivec2> points = farthestPoints(patchResolution, pitch, count, random);
    const int least = leastDistance(points, patchResolution);
    if (least > best) layouts.clear();
    best = std::max(best, least);
    if (least == best && static_cast<int>(layouts.size()) < most) layouts.push_back(std::move(points));
  }
  return layouts;
}

}  // namespace sward::tiles
