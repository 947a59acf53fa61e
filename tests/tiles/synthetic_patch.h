#pragma once

#include "base/random.h"
#include "tiles/tile_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::tiles::testing {

/// A periodic patch of `strokes` tapering strokes of random colour and light response over empty texels, the kind of
/// picture that grass makes from above.
inline std::vector<SeamColumn> strokePatch(int resolution, int strokes, std::uint64_t seed) {
  std::vector<SeamColumn> columns(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  base::Random random(seed);
  for (int stroke = 0; stroke < strokes; ++stroke) {
    double x = random.uniform(0.0, resolution);
    double y = random.uniform(0.0, resolution);
    double angle = random.uniform(0.0, 6.283185307);
    const double length = random.uniform(6.0, 24.0);
    const double bend = random.uniform(-0.05, 0.05);
    SeamColumn paint;
    paint.coverage = 1.0f;
    for (auto& colour : paint.meanColour) {
      for (int c = 0; c < 3; ++c) colour[c] = static_cast<float>(random.uniform(0.05, 0.6));
    }
    for (auto& response : paint.coefficients) {
      for (float& b : response) b = static_cast<float>(random.uniform(-0.2, 0.2));
      response[9] = static_cast<float>(random.uniform(0.3, 0.8));
    }
    for (double t = 0.0; t < length; t += 0.5) {
      const int half = t < 0.5 * length ? 1 : 0;
      for (int dy = -half; dy <= half; ++dy) {
        for (int dx = -half; dx <= half; ++dx) {
          const int px = ((static_cast<int>(std::floor(x)) + dx) % resolution + resolution) % resolution;
          const int py = ((static_cast<int>(std::floor(y)) + dy) % resolution + resolution) % resolution;
          columns[static_cast<std::size_t>(py) * static_cast<std::size_t>(resolution) + static_cast<std::size_t>(px)] =
              paint;
        }
      }
      x += 0.5 * std::cos(angle);
      y += 0.5 * std::sin(angle);
      angle += bend;
    }
  }
  return columns;
}

inline std::size_t ownerIndex(const TileSet& set, int tile, int x, int y) {
  return (static_cast<std::size_t>(tile) * static_cast<std::size_t>(set.resolution) + static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(set.resolution) +
         static_cast<std::size_t>(x);
}

inline int tileCount(const TileSet& set) {
  return static_cast<int>(set.tiles.size());
}

inline int colourOf(const TileSet& set, int tile, Edge edge) {
  return set.tiles[static_cast<std::size_t>(tile)].edges[edge];
}

inline bool isCorner(const TileSet& set, int x, int y) {
  return (x == 0 || x == set.resolution - 1) && (y == 0 || y == set.resolution - 1);
}

/// A patch texel and its neighbour by (dx, dy), periodic.
inline std::uint32_t stepped(const TileSet& set, std::uint32_t column, int dx, int dy) {
  const int size = set.patchResolution;
  const int x = (static_cast<int>(column) % size + dx + size) % size;
  const int y = (static_cast<int>(column) / size + dy + size) % size;
  return static_cast<std::uint32_t>(y * size + x);
}

}  // namespace sward::tiles::testing
