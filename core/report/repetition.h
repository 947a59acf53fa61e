#pragma once

#include "image/image.h"
#include "tiles/tile_set.h"

#include <glm/glm.hpp>

namespace sward::report {

/// Of a tile map: at the lag within `lags` cells at which two cells hold the same tile most often, by how much that
/// exceeds chance e = sum over tiles of p^2: (rate - e) / (1 - e). The map repeats beyond its borders.
struct MapRepetition {
  double excess = 0.0;
  glm::ivec2 lag{0};
};
MapRepetition repetitionOf(const tiles::TileMap& map, int lags);

/// Of a picture of tiles `pixelsPerTile` pixels wide (a whole number of half pixels is rounded): the largest
/// correlation of its luminance with itself at lags of 1 to `lags` whole tiles along x, y or both, where a repeated
/// tile would show, and the largest at lags half a tile off, which no tile explains. Slow changes are taken out first:
/// each pixel less the mean of a tile-sized box round it.
struct PictureRepetition {
  double atTiles = 0.0, between = 0.0;
  glm::ivec2 lag{0};  ///< in tiles, of atTiles
};
PictureRepetition repetitionOf(const image::Image& linear, double pixelsPerTile, int lags);

}  // namespace sward::report
