#pragma once

#include <cstddef>
#include <cstdint>

namespace sward::project {

/// Most plants that stand on one patch; each is an instance of some 500 bytes while it is traced.
inline constexpr double kMaxPlants = 200000.0;
/// Most pixels of a picture (2^28 RGB floats are 3 GiB).
inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
/// Most rays that look for hits in one layer set: hits are counted in 32 bits.
inline constexpr double kMaxHitRays = 4.0e9;
/// Most layer texels of the tiles together; 12 bytes each are held while a bake is drawn.
inline constexpr double kMaxTileTexels = 5.0e8;
/// Most tiles of a set: the ground's map keeps one byte a cell, one value is spare.
inline constexpr int kMaxTiles = 255;
/// Most light directions: each is a trace of its own, and a fit holds samples of all.
inline constexpr int kMaxLights = 1024;
/// With fewer lights than this PTM's six coefficients are not determined.
inline constexpr int kFewLights = 6;

/// Most entries of the lists of a file; the schema's ranges.
inline constexpr std::size_t kMaxPlantKinds = 64;
inline constexpr std::size_t kMaxViews = 1000;

}  // namespace sward::project
