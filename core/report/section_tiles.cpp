#include "report/section_tiles.h"

#include "bake/bake.h"
#include "image/colour.h"
#include "lpt/polynomial.h"
#include "render/frame_plan.h"
#include "render/renderer.h"
#include "report/repetition.h"
#include "report/text.h"
#include "tiles/seam_problem.h"
#include "tiles/tile_set.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>

namespace sward::report {
namespace {

constexpr int kMapSide = 1024;
constexpr int kLags = 8;  ///< whole tiles to either side within which repetition is looked for

/// Cost by the texel of neighbours that a seam parts, and their number.
struct SeamMeasure {
  double cost = 0.0;  ///< as tiles::TileSet::seamCosts, over the disc
  double jump = 0.0;  ///< summed seamCost of what is shown on either side
  std::uint64_t pairs = 0;
};

SeamMeasure measureSeams(const tiles::TileSet& set, std::span<const tiles::SeamColumn> columns,
                         std::span<const double, 100> gram) {
  SeamMeasure out;
  const auto columnOf = [&](int tile, int x, int y, std::uint8_t edge) -> const tiles::SeamColumn& {
    const glm::ivec2 offset = set.patchOffset(tile, static_cast<tiles::Edge>(edge));
    return columns[tiles::wrappedColumn(glm::ivec2(x, y) + offset, set.patchResolution)];
  };
  const int n = set.resolution;
  for (int tile = 0; tile < static_cast<int>(set.tiles.size()); ++tile) {
    const auto ownerAt = [&](int x, int y) {
      return set.owner[(static_cast<std::size_t>(tile) * static_cast<std::size_t>(n) + static_cast<std::size_t>(y)) *
                           static_cast<std::size_t>(n) +
                       static_cast<std::size_t>(x)];
    };
    const auto add = [&](int x, int y, int x2, int y2) {
      const std::uint8_t a = ownerAt(x, y), b = ownerAt(x2, y2);
      if (a == b) return;
      out.cost += tiles::seamCost(columnOf(tile, x, y, a), columnOf(tile, x, y, b), gram) +
                  tiles::seamCost(columnOf(tile, x2, y2, a), columnOf(tile, x2, y2, b), gram);
      out.jump += tiles::seamCost(columnOf(tile, x, y, a), columnOf(tile, x2, y2, b), gram);
      ++out.pairs;
    };
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        if (x + 1 < n) add(x, y, x + 1, y);
        if (y + 1 < n) add(x, y, x, y + 1);
      }
    }
  }
  return out;
}

/// Mean seamCost of 4-neighbours inside the patch.
double neighbourJump(std::span<const tiles::SeamColumn> columns, int resolution, std::span<const double, 100> gram) {
  double sum = 0.0;
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const tiles::SeamColumn& here = columns[tiles::wrappedColumn({x, y}, resolution)];
      sum += tiles::seamCost(here, columns[tiles::wrappedColumn({x + 1, y}, resolution)], gram);
      sum += tiles::seamCost(here, columns[tiles::wrappedColumn({x, y + 1}, resolution)], gram);
    }
  }
  return sum / (2.0 * resolution * resolution);
}

struct SeamKind {
  const char* method;
  tiles::SeamMethod seam;
  bool straight;
  const char* notes;
};
constexpr std::array kSeams{
    SeamKind{"seam_straight", tiles::SeamMethod::DynamicProgramming, true, "no overlap: cut along the diagonals"},
    SeamKind{"seam_dynamic_programming", tiles::SeamMethod::DynamicProgramming, false, "Efros and Freeman 2001"},
    SeamKind{"seam_graph_cut", tiles::SeamMethod::GraphCut, false, "Kwatra et al. 2003, from the seams above"}};

/// Shared by the rows.
struct Bench {
  const SectionInput& input;
  std::vector<tiles::SeamColumn> columns;
  std::shared_ptr<const bake::GroundBake> ground;
  int resolution = 0, pitch = 0;
};

Result<std::vector<Row>> seamRows(const Bench& bench, const JobContext& job) {
  const auto gram = lpt::gramMatrix(lpt::LightDomain::Disc);
  const double inside = neighbourJump(bench.columns, bench.resolution, gram);
  std::vector<Row> rows;
  for (const SeamKind& kind : kSeams) {
    tiles::TileOptions options = bench.input.project.tiles;
    options.seam = kind.seam;
    options.domain = tiles::SeamDomain::Disc;
    if (kind.straight) options.overlap = 0;
    Result<tiles::TileSet> made = Error::failed("no tile set was made");
    const TimeMs time = timeRuns(bench.input.quick ? 1 : 3, [&] {
      // The same diamonds for all: what is compared is the cut.
      made = tiles::makeTileSet(bench.columns, bench.resolution, bench.pitch, options, {job.stop, {}, job.threads},
                                bench.ground->tiles.diamonds);
    });
    SWARD_TRY(made);
    const SeamMeasure measured = measureSeams(made.value(), bench.columns, gram);
    Row row;
    row.method = kind.method;
    row.timeMs = time;
    if (inside > 0.0 && measured.pairs > 0) row.ratio = measured.jump / static_cast<double>(measured.pairs) / inside;
    row.against = "mean squared step between neighbours inside the patch, over the disc of lights";
    row.numbersAndNames = {{"seam_cost", numberText(measured.cost)},
                           {"seam_pairs", std::to_string(measured.pairs)},
                           {"tiles", std::to_string(made.value().tiles.size())},
                           {"overlap", std::to_string(options.overlap)}};
    row.notes = kind.notes;
    rows.push_back(std::move(row));
  }
  return rows;
}

Result<Row> mapRow(const Bench& bench, tiles::MapMethod method) {
  tiles::TileOptions options = bench.input.project.tiles;
  tiles::TileSet set = bench.ground->tiles;
  if (method == tiles::MapMethod::Hashed) {
    // The complete set of two colours; the map reads nothing of a set but its colours.
    set.coloursPerAxis = options.coloursPerAxis = 2;
    options.tilesPerPair = 4;
    set.tiles.clear();
    for (unsigned code = 0; code < 16; ++code) {
      tiles::Tile tile;
      for (unsigned edge = 0; edge < 4; ++edge) tile.edges[edge] = static_cast<std::uint8_t>(code >> edge & 1U);
      set.tiles.push_back(tile);
    }
  }
  Result<tiles::TileMap> made = Error::failed("no map was made");
  const TimeMs time = timeRuns(bench.input.quick ? 1 : 3,
                               [&] { made = tiles::makeTileMap(set, kMapSide, kMapSide, method, options.seed); });
  SWARD_TRY(made);
  const MapRepetition repetition = repetitionOf(made.value(), kLags);
  Row row;
  row.method = method == tiles::MapMethod::Hashed ? "map_hashed" : "map_scan_order";
  row.timeMs = time;
  row.rate = kMapSide * kMapSide / (time.median / 1000.0);
  row.rateUnit = "cells";
  row.bytes = made.value().tiles.size();
  row.numbersAndNames = {{"cells", std::to_string(kMapSide * kMapSide)},
                         {"tiles", std::to_string(set.tiles.size())},
                         {"repetition", numberText(repetition.excess)},
                         {"worst_lag_x", std::to_string(repetition.lag.x)},
                         {"worst_lag_y", std::to_string(repetition.lag.y)}};
  row.notes = "repetition: how much more often than by chance two cells at the worst lag hold the same tile";
  return row;
}

/// The ground from straight above, some thirty tiles wide.
Result<render::Frame> topFrame(const Bench& bench, const scene::Daylight& daylight) {
  const double wideM = 24.0 * bench.ground->tileSideM();
  scene::View view;
  view.focalLengthMm = scene::kSensorWidthMm * 4.0;  // narrow, so that tiles are nearly as large everywhere
  view.target = glm::dvec3(0.0);
  view.position = glm::dvec3(0.0, 0.0, wideM * 4.0);
  render::Frame frame;
  SWARD_ASSIGN(frame, render::planFrame(bench.input.project, view, daylight));
  frame.width = frame.height = 768;
  frame.options.samples = bench.input.quick ? 2 : 8;
  return frame;
}

struct TopPicture {
  const char* name;
  const char* caption;
  bool tinted, tiles;
};

Result<std::vector<Row>> pictureRows(const Bench& bench, Section& section) {
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(bench.input.project));
  SWARD_ASSIGN(const auto renderer, render::Renderer::create(bench.input.context));
  SWARD_TRY(renderer->setGround(bench.ground));
  renderer->setDaylight(daylight, 0.0);
  std::vector<Row> rows;
  Strip strip{"Straight from above, 24 tiles wide", {}};
  for (const TopPicture& picture :
       {TopPicture{"tiles_bare", "tiles alone", false, false},
        TopPicture{"tiles_drawn", "with the project's slow variation and bent grid", true, false},
        TopPicture{"tiles_map", "which tile stands where", false, true}}) {
    SWARD_ASSIGN(render::Frame frame, topFrame(bench, daylight));
    if (!picture.tinted) frame.options.macroVariation = frame.options.gridBendM = 0.0;
    if (picture.tiles) frame.mode.quantity = render::ViewQuantity::Tiles;
    SWARD_ASSIGN(image::Image linear, renderer->drawLinear(frame));
    SWARD_ASSIGN(image::Image display, renderer->drawDisplay(frame));
    if (!picture.tiles) {
      const double pixelsPerTile = frame.width / 24.0;
      const PictureRepetition repetition = repetitionOf(linear, pixelsPerTile, kLags);
      Row row;
      row.method = "repetition_picture";
      row.numbersAndNames = {
          {"picture", '"' + std::string(picture.name) + '"'}, {"repetition", numberText(repetition.atTiles)},
          {"between_tiles", numberText(repetition.between)},  {"worst_lag_x", std::to_string(repetition.lag.x)},
          {"worst_lag_y", std::to_string(repetition.lag.y)},  {"pixels_per_tile", numberText(pixelsPerTile)}};
      row.notes = std::string(picture.caption) +
                  "; largest correlation of luminance at whole-tile lags, and at half-tile lags beside it";
      rows.push_back(std::move(row));
    }
    strip.pictures.push_back(
        {picture.name, picture.caption, picture.tiles ? image::Image{} : std::move(linear), std::move(display)});
  }
  section.strips.push_back(std::move(strip));
  return rows;
}

Result<Section> measureTiles(const SectionInput& input, const JobContext& job) {
  SWARD_ASSIGN(bake::DiskCache cache, bake::DiskCache::open(input.cacheFolder));
  bake::Baker baker(std::move(cache));
  const bake::GroundRequest request{input.project};
  const JobContext quiet{job.stop, {}, job.threads};
  Bench bench{input,
              {},
              nullptr,
              input.project.sampling.sliceResolution,
              input.project.sampling.sliceResolution / input.project.sampling.blades};
  SWARD_ASSIGN(bench.ground, baker.ground(request, quiet));
  SWARD_ASSIGN(bench.columns, baker.seamColumns(request, quiet));
  Section section;
  section.name = "tiles";
  section.title = "Tiles";
  section.summary =
      "How well the Wang tiles hide that they are cut from one patch. A seam is as rough as the step in colour and "
      "light response across it, summed over all lights that exist; 1 would be as rough as the grass itself. "
      "Repetition is what an eye would find: cells, or pictures of them, that agree at some lag more than by chance.";
  const auto step = [&](const char* name, double fraction) {
    if (job.onProgress) job.onProgress(name, fraction);
  };
  step("seams", 0.1);
  SWARD_ASSIGN(section.rows, seamRows(bench, job));
  step("maps", 0.6);
  for (const tiles::MapMethod method : {tiles::MapMethod::ScanOrder, tiles::MapMethod::Hashed}) {
    SWARD_ASSIGN(Row row, mapRow(bench, method));
    section.rows.push_back(std::move(row));
  }
  step("pictures", 0.8);
  SWARD_ASSIGN(std::vector<Row> pictures, pictureRows(bench, section));
  for (Row& row : pictures) section.rows.push_back(std::move(row));
  if (job.cancelled()) return Error::cancelled();
  return section;
}

}  // namespace

Result<Section> tilesSection(const SectionInput& input, const JobContext& job) {
  const project::Project project = groundProject(input.project, input.quick);
  return measureTiles(SectionInput{project, input.context, input.cacheFolder, input.quick}, job);
}

}  // namespace sward::report
