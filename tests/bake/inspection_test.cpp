#include "bake/bake.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

/// A layer set with random texels in every other column, and a fit of it.
struct HandMade {
  trace::LayerHits hits;
  trace::LayerVisibility visibility;
  lpt::Fit fit;

  HandMade(int side, int layers, std::uint64_t seed) {
    base::Random random(seed);
    const int columns = side * side;
    hits.shape = {side, side, layers};
    hits.subSamples = 4;
    hits.columnStart = {0};
    hits.hitStart = {0};
    fit.columns = columns;
    fit.layers = layers;
    for (int column = 0; column < columns; ++column) {
      const bool empty = column % 5 == 0;
      for (int layer = 0; layer < layers && !empty; ++layer) {
        if (random.uniform(0.0, 1.0) < 0.4) continue;
        hits.layer.push_back(static_cast<std::uint8_t>(layer));
        hits.hitStart.push_back(hits.hitStart.back() + 1 + static_cast<std::uint32_t>(random.uniform(0.0, 3.99)));
        visibility.visibility.push_back(static_cast<float>(random.uniform(0.0, 1.0)));
      }
      hits.columnStart.push_back(static_cast<std::uint32_t>(hits.layer.size()));
      fit.condition.push_back(empty ? 0.0f : static_cast<float>(std::pow(10.0, random.uniform(0.5, 3.0))));
      fit.rank.push_back(empty ? std::uint8_t{0} : static_cast<std::uint8_t>(5 + column % 6));
      fit.weight.push_back(empty ? 0.0f : static_cast<float>(random.uniform(0.1, 2.0)));
    }
  }
  InspectedLayers layers() const { return {hits, visibility, fit}; }
};

constexpr ConditionRange kDecades{0.0, 3.0};

TEST(Inspection, ThePatchShowsItsFitAndVisibility) {
  const HandMade made(8, 4, 1);
  const StackInspection inspection = inspectPatch(made.layers(), kDecades, {});
  ASSERT_EQ(inspection.condition.size(), 64u);
  ASSERT_EQ(inspection.visibility.size(), 256u);
  std::vector<int> expected(256, 0);
  for (std::uint32_t column = 0; column < 64; ++column) {
    const double logarithm = std::log10(std::max(static_cast<double>(made.fit.condition[column]), 1e-9));
    EXPECT_EQ(inspection.condition[column], column % 5 == 0 ? 0 : 1 + std::lround(254.0 * logarithm / 3.0));
    EXPECT_EQ(inspection.rank[column], made.fit.rank[column]);
    EXPECT_EQ(inspection.weight[column], made.fit.weight[column]);
    for (std::uint32_t t = made.hits.columnStart[column]; t < made.hits.columnStart[column + 1]; ++t)
      expected[made.hits.layer[t] * 64 + column] =
          static_cast<int>(std::lround(made.visibility.visibility[t] * 255.0f));
  }
  for (std::size_t i = 0; i < 256; ++i) EXPECT_NEAR(inspection.visibility[i], expected[i], 1) << i;
}

TEST(Inspection, TilesShowThePatchColumnsThatTheyAreCutFrom) {
  Baker baker;
  const auto ground = baker.ground(test::smallProject(), {});
  ASSERT_TRUE(ground.ok());
  const tiles::TileSet& set = (*ground)->tiles;
  const HandMade made(set.patchResolution, 4, 2);
  const StackInspection patch = inspectPatch(made.layers(), kDecades, {});
  const StackInspection tiled = inspectTiles(made.layers(), kDecades, set, {});
  const auto side = static_cast<std::size_t>(set.side()), columns = static_cast<std::size_t>(made.fit.columns);
  ASSERT_EQ(tiled.condition.size(), set.tiles.size() * side * side);
  int single = 0, blended = 0;
  for (std::size_t tile = 0; tile < set.tiles.size(); ++tile) {
    for (std::size_t within = 0; within < side * side; ++within) {
      const auto sources = tiles::texelSources(set, static_cast<int>(tile), static_cast<int>(within % side) - set.apron,
                                               static_cast<int>(within / side) - set.apron);
      const std::size_t at = tile * side * side + within;
      int least = 255, low = 255, high = 0;
      for (const tiles::WeightedColumn& source : sources) {
        if (patch.condition[source.column] == 0) continue;
        least = std::min<int>(least, patch.rank[source.column]);
        low = std::min<int>(low, patch.condition[source.column]);
        high = std::max<int>(high, patch.condition[source.column]);
      }
      EXPECT_EQ(tiled.rank[at], high == 0 ? 0 : least);
      EXPECT_GE(tiled.condition[at], high == 0 ? 0 : low - 1);
      EXPECT_LE(tiled.condition[at], high == 0 ? 0 : high + 1);
      ++(sources.size() == 1 ? single : blended);
      if (sources.size() != 1) continue;
      for (std::size_t layer = 0; layer < 4; ++layer)
        EXPECT_EQ(tiled.visibility[(tile * 4 + layer) * side * side + within],
                  patch.visibility[layer * columns + sources[0].column]);
    }
  }
  EXPECT_GT(single, 100);
}

TEST(Inspection, TheRangeLeavesOutliersAndIsNeverEmpty) {
  lpt::Fit fit;
  for (int i = 0; i < 1000; ++i) fit.condition.push_back(static_cast<float>(std::pow(10.0, 1.0 + i / 1000.0)));
  fit.condition[0] = 1e9f;
  fit.condition[1] = 0.0f;
  const lpt::Fit* one = &fit;
  const ConditionRange range = conditionRange(std::span(&one, 1));
  EXPECT_NEAR(range.low, 1.01, 0.005);
  EXPECT_NEAR(range.high, 1.99, 0.005);
  EXPECT_EQ(range.byteOf(0.0f), 0);
  EXPECT_EQ(range.byteOf(1e-3f), 1);
  EXPECT_EQ(range.byteOf(1e9f), 255);
  EXPECT_EQ(range.byteOf(static_cast<float>(std::pow(10.0, 1.5))), 128);
  lpt::Fit equal;
  equal.condition.assign(10, 7.0f);
  one = &equal;
  EXPECT_GT(conditionRange(std::span(&one, 1)).high, conditionRange(std::span(&one, 1)).low);
  EXPECT_GT(conditionRange({}).high, conditionRange({}).low);
}

TEST(Inspection, FitsItsGroundAndTracesNothingAfterIt) {
  const sward::test::TemporaryFolder folder("inspection");
  Baker baker(DiskCache::open(folder.path()).value());
  const auto project = test::smallProject();
  const auto ground = baker.ground(project, {});
  ASSERT_TRUE(ground.ok());
  BakeReport report;
  const auto inspection = baker.inspection(project, {}, &report);
  ASSERT_TRUE(inspection.ok());
  EXPECT_EQ(report.raysNearest, 0u);
  EXPECT_EQ(report.raysOcclusion, 0u);
  const auto fits = [](const StackInspection& inspected, const lpt::LayerStack& stack) {
    return inspected.condition.size() == stack.columnCount() && inspected.visibility.size() == stack.texelCount() &&
           inspected.rank.size() == stack.columnCount() && inspected.weight.size() == stack.columnCount();
  };
  EXPECT_TRUE(fits((*inspection)->slices, (*ground)->slices));
  EXPECT_TRUE(fits((*inspection)->soil, (*ground)->soil));
  for (std::size_t side = 0; side < 4; ++side) EXPECT_TRUE(fits((*inspection)->blades[side], (*ground)->blades[side]));
  // Where the patch's stack has grass, it was seen from somewhere; where it has none, nothing is known.
  const lpt::LayerStack& blades = (*ground)->blades[0];
  int covered = 0;
  for (std::size_t texel = 0; texel < blades.texelCount(); ++texel) {
    if (blades.surface[4 * texel + 3] == 0) {
      EXPECT_EQ((*inspection)->blades[0].visibility[texel], 0);
    } else {
      ++covered;
    }
  }
  EXPECT_GT(covered, 100);
  EXPECT_EQ(baker.inspection(project, {}).value(), *inspection) << "held in memory";
}

TEST(Inspection, IsCancelled) {
  Baker baker;
  std::stop_source stop;
  stop.request_stop();
  const auto inspection = baker.inspection(test::smallProject(), {stop.get_token(), {}, 0});
  ASSERT_FALSE(inspection.ok());
  EXPECT_EQ(inspection.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace sward::bake
