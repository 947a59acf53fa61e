#pragma once

#include "tiles/tile_set.h"

#include <span>

namespace sward::tiles {

/// How much a ground of these tiles shows its rows: the variance of the mean colour of the tiles' texel columns and
/// texel rows (what a long line of tiles seen end on averages to) and of whole tiles (what is seen from far above),
/// over that of single pixseries. Owners are taken along the straight diagonals, so the seams need not be cut. 0 for a
/// uniform patch.
double unevenness(const TileSet& set, std::span<const SeamColumn> columns);

}  // namespace sward::tiles
