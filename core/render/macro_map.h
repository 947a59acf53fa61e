#pragma once

#include "tiles/tile_set.h"

#include <cstdint>
#include <vector>

namespace sward::render {

/// Distance between the waves of the macro variation and its strength; `variation` is the largest relative deviation.
struct MacroSettings {
  double variation = 0.0;
  double scaleM = 1.0;
  bool operator==(const MacroSettings&) const = default;
};

/// Cells of the map's other side that are repeated round it, so that a ray need not wrap at every step.
inline constexpr int kMapBorder = 64;

/// The tile map with its border as shaders read it: tile | brightness << 8 | hue << 16, row by row. Brightness and hue
/// are smooth value noise over metres, a deviation of d stored as 128 (1 + d); it repeats with the map.
std::vector<std::uint32_t> makeMacroMap(const tiles::TileMap& map, double tileSideM, const MacroSettings& settings);

}  // namespace sward::render
