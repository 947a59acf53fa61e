#include "tiles/seam_problem.h"
#include "tiles/tile_set.h"

#include "base/check.h"

#include <algorithm>

namespace sward::tiles {

namespace {

constexpr Edge opposite(Edge edge) {
  return static_cast<Edge>((edge + 2) % 4);
}

/// Calls visit(tile) for every tile that may stand across `edge` of `tile`.
template <typename Visit>
void forNeighbours(const TileSet& set, int tile, Edge edge, const Visit& visit) {
  const std::uint8_t colour = set.tiles[static_cast<std::size_t>(tile)].edges[edge];
  for (std::size_t other = 0; other < set.tiles.size(); ++other) {
    if (set.tiles[other].edges[opposite(edge)] == colour) visit(other);
  }
}

/// How often each tile may stand at the corner between `horizontal` and `vertical`: it must match what may stand across
/// either edge, one of the two being north or south, the other east or west.
std::vector<double> diagonalWeights(const TileSet& set, int tile, Edge horizontal, Edge vertical) {
  std::array<int, 4> verticalCount{};
  std::array<int, 4> horizontalCount{};
  forNeighbours(set, tile, horizontal, [&](std::size_t n) { ++verticalCount[set.tiles[n].edges[vertical]]; });
  forNeighbours(set, tile, vertical, [&](std::size_t n) { ++horizontalCount[set.tiles[n].edges[horizontal]]; });
  std::vector<double> weights(set.tiles.size());
  for (std::size_t other = 0; other < set.tiles.size(); ++other) {
    const auto& edges = set.tiles[other].edges;
    weights[other] = verticalCount[edges[opposite(vertical)]] * horizontalCount[edges[opposite(horizontal)]];
  }
  return weights;
}

std::vector<double> edgeWeights(const TileSet& set, int tile, Edge edge) {
  std::vector<double> weights(set.tiles.size(), 0.0);
  forNeighbours(set, tile, edge, [&](std::size_t n) { weights[n] = 1.0; });
  return weights;
}

}  // namespace

std::vector<WeightedColumn> texelSources(const TileSet& set, int tile, int x, int y) {
  const int size = set.resolution;
  SWARD_CHECK_LE(-set.apron, std::min(x, y));
  SWARD_CHECK_LT(std::max(x, y), size + set.apron);
  const int dx = x < 0 ? -1 : x >= size ? 1 : 0;
  const int dy = y < 0 ? -1 : y >= size ? 1 : 0;
  if (dx == 0 && dy == 0) return {{set.patchColumn(tile, x, y), 1.0f}};
  const Edge vertical = dx < 0 ? kWest : kEast;
  const Edge horizontal = dy < 0 ? kSouth : kNorth;
  const std::vector<double> weights = dx != 0 && dy != 0 ? diagonalWeights(set, tile, horizontal, vertical)
                                                         : edgeWeights(set, tile, dx != 0 ? vertical : horizontal);

  struct Source {
    std::uint32_t column;
    double weight;
  };
  std::vector<Source> sources;
  double total = 0.0;
  for (std::size_t other = 0; other < weights.size(); ++other) {
    if (weights[other] <= 0.0) continue;
    const std::uint32_t column = set.patchColumn(static_cast<int>(other), x - dx * size, y - dy * size);
    const auto same = std::find_if(sources.begin(), sources.end(), [&](const Source& s) { return s.column == column; });
    if (same == sources.end()) {
      sources.push_back({column, weights[other]});
    } else {
      same->weight += weights[other];
    }
    total += weights[other];
  }
  SWARD_CHECK_GT(total, 0.0);
  std::vector<WeightedColumn> result;
  result.reserve(sources.size());
  for (const Source& source : sources) result.push_back({source.column, static_cast<float>(source.weight / total)});
  return result;
}

std::vector<BladeOwner> bladeOwners(const TileSet& set, int blades) {
  SWARD_CHECK_GT(blades, 0);
  SWARD_CHECK_EQ(set.patchResolution % blades, 0);
  const int width = set.patchResolution / blades;
  SWARD_CHECK_EQ(set.resolution % width, 0);
  std::vector<BladeOwner> owners;
  for (int axis = 0; axis < 2; ++axis) {
    for (int tile = 0; tile < static_cast<int>(set.tiles.size()); ++tile) {
      for (int slab = 0; slab < set.resolution / width; ++slab) {
        const int middle = slab * width + width / 2;
        for (int along = 0; along < set.resolution; ++along) {
          const std::uint32_t column =
              axis == 0 ? set.patchColumn(tile, middle, along) : set.patchColumn(tile, along, middle);
          const auto size = static_cast<std::uint32_t>(set.patchResolution);
          const std::uint32_t across = axis == 0 ? column % size : column / size;
          const std::uint32_t position = axis == 0 ? column / size : column % size;
          // The middle stays in the middle of a slab: diamonds lie at multiples of the slab's width.
          owners.push_back({static_cast<std::uint16_t>(across / static_cast<std::uint32_t>(width)),
                            static_cast<std::uint16_t>(position)});
        }
      }
    }
  }
  return owners;
}

}  // namespace sward::tiles
