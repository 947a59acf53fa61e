#include "tiles/tile_set.h"

#include "tiles/evenness.h"
#include "tiles/layout.h"
#include "tiles/seam_problem.h"

#include "base/check.h"
#include "base/parallel.h"
#include "lpt/polynomial.h"

#include <algorithm>
#include <string>
#include <utility>

namespace sward::tiles {

namespace {

const char* const kWhere = "tiles";

std::string number(int value) {
  return std::to_string(value);
}

Result<void> checkColours(const TileOptions& options) {
  const int colours = options.coloursPerAxis;
  if (colours < 1 || colours > 4) {
    return Error::badInput("coloursPerAxis is " + number(colours), kWhere,
                           "Use 1 to 4: a complete set of 4 colours has 256 tiles, as many as a byte can tell apart");
  }
  if (options.tilesPerPair < 1 || options.tilesPerPair > colours * colours) {
    return Error::badInput(
        "tilesPerPair is " + number(options.tilesPerPair) + " with " + number(colours) + " edge colours an axis",
        kWhere, "Use 1 to " + number(colours * colours) + "; with the largest the set is complete");
  }
  return {};
}

Result<void> checkSizes(const TileOptions& options) {
  if (options.resolution < 8 || options.resolution > 4096 || options.resolution % 2 != 0) {
    return Error::badInput("a tile's resolution is " + number(options.resolution) + " texels", kWhere,
                           "Use an even number from 8 to 4096");
  }
  if (options.overlap < 0 || options.overlap > options.resolution / 4) {
    return Error::badInput("an overlap of " + number(options.overlap) + " texels does not fit tiles of " +
                               number(options.resolution) + " texels",
                           kWhere, "Use 0 to " + number(options.resolution / 4) + ", a quarter of the tile");
  }
  if (options.apron < 0 || options.apron > options.resolution / 2) {
    return Error::badInput("an apron of " + number(options.apron) + " texels does not fit tiles of " +
                               number(options.resolution) + " texels",
                           kWhere, "Use 0 to " + number(options.resolution / 2) + ", half of the tile");
  }
  return {};
}

/// Diamonds lie at multiples of the pitch and edges' middles at multiples of half a tile, so an offset from tile to
/// patch is a multiple of the pitch only if half a tile is one.
Result<void> checkPatch(int patchResolution, int pitch, const TileOptions& options) {
  const int diamond = options.resolution + 2 * options.overlap;
  if (patchResolution < diamond) {
    return Error::badInput("a patch of " + number(patchResolution) + " texels is smaller than a diamond of " +
                               number(diamond) + " (a tile of " + number(options.resolution) + " and its overlap)",
                           kWhere, "Use smaller tiles, a narrower overlap or a finer patch");
  }
  if (pitch < 1 || patchResolution % pitch != 0) {
    return Error::badInput(
        "blade slabs of " + number(pitch) + " texels do not divide a patch of " + number(patchResolution) + " texels",
        kWhere, "Use a number of blades that divides the patch's resolution");
  }
  if ((options.resolution / 2) % pitch != 0) {
    return Error::badInput("half a tile, " + number(options.resolution / 2) + " of " + number(options.resolution) +
                               " texels, is not a multiple of the blade slabs' " + number(pitch) + " texels",
                           kWhere, "Use tiles of " + number(2 * pitch) + " texels or a multiple, or more blades");
  }
  const int places = (patchResolution / pitch) * (patchResolution / pitch);
  if (places < 2 * options.coloursPerAxis) {
    return Error::badInput(
        "the patch has " + number(places) + " places for " + number(2 * options.coloursPerAxis) + " diamonds", kWhere,
        "Use fewer colours or more blades");
  }
  return {};
}

bool diamondsFit(std::span<const glm::ivec2> diamonds, int patchResolution, int pitch, const TileOptions& options) {
  const auto fits = [&](int v) { return v >= 0 && v < patchResolution && v % pitch == 0; };
  return diamonds.size() == 2 * static_cast<std::size_t>(options.coloursPerAxis) &&
         std::all_of(diamonds.begin(), diamonds.end(), [&](glm::ivec2 d) { return fits(d.x) && fits(d.y); });
}

/// Everything that stays the same while layouts are tried.
struct Assembly {
  const SeamSpace& space;
  std::vector<std::uint8_t> permitted;
  SeamMethod method;
  int overlap;
};

SeamProblem tileProblem(const Assembly& assembly, const TileSet& set, int tile) {
  std::array<glm::ivec2, 4> offsets{};
  for (const Edge edge : kEdges) offsets[edge] = set.patchOffset(tile, edge);
  return makeSeamProblem(assembly.space, set.patchResolution, set.resolution, assembly.overlap, assembly.permitted,
                         offsets);
}

/// Cuts the seams of every tile of a set whose diamonds are placed.
void cutSeams(TileSet& set, const Assembly& assembly, SeamMethod method, const JobContext& job) {
  const std::size_t texels = assembly.permitted.size();
  set.owner.assign(set.tiles.size() * texels, kSouth);
  set.seamCosts.assign(set.tiles.size(), 0.0);
  base::parallelFor(job, set.tiles.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t tile = begin; tile < end; ++tile) {
      const SeamProblem problem = tileProblem(assembly, set, static_cast<int>(tile));
      std::vector<std::uint8_t> owner = dynamicProgrammingSeams(problem);
      if (method == SeamMethod::GraphCut) graphCutSeams(problem, owner);
      set.seamCosts[tile] = problem.energy(owner);
      std::copy(owner.begin(), owner.end(), set.owner.begin() + static_cast<std::ptrdiff_t>(tile * texels));
    }
  });
}

/// The `most` layouts under which rows and columns of tiles show least.
std::vector<std::vector<glm::ivec2>> evenestLayouts(const TileSet& set, std::vector<std::vector<glm::ivec2>> layouts,
                                                    std::span<const SeamColumn> columns, std::size_t most,
                                                    const JobContext& job) {
  std::vector<std::pair<double, std::size_t>> order(layouts.size());
  base::parallelFor(job, layouts.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      TileSet trial = set;
      trial.diamonds = layouts[i];
      order[i] = {unevenness(trial, columns), i};
    }
  });
  std::sort(order.begin(), order.end());
  std::vector<std::vector<glm::ivec2>> evenest;
  for (std::size_t i = 0; i < std::min(most, order.size()); ++i) evenest.push_back(std::move(layouts[order[i].second]));
  return evenest;
}

/// Among these layouts, the one whose seams cost least.
void chooseLayout(TileSet& set, const std::vector<std::vector<glm::ivec2>>& layouts, const Assembly& assembly,
                  const JobContext& job) {
  base::ProgressCounter progress(job, "tiles", layouts.size());
  TileSet trial = set;
  double least = SeamProblem::kForbidden;
  for (const auto& layout : layouts) {
    if (job.cancelled()) return;
    trial.diamonds = layout;
    cutSeams(trial, assembly, SeamMethod::DynamicProgramming, job);
    double sum = 0.0;
    for (const double cost : trial.seamCosts) sum += cost;
    if (sum < least) {
      least = sum;
      set = trial;
    }
    progress.add();
  }
  if (assembly.method == SeamMethod::GraphCut) cutSeams(set, assembly, SeamMethod::GraphCut, job);
}

}  // namespace

glm::ivec2 TileSet::patchOffset(int tile, Edge edge) const {
  const auto colour = static_cast<std::size_t>(tiles[static_cast<std::size_t>(tile)].edges[edge]);
  const std::size_t first = isHorizontal(edge) ? 0 : static_cast<std::size_t>(coloursPerAxis);
  return diamonds[first + colour] - edgeMiddle(resolution, edge);
}

std::uint32_t TileSet::patchColumn(int tile, int x, int y) const {
  const auto at =
      (static_cast<std::size_t>(tile) * static_cast<std::size_t>(resolution) + static_cast<std::size_t>(y)) *
          static_cast<std::size_t>(resolution) +
      static_cast<std::size_t>(x);
  return wrappedColumn(glm::ivec2(x, y) + patchOffset(tile, static_cast<Edge>(owner[at])), patchResolution);
}

Result<TileSet> makeTileSet(std::span<const SeamColumn> columns, int patchResolution, int pitch,
                            const TileOptions& options, const JobContext& job, std::span<const glm::ivec2> diamonds) {
  SWARD_TRY(checkColours(options));
  SWARD_TRY(checkSizes(options));
  SWARD_TRY(checkPatch(patchResolution, pitch, options));
  SWARD_CHECK_EQ(columns.size(), static_cast<std::size_t>(patchResolution) * static_cast<std::size_t>(patchResolution));

  TileSet set;
  set.resolution = options.resolution;
  set.apron = options.apron;
  set.coloursPerAxis = options.coloursPerAxis;
  set.patchResolution = patchResolution;
  set.tiles = tileColours(options.coloursPerAxis, options.tilesPerPair);

  const auto domain = options.domain == SeamDomain::Disc ? lpt::LightDomain::Disc : lpt::LightDomain::Square;
  const auto gram = lpt::gramMatrix(domain);
  const SeamSpace space(columns, gram, job);
  const Assembly assembly{space, permittedOwners(options.resolution, options.overlap), options.seam, options.overlap};
  // Many layouts are equally spread; those that show rows least go on to have their seams cut.
  constexpr int kLayouts = 192;
  constexpr std::size_t kCut = 8;
  if (diamondsFit(diamonds, patchResolution, pitch, options)) {
    chooseLayout(set, {{diamonds.begin(), diamonds.end()}}, assembly, job);
  } else {
    auto layouts = spreadDiamonds(patchResolution, pitch, 2 * options.coloursPerAxis, kLayouts, options.seed);
    chooseLayout(set, evenestLayouts(set, std::move(layouts), columns, kCut, job), assembly, job);
  }
  if (job.cancelled()) return Error::cancelled();
  return set;
}

}  // namespace sward::tiles
