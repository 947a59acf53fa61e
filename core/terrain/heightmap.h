#pragma once

#include "base/job.h"
#include "base/result.h"
#include "terrain/height_field.h"
#include "terrain/options.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Largest side and number of samples of a file.
inline constexpr int kMaxMapSide = 16384;
inline constexpr std::size_t kMaxMapSamples = std::size_t{1} << 25;
/// Heights beyond this are no ground of the Earth but a wrong scale.
inline constexpr double kMaxHeightM = 100000.0;

/// What a file holds, before extents and scales.
struct RawHeights {
  int columns = 0, rows = 0;
  std::vector<float> values;  ///< row by row from the south-west; what missing ones hold is undefined
  std::vector<float> known;   ///< 1 or 0 for each value; empty: all are known
  std::size_t missing = 0;
  glm::dvec2 cell{0.0};    ///< the file's own distance between samples; 0: it has none
  bool degrees = false;    ///< `cell` seems to be in degrees
  double latitudeDeg = 0;  ///< of the middle, where cells are in degrees
  bool integer = false;    ///< values are shares, 0 to 1, of an integer's range
  int bits = 32;           ///< of a value in the file
};

/// An ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize (or dx and dy) and
/// NODATA_value in any order and case, then the rows from the north. Without NODATA_value, -9999 is missing, as the
/// format says; with it, "nan" is missing too. Numbers have a decimal point, whatever the locale. Errors name the line:
/// a header without its lines or twice with the same, sizes out of range (before anything is allocated), cell sizes not
/// above 0, words that are no numbers, nan (without NODATA_value), infinities, too few or too many values, no known
/// value at all.
Result<RawHeights> readEsriGrid(std::string_view text, const std::string& name);

/// The first channel of a PNG, TIFF or EXR of 8 bits to 32-bit floats, with its full precision. In float files -9999,
/// -32767, -32768 and what lies below -1e30 is missing. Errors: sizes out of range, values that are not finite (with
/// their place), no known value, whatever image::readImage refuses.
Result<RawHeights> readHeightImage(std::span<const std::byte> data, const std::string& name);

/// Reads either of them. Errors: a file that is missing or neither.
Result<RawHeights> readHeights(const std::filesystem::path& file);

/// A grid in metres, and what is odd about its file, in sentences for people.
struct Heightmap {
  HeightGrid grid;
  std::vector<std::string> warnings;
};

/// Extents and scales applied; missing heights filled from their neighbours (image::pullPush); smoothed. Around the map
/// the ground runs out to the mean height of its border over an eighth of its longer side, and is level from there on.
/// Errors: heights beyond kMaxHeightM, extents that are not above 0; cancelled.
Result<Heightmap> makeHeightmap(RawHeights raw, const HeightmapOptions& options, const JobContext& job = {});

/// A terrain as a project describes it.
struct Terrain {
  std::shared_ptr<const HeightField> field;  ///< nothing: flat
  std::vector<std::string> warnings;
};
/// `folder` is where relative paths start. Takes some 100 ms for hills or a map of 1024 x 1024. Errors: as above.
Result<Terrain> makeTerrain(const TerrainOptions& options, const std::filesystem::path& folder,
                            const JobContext& job = {});

}  // namespace sward::terrain
