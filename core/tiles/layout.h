#pragma once

#include "tiles/tile_set.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace sward::tiles {

/// The edge colours of every tile: for each (south, west) pair `tilesPerPair` tiles with distinct (north, east) pairs,
/// each colour equally often on each side. coloursPerAxis in [1, 4], tilesPerPair in [1, coloursPerAxis^2]; with the
/// largest the set is complete.
std::vector<Tile> tileColours(int coloursPerAxis, int tilesPerPair);

/// Up to `most` ways to place `count` diamonds far apart on the periodic patch, at multiples of `pitch`: all have the
/// largest least distance that was found. The patch must hold `count` places.
std::vector<std::vector<glm::ivec2>> spreadDiamonds(int patchResolution, int pitch, int count, int most,
                                                    std::uint64_t seed);

}  // namespace sward::tiles
