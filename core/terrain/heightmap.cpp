#include "terrain/heightmap.h"

#include "base/parallel.h"
#include "image/pull_push.h"
#include "terrain/hills.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

namespace sward::terrain {
namespace {

constexpr double kMetresADegree = 111320.0;  ///< of latitude, and of longitude on the equator
constexpr int kSkirtShare = 8;               ///< of the longer side: the ground that runs out around a map
constexpr int kLeastSkirt = 6;               ///< cells
constexpr int kLevelRings = 3;               ///< the outermost cells are level: splines reach over two
constexpr double kMaxBlurCells = 24.0;
constexpr double kVisibleStepM = 0.02;  ///< terraces of integer maps that are worth a warning

std::string metres(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  text << value << " m";
  return text.str();
}

/// Distance between samples in metres.
Result<glm::dvec2> cellSize(const RawHeights& raw, const HeightmapOptions& options,
                            std::vector<std::string>& warnings) {
  const double narrowing = raw.degrees ? std::cos(raw.latitudeDeg * std::numbers::pi / 180.0) : 1.0;
  const double aspect = raw.cell.x > 0.0 ? raw.cell.y / (raw.cell.x * narrowing) : 1.0;
  if (!(options.extentXM >= 0.0) || !std::isfinite(options.extentXM))
    return Error::badInput("the width is not above 0", "terrain.heightmap.extentXM",
                           "Give metres, or 0 for the file's own cell size.");
  glm::dvec2 cell(1.0);
  if (options.extentXM > 0.0) {
    cell = glm::dvec2(1.0, aspect) * (options.extentXM / (raw.columns - 1));
  } else if (raw.degrees) {
    cell = raw.cell * kMetresADegree * glm::dvec2(narrowing, 1.0);
    warnings.push_back("the cell size seems to be in degrees: cells were taken as " + metres(cell.x) + " by " +
                       metres(cell.y) + "; terrain.heightmap.extentXM sets the width in metres");
  } else if (raw.cell.x > 0.0 && raw.cell.y > 0.0) {
    cell = raw.cell;
  } else {
    warnings.push_back(
        "the file has no cell size: a sample a metre was taken; terrain.heightmap.extentXM sets the width");
  }
  return cell;
}

void blurAxis(HeightGrid& grid, double sigmaCells, bool alongX, const JobContext& job) {
  const int radius = static_cast<int>(std::ceil(3.0 * sigmaCells));
  std::vector<double> kernel;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(std::exp(-0.5 * i * i / (sigmaCells * sigmaCells)));
    sum += kernel.back();
  }
  for (double& weight : kernel) weight /= sum;
  const std::vector<float> source = grid.heights;
  const auto at = [&](int x, int y) {
    return static_cast<double>(
        source[grid.offset(std::clamp(x, 0, grid.columns - 1), std::clamp(y, 0, grid.rows - 1))]);
  };
  constexpr std::size_t kRowsATime = 8;
  base::parallelFor(job, static_cast<std::size_t>(grid.rows), kRowsATime, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < grid.columns; ++x) {
        double value = 0.0;
        for (int i = -radius; i <= radius; ++i)
          value += kernel[static_cast<std::size_t>(i + radius)] * (alongX ? at(x + i, y) : at(x, y + i));
        grid.at(x, y) = static_cast<float>(value);
      }
    }
  });
}

void blur(HeightGrid& grid, double sigmaM, const JobContext& job) {
  for (const bool alongX : {true, false}) {
    const double sigma = std::min(sigmaM / (alongX ? grid.cellM.x : grid.cellM.y), kMaxBlurCells);
    if (sigma > 0.05) blurAxis(grid, sigma, alongX, job);
  }
}

double borderMean(const HeightGrid& grid) {
  double sum = 0.0;
  for (int x = 0; x < grid.columns; ++x)
    sum += static_cast<double>(grid.at(x, 0)) + static_cast<double>(grid.at(x, grid.rows - 1));
  for (int y = 0; y < grid.rows; ++y)
    sum += static_cast<double>(grid.at(0, y)) + static_cast<double>(grid.at(grid.columns - 1, y));
  return sum / (2.0 * (grid.columns + grid.rows));
}

/// The grid with the ground around it that runs out to its border's mean height.
HeightGrid withSkirt(const HeightGrid& grid) {
  const int skirt = std::max(std::max(grid.columns, grid.rows) / kSkirtShare, kLeastSkirt);
  const double mean = borderMean(grid);
  HeightGrid out = grid;
  out.columns += 2 * skirt;
  out.rows += 2 * skirt;
  out.origin -= glm::dvec2(skirt) * grid.cellM;
  out.heights.clear();
  out.heights.reserve(static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows));
  for (int y = 0; y < out.rows; ++y) {
    for (int x = 0; x < out.columns; ++x) {
      const int insideX = std::clamp(x - skirt, 0, grid.columns - 1), insideY = std::clamp(y - skirt, 0, grid.rows - 1);
      const double away = std::hypot(x - skirt - insideX, y - skirt - insideY);
      const double t = std::clamp(away / (skirt - kLevelRings), 0.0, 1.0);
      out.heights.push_back(
          static_cast<float>(std::lerp(static_cast<double>(grid.at(insideX, insideY)), mean, t * t * (3.0 - 2.0 * t))));
    }
  }
  return out;
}

Result<void> checkHeights(const HeightGrid& grid) {
  for (const float h : grid.heights) {
    if (std::abs(static_cast<double>(h)) <= kMaxHeightM) continue;
    return Error::badInput("heights reach " + metres(static_cast<double>(h)), "terrain.heightmap",
                           "Lower terrain.heightmap.verticalScale or the heights themselves: at most 100 km.");
  }
  return {};
}

/// Values to metres.
void scaleHeights(const RawHeights& raw, const HeightmapOptions& options, HeightGrid& grid) {
  const double scale = raw.integer ? options.heightHighM - options.heightLowM : options.verticalScale;
  const double low = (raw.integer ? options.heightLowM : 0.0) + options.position.z;
  for (float& h : grid.heights) h = static_cast<float>(low + scale * static_cast<double>(h));
}

void warnOf(const RawHeights& raw, const HeightmapOptions& options, std::vector<std::string>& warnings) {
  if (raw.missing > 0)
    warnings.push_back(std::to_string(raw.missing) + " of " + std::to_string(raw.values.size()) +
                       " heights are missing; they were filled from their neighbours");
  const double step = std::abs(options.heightHighM - options.heightLowM) / 255.0;
  if (raw.integer && raw.bits == 8 && step > kVisibleStepM && options.smoothM == 0.0)
    warnings.push_back("8 bits give 256 heights: terraces of " + metres(step) +
                       " may show; terrain.heightmap.smoothM smooths them");
}

}  // namespace

Result<Heightmap> makeHeightmap(RawHeights raw, const HeightmapOptions& options, const JobContext& job) {
  Heightmap map;
  SWARD_ASSIGN(map.grid.cellM, cellSize(raw, options, map.warnings));
  warnOf(raw, options, map.warnings);
  HeightGrid& grid = map.grid;
  grid.columns = raw.columns;
  grid.rows = raw.rows;
  grid.heights = std::move(raw.values);
  if (raw.missing > 0) image::pullPush(grid.heights, raw.known, raw.columns, raw.rows, 1, false);
  scaleHeights(raw, options, grid);
  SWARD_TRY(checkHeights(grid));
  blur(grid, options.smoothM, job);
  grid.origin = glm::dvec2(options.position) - 0.5 * grid.cellM * glm::dvec2(grid.columns - 1, grid.rows - 1);
  grid = withSkirt(grid);
  if (job.cancelled()) return Error::cancelled();
  return map;
}

Result<Terrain> makeTerrain(const TerrainOptions& options, const std::filesystem::path& folder, const JobContext& job) {
  Terrain terrain;
  if (options.source == Source::Flat) return terrain;
  Heightmap map;
  if (options.source == Source::Hills) {
    SWARD_ASSIGN(map.grid, makeHills(options.hills, job));
  } else {
    if (options.heightmap.path.empty())
      return Error::badInput("no heightmap is named", "terrain.heightmap.path", "Give a PNG, TIFF, EXR or .asc file.");
    SWARD_ASSIGN(RawHeights raw, readHeights(folder / options.heightmap.path));
    SWARD_ASSIGN(map, makeHeightmap(std::move(raw), options.heightmap, job));
  }
  SWARD_ASSIGN(terrain.field, HeightField::create(std::move(map.grid), job));
  terrain.warnings = std::move(map.warnings);
  return terrain;
}

}  // namespace sward::terrain
