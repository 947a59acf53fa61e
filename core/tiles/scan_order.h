#pragma once

#include "tiles/tile_set.h"

#include <cstdint>

namespace sward::tiles {

/// The scan-order map of makeTileMap(), whose sizes were checked.
TileMap scanOrderMap(const TileSet& set, int width, int height, std::uint64_t seed);

}  // namespace sward::tiles
