#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

namespace sward::terrain {

enum class Source : std::uint8_t {
  Flat,      ///< an endless plane at height 0
  Hills,     ///< grown from a seed, endless: they repeat after some kilometres
  Heightmap  ///< read from a file
};

/// Procedural hills. The ground at the world's origin has height 0, whatever the values.
struct HillOptions {
  std::uint64_t seed = 1;
  double amplitudeM = 14.0;     ///< from the lowest valley to the highest top
  double featureSizeM = 140.0;  ///< distance between neighbouring hills
  int octaves = 4;              ///< each adds hills of half the size
  double ruggedness = 0.3;      ///< 0 round downs to 1 sharp ridges with much small relief
  bool operator==(const HillOptions&) const = default;
};

/// Heights from an image (the first channel of a PNG, TIFF or EXR) or an ESRI ASCII grid. Integer images run from
/// heightLowM to heightHighM; floats and grids are metres times verticalScale.
struct HeightmapOptions {
  std::string path;            ///< relative to the project's file
  double extentXM = 0.0;       ///< distance from the first column to the last; 0: the file's own cell size
  double heightLowM = 0.0;     ///< of the value 0
  double heightHighM = 60.0;   ///< of the largest value
  double verticalScale = 1.0;  ///< metres a value, for floats and grids
  double smoothM = 0.0;        ///< radius (standard deviation) of a blur, against the terraces of 8 bits
  glm::dvec3 position{0.0};    ///< world place of the map's middle; z is added to all heights
  bool operator==(const HeightmapOptions&) const = default;
};

/// The form of the ground. The values of sources that are not used are kept.
struct TerrainOptions {
  Source source = Source::Flat;
  HillOptions hills;
  HeightmapOptions heightmap;
  bool operator==(const TerrainOptions&) const = default;
};

}  // namespace sward::terrain
