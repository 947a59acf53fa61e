#include "tiles/max_flow.h"
#include "tiles/seam_problem.h"
#include "tiles/synthetic_patch.h"

#include "lpt/polynomial.h"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sward::tiles {
namespace {

using testing::ownerIndex;
using testing::strokePatch;
using testing::tileCount;

constexpr int kPatch = 256;
constexpr int kPitch = 32;

std::array<double, 100> discGram() {
  return lpt::gramMatrix(lpt::LightDomain::Disc);
}

/// Energy of any ownership of a tile, from seamCost alone.
double energyOf(const TileSet& set, const std::vector<SeamColumn>& columns, int tile,
                const std::vector<std::uint8_t>& owner) {
  const auto gram = discGram();
  const int size = set.resolution;
  const auto shown = [&](int x, int y, std::uint8_t edge) -> const SeamColumn& {
    return columns[wrappedColumn(glm::ivec2(x, y) + set.patchOffset(tile, static_cast<Edge>(edge)), kPatch)];
  };
  const auto ownerAt = [&](int x, int y) { return owner[static_cast<std::size_t>(y * size + x)]; };
  double sum = 0.0;
  const auto addPair = [&](int x, int y, int x2, int y2) {
    const std::uint8_t a = ownerAt(x, y);
    const std::uint8_t b = ownerAt(x2, y2);
    if (a == b) return;
    sum += seamCost(shown(x, y, a), shown(x, y, b), gram) + seamCost(shown(x2, y2, a), shown(x2, y2, b), gram);
  };
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (x + 1 < size) addPair(x, y, x + 1, y);
      if (y + 1 < size) addPair(x, y, x, y + 1);
    }
  }
  return sum;
}

/// The straight diagonals, the same after a quarter turn.
std::vector<std::uint8_t> straightOwners(int size) {
  std::vector<std::uint8_t> owner;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int ex = size - 1 - x;
      const int ny = size - 1 - y;
      if (y <= x && y < ex) {
        owner.push_back(kSouth);
      } else if (ex <= y && ex < ny) {
        owner.push_back(kEast);
      } else if (ny <= ex && ny < x) {
        owner.push_back(kNorth);
      } else {
        owner.push_back(kWest);
      }
    }
  }
  return owner;
}

TEST(SeamCost, IsTheIntegralOfTheSquaredDifference) {
  // Quadrature of (R_a f_a - R_b f_b)^2 over the disc and u in [0, 1], by midpoints.
  const std::vector<SeamColumn> columns = strokePatch(64, 40, 5);
  std::vector<SeamColumn> painted;
  for (const SeamColumn& column : columns) {
    if (column.coverage > 0.0f && (painted.empty() || column.coefficients != painted.back().coefficients)) {
      painted.push_back(column);
    }
  }
  ASSERT_GT(painted.size(), 3U);
  SeamColumn a = painted[0];
  SeamColumn b = painted[2];
  a.coverage = 0.9f;
  b.coverage = 0.5f;
  double integral = 0.0;
  constexpr int kSteps = 240;
  constexpr int kLayers = 24;
  for (int j = 0; j < kSteps; ++j) {
    for (int i = 0; i < kSteps; ++i) {
      const double lx = (2.0 * i + 1.0) / kSteps - 1.0;
      const double ly = (2.0 * j + 1.0) / kSteps - 1.0;
      if (lx * lx + ly * ly > 1.0) continue;
      for (int k = 0; k < kLayers; ++k) {
        const auto phi = lpt::lptBasis(lx, ly, (k + 0.5) / kLayers);
        for (int channel = 0; channel < 3; ++channel) {
          double f = 0.0;
          for (std::size_t response = 0; response < 2; ++response) {
            for (std::size_t m = 0; m < 10; ++m) {
              f += phi[m] * (static_cast<double>(a.meanColour[response][channel]) *
                                 static_cast<double>(a.coefficients[response][m]) -
                             static_cast<double>(b.meanColour[response][channel]) *
                                 static_cast<double>(b.coefficients[response][m]));
            }
          }
          integral += f * f * 4.0 / (kSteps * kSteps * kLayers);
        }
      }
    }
  }
  const auto gram = discGram();
  EXPECT_NEAR(seamCost(a, b, gram), 0.7 * integral, 0.005 * integral);
  EXPECT_DOUBLE_EQ(seamCost(a, b, gram), seamCost(b, a, gram));
  EXPECT_EQ(seamCost(a, a, gram), 0.0);
}

TEST(SeamCost, EmptyColumnsShowNothing) {
  SeamColumn a = strokePatch(16, 60, 1)[20];
  a.coverage = 0.0f;
  SeamColumn b = a;
  b.meanColour[0] = glm::vec3(1.0f);
  EXPECT_EQ(seamCost(a, b, discGram()), 0.0);
  // Filled coefficients of an empty texel do not hide a cut blade.
  SeamColumn blade = b;
  blade.coverage = 1.0f;
  blade.coefficients[0][9] = 0.5f;
  a = blade;
  a.coverage = 0.0f;
  EXPECT_GT(seamCost(a, blade, discGram()), 0.0);
}

TEST(SeamSpace, AgreesWithSeamCost) {
  const std::vector<SeamColumn> columns = strokePatch(64, 300, 9);
  const auto gram = discGram();
  const SeamSpace space(columns, gram, {});
  base::Random random(4);
  for (int trial = 0; trial < 500; ++trial) {
    const std::uint32_t a = random.index(64 * 64);
    const std::uint32_t b = random.index(64 * 64);
    const double exact = seamCost(columns[a], columns[b], gram);
    ASSERT_NEAR(space.cost(a, b), exact, 1e-5 * exact + 1e-9);
  }
}

TEST(Seams, StoredCostsAreTheOwnersEnergy) {
  const std::vector<SeamColumn> columns = strokePatch(kPatch, 1200, 7);
  const auto set = makeTileSet(columns, kPatch, kPitch, {}, {});
  ASSERT_TRUE(set.ok());
  const std::size_t texels = static_cast<std::size_t>(set->resolution * set->resolution);
  for (int tile = 0; tile < tileCount(*set); ++tile) {
    const auto first = set->owner.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(tile) * texels);
    const std::vector<std::uint8_t> owner(first, first + static_cast<std::ptrdiff_t>(texels));
    const double energy = energyOf(*set, columns, tile, owner);
    EXPECT_NEAR(set->seamCosts[static_cast<std::size_t>(tile)], energy, 1e-5 * energy);
  }
}

TEST(Seams, CheaperThanStraightAndGraphCutCheapest) {
  const std::vector<SeamColumn> columns = strokePatch(kPatch, 1200, 7);
  TileOptions options;
  const auto path = makeTileSet(columns, kPatch, kPitch, options, {});
  options.seam = SeamMethod::GraphCut;
  const auto cut = makeTileSet(columns, kPatch, kPitch, options, {});
  ASSERT_TRUE(path.ok() && cut.ok());
  ASSERT_EQ(path->diamonds, cut->diamonds);
  const std::vector<std::uint8_t> straightOwner = straightOwners(options.resolution);
  double straightSum = 0.0;
  double pathSum = 0.0;
  double cutSum = 0.0;
  for (int tile = 0; tile < tileCount(*path); ++tile) {
    const double straight = energyOf(*path, columns, tile, straightOwner);
    const double pathCost = path->seamCosts[static_cast<std::size_t>(tile)];
    const double cutCost = cut->seamCosts[static_cast<std::size_t>(tile)];
    EXPECT_LT(pathCost, straight);
    EXPECT_LE(cutCost, pathCost);
    straightSum += straight;
    pathSum += pathCost;
    cutSum += cutCost;
  }
  RecordProperty("straight_cost", std::to_string(straightSum));
  RecordProperty("dynamic_programming_cost", std::to_string(pathSum));
  RecordProperty("graph_cut_cost", std::to_string(cutSum));
  // On grass-like strokes least cost saves far more than rounding, and more freedom saves more.
  EXPECT_LT(pathSum, 0.6 * straightSum);
  EXPECT_LT(cutSum, 0.97 * pathSum);
}

TEST(Seams, PreferEmptyTexels) {
  const std::vector<SeamColumn> columns = strokePatch(kPatch, 700, 21);
  const auto set = makeTileSet(columns, kPatch, kPitch, {}, {});
  ASSERT_TRUE(set.ok());
  const auto coverageOf = [&](int tile, int x, int y) {
    return static_cast<double>(columns[set->patchColumn(tile, x, y)].coverage);
  };
  double onSeam = 0.0;
  double all = 0.0;
  int seamTexels = 0;
  int texels = 0;
  for (int tile = 0; tile < tileCount(*set); ++tile) {
    for (int y = 0; y < set->resolution; ++y) {
      for (int x = 0; x + 1 < set->resolution; ++x) {
        all += coverageOf(tile, x, y);
        ++texels;
        if (set->owner[ownerIndex(*set, tile, x, y)] == set->owner[ownerIndex(*set, tile, x + 1, y)]) continue;
        onSeam += coverageOf(tile, x, y) + coverageOf(tile, x + 1, y);
        seamTexels += 2;
      }
    }
  }
  EXPECT_LT(onSeam / seamTexels, 0.6 * all / texels);
}

/// A seam problem with random costs on a small tile.
SeamProblem randomProblem(int resolution, int overlap, std::span<const std::uint8_t> permitted, base::Random& random) {
  SeamProblem problem{.resolution = resolution, .overlap = overlap, .permitted = permitted, .costs = {}};
  for (std::size_t i = 0; i < permitted.size() * 6; ++i) problem.costs.push_back(std::pow(random.uniform(), 3.0));
  return problem;
}

/// The owners of the texels between a corner and a meeting point: (texel, owner).
using Quadrant = std::vector<std::pair<std::size_t, std::uint8_t>>;

/// Every monotone seam from a corner to the lattice point (meetX, meetY) that ends with a step along u or v, less those
/// that leave the band. Steps are the bits of a counter.
std::vector<Quadrant> allSeams(const SeamProblem& problem, const Corner& corner, int meetX, int meetY, bool endAlongU) {
  const int size = problem.resolution;
  const int endU = corner.flipX ? size - meetX : meetX;
  const int endV = corner.flipY ? size - meetY : meetY;
  std::vector<Quadrant> seams;
  for (unsigned steps = 0; steps < 1U << (endU + endV); ++steps) {
    if (std::popcount(steps) != endU || ((steps >> (endU + endV - 1) & 1U) != 0) != endAlongU) continue;
    Quadrant quadrant;
    bool permitted = true;
    for (int step = 0, i = 0, j = 0; step < endU + endV; ++step) {
      if ((steps >> step & 1U) == 0) {
        ++j;
        continue;
      }
      for (int v = 0; v < endV; ++v) {
        const std::size_t at = problem.texel(corner.flipX ? size - 1 - i : i, corner.flipY ? size - 1 - v : v);
        const Edge owner = v < j ? corner.horizontal : corner.vertical;
        permitted = permitted && problem.permits(at, owner);
        quadrant.emplace_back(at, owner);
      }
      ++i;
    }
    if (permitted) seams.push_back(std::move(quadrant));
  }
  return seams;
}

TEST(Seams, DynamicProgrammingIsOptimalAmongMonotoneSeams) {
  constexpr int kSize = 8;
  constexpr int kOverlap = 2;
  const std::vector<std::uint8_t> permitted = permittedOwners(kSize, kOverlap);
  base::Random random(77);
  for (int trial = 0; trial < 10; ++trial) {
    const SeamProblem problem = randomProblem(kSize, kOverlap, permitted, random);
    double least = SeamProblem::kForbidden;
    int tried = 0;
    std::vector<std::uint8_t> owner(permitted.size());
    // Meeting points within overlap - 1 of the middle; the four seams arrive from four sides.
    for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      for (const bool firstAlongU : {true, false}) {
        std::array<std::vector<Quadrant>, 4> seams;
        for (std::size_t c = 0; c < 4; ++c) {
          seams[c] = allSeams(problem, kCorners[c], kSize / 2 + dx, kSize / 2 + dy, firstAlongU == (c % 2 == 0));
        }
        const std::size_t combinations = seams[0].size() * seams[1].size() * seams[2].size() * seams[3].size();
        for (std::size_t combination = 0; combination < combinations; ++combination, ++tried) {
          std::size_t rest = combination;
          for (const auto& choices : seams) {
            for (const auto& [texel, edge] : choices[rest % choices.size()]) owner[texel] = edge;
            rest /= choices.size();
          }
          least = std::min(least, problem.energy(owner));
        }
      }
    }
    EXPECT_GT(tried, 1000);
    EXPECT_NEAR(problem.energy(dynamicProgrammingSeams(problem)), least, 1e-12);
  }
}

TEST(Seams, GraphCutNeverCostsMoreOnAnyCosts) {
  // Costs at random, not even those of a metric.
  base::Random random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const int size = 8 + 2 * static_cast<int>(random.index(9));
    const int overlap = static_cast<int>(random.index(static_cast<std::uint32_t>(size / 4 + 1)));
    const std::vector<std::uint8_t> permitted = permittedOwners(size, overlap);
    const SeamProblem problem = randomProblem(size, overlap, permitted, random);
    std::vector<std::uint8_t> owner = dynamicProgrammingSeams(problem);
    const double path = problem.energy(owner);
    for (std::size_t at = 0; at < owner.size(); ++at) ASSERT_TRUE(problem.permits(at, static_cast<Edge>(owner[at])));
    graphCutSeams(problem, owner);
    EXPECT_LE(problem.energy(owner), path);
    for (std::size_t at = 0; at < owner.size(); ++at) ASSERT_TRUE(problem.permits(at, static_cast<Edge>(owner[at])));
  }
}

TEST(MaxFlow, EqualsTheLeastOfAllCuts) {
  base::Random random(13);
  for (int trial = 0; trial < 60; ++trial) {
    const int nodes = 1 + static_cast<int>(random.index(9));
    struct Arc {
      int from, to;
      std::int64_t capacity;
    };
    std::vector<Arc> arcs;
    MaxFlow flow(nodes);
    for (std::uint32_t i = 0; i < random.index(40) + 2; ++i) {
      // Node `nodes` stands for the source and `nodes + 1` for the sink.
      const int from = static_cast<int>(random.index(static_cast<std::uint32_t>(nodes + 1)));
      int to = static_cast<int>(random.index(static_cast<std::uint32_t>(nodes + 1)));
      if (to == nodes) to = nodes + 1;
      if (from == to || (from == nodes && to == nodes + 1)) continue;
      const auto capacity = static_cast<std::int64_t>(random.index(20));
      arcs.push_back({from, to, capacity});
      if (from == nodes) {
        flow.addSource(to, capacity);
      } else if (to == nodes + 1) {
        flow.addSink(from, capacity);
      } else {
        flow.addEdge(from, to, capacity);
      }
    }
    const auto cutOf = [&](auto onSource) {
      std::int64_t sum = 0;
      for (const Arc& arc : arcs) {
        const bool fromSource = arc.from == nodes || onSource(arc.from);
        const bool toSource = arc.to < nodes && onSource(arc.to);
        if (fromSource && !toSource) sum += arc.capacity;
      }
      return sum;
    };
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (unsigned set = 0; set < 1U << nodes; ++set) {
      least = std::min(least, cutOf([set](int node) { return (set >> node & 1U) != 0; }));
    }
    EXPECT_EQ(flow.solve(), least);
    EXPECT_EQ(cutOf([&flow](int node) { return flow.onSourceSide(node); }), least);
  }
}

}  // namespace
}  // namespace sward::tiles
