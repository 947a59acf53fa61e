#include "impostor/quadtree.h"

#include "base/random.h"

#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace sward::impostor {
namespace {

QuadtreeAtlas atlas(int size, int smallest) {
  auto made = QuadtreeAtlas::create(size, smallest);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

/// Which region covers each cell of the smallest size, by painting; a cell that two cover is an overlap.
bool overlaps(const QuadtreeAtlas& tree, const std::vector<AtlasRegion>& regions) {
  const int cells = tree.size() / tree.smallest();
  std::vector<bool> covered(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), false);
  for (const AtlasRegion& region : regions) {
    if (region.x < 0 || region.y < 0 || region.x + region.size > tree.size() || region.y + region.size > tree.size()) {
      return true;
    }
    for (int y = region.y; y < region.y + region.size; y += tree.smallest()) {
      for (int x = region.x; x < region.x + region.size; x += tree.smallest()) {
        auto cell = covered.begin() + (y / tree.smallest()) * cells + x / tree.smallest();
        if (*cell) return true;
        *cell = true;
      }
    }
  }
  return false;
}

TEST(QuadtreeAtlas, GivesThePowerOfTwoAboveAndNothingBeyondItself) {
  QuadtreeAtlas tree = atlas(256, 16);
  EXPECT_EQ(tree.largestFree(), 256);
  EXPECT_EQ(tree.allocate(33)->size, 64);
  EXPECT_EQ(tree.allocate(64)->size, 64);
  EXPECT_EQ(tree.allocate(1)->size, 16);
  EXPECT_FALSE(tree.allocate(257));
  EXPECT_FALSE(tree.allocate(0));
  EXPECT_FALSE(tree.allocate(-4));
  EXPECT_FALSE(tree.allocate(256));
  EXPECT_EQ(tree.takenTexels(), 64u * 64u * 2u + 16u * 16u);
  EXPECT_EQ(tree.largestFree(), 128);
}

TEST(QuadtreeAtlas, FillsToTheLastTexelAndBecomesWholeAgain) {
  QuadtreeAtlas tree = atlas(128, 8);
  std::vector<AtlasRegion> regions;
  while (const auto region = tree.allocate(8)) regions.push_back(*region);
  EXPECT_EQ(regions.size(), 256u);
  EXPECT_EQ(tree.takenTexels(), 128u * 128u);
  EXPECT_EQ(tree.largestFree(), 0);
  EXPECT_FALSE(overlaps(tree, regions));
  EXPECT_EQ(tree.taken().size(), 256u);
  for (std::size_t i = 0; i < regions.size(); ++i) EXPECT_TRUE(tree.release(regions[(i * 37) % regions.size()]));
  EXPECT_EQ(tree.takenTexels(), 0u);
  EXPECT_EQ(tree.allocate(128), (AtlasRegion{0, 0, 128}));
}

TEST(QuadtreeAtlas, PutsSmallOnesWhereTheyFitTightly) {
  QuadtreeAtlas tree = atlas(256, 16);
  ASSERT_TRUE(tree.allocate(16));
  ASSERT_TRUE(tree.allocate(64));
  // The other three 16s beside the first leave every larger square whole.
  for (int i = 0; i < 3; ++i) EXPECT_LT(tree.allocate(16)->x, 32);
  EXPECT_EQ(tree.largestFree(), 128);
  EXPECT_EQ(tree.allocate(32)->size, 32);
}

TEST(QuadtreeAtlas, ThousandsOfRequestsInRandomOrderNeitherOverlapNorLeak) {
  QuadtreeAtlas tree = atlas(512, 8);
  base::Random random(7);
  std::vector<AtlasRegion> held;
  std::uint64_t texels = 0;
  int refused = 0;
  for (int step = 0; step < 20000; ++step) {
    if (held.empty() || random.uniform() < 0.55) {
      const int size = 8 << random.index(5);
      if (const auto region = tree.allocate(size)) {
        ASSERT_EQ(region->size, size);
        held.push_back(*region);
        texels += static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size);
      } else {
        ASSERT_LT(tree.largestFree(), size);
        ++refused;
      }
    } else {
      const std::size_t i = random.index(static_cast<std::uint32_t>(held.size()));
      texels -= static_cast<std::uint64_t>(held[i].size) * static_cast<std::uint64_t>(held[i].size);
      ASSERT_TRUE(tree.release(held[i]));
      ASSERT_FALSE(tree.release(held[i])) << "given back twice";
      held[i] = held.back();
      held.pop_back();
    }
    ASSERT_EQ(tree.takenTexels(), texels);
    if (step % 500 == 0) {
      ASSERT_FALSE(overlaps(tree, held));
      ASSERT_EQ(tree.taken().size(), held.size());
    }
  }
  EXPECT_GT(refused, 100) << "the atlas was never full";
  for (const AtlasRegion& region : held) EXPECT_TRUE(tree.release(region));
  EXPECT_EQ(tree.largestFree(), 512);
}

TEST(QuadtreeAtlas, RefusesToTakeBackWhatItDidNotGive) {
  QuadtreeAtlas tree = atlas(128, 16);
  const AtlasRegion region = *tree.allocate(64);
  EXPECT_FALSE(tree.release({0, 0, 32})) << "within a region";
  EXPECT_FALSE(tree.release({0, 0, 128})) << "over it";
  EXPECT_FALSE(tree.release({64, 0, 64})) << "free";
  EXPECT_FALSE(tree.release({8, 8, 16}));
  EXPECT_FALSE(tree.release({-64, 0, 64}));
  EXPECT_FALSE(tree.release({128, 0, 64}));
  EXPECT_FALSE(tree.release({0, 0, 0}));
  EXPECT_FALSE(tree.release({0, 0, 8}));
  EXPECT_TRUE(tree.release(region));
}

TEST(QuadtreeAtlas, FindsTheSquareThatIsLeastMissed) {
  QuadtreeAtlas tree = atlas(64, 16);
  std::vector<AtlasRegion> regions;
  while (const auto region = tree.allocate(16)) regions.push_back(*region);
  // Worth: the place in Morton order; so the first square of four is worth 3, the last 15.
  const auto worth = [&](const AtlasRegion& r) {
    return static_cast<double>(std::find(regions.begin(), regions.end(), r) - regions.begin());
  };
  const auto cheapest = tree.cheapest(32, 100.0, worth);
  ASSERT_TRUE(cheapest);
  EXPECT_EQ(cheapest->regions.size(), 4u);
  EXPECT_EQ(cheapest->worth, 3.0);
  EXPECT_FALSE(tree.cheapest(32, 2.5, worth)) << "all squares of 32 hold something that stays";
  EXPECT_EQ(tree.cheapest(16, 2.5, worth)->regions.front(), regions[0]);
  ASSERT_TRUE(tree.release(regions[9]));
  EXPECT_TRUE(tree.cheapest(16, -1.0, worth)->regions.empty()) << "a free square costs nothing";
}

TEST(QuadtreeAtlas, ALargerRegionGoesAsAWhole) {
  QuadtreeAtlas tree = atlas(64, 8);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(tree.allocate(32));
  const auto cheapest = tree.cheapest(8, 10.0, [](const AtlasRegion& r) { return r.x == 32 && r.y == 0 ? 1.0 : 2.0; });
  ASSERT_TRUE(cheapest);
  ASSERT_EQ(cheapest->regions.size(), 1u);
  EXPECT_EQ(cheapest->regions[0], (AtlasRegion{32, 0, 32}));
}

TEST(QuadtreeAtlas, OneRegionAloneAndBadSizes) {
  QuadtreeAtlas tree = atlas(16, 16);
  EXPECT_EQ(tree.allocate(3), (AtlasRegion{0, 0, 16}));
  EXPECT_FALSE(tree.allocate(16));
  EXPECT_TRUE(tree.release({0, 0, 16}));
  for (const auto& [size, smallest] :
       {std::pair{100, 16}, {128, 12}, {16, 32}, {0, 1}, {-8, 1}, {32768, 16}, {16, 0}}) {
    EXPECT_FALSE(QuadtreeAtlas::create(size, smallest).ok()) << size << ", " << smallest;
  }
}

}  // namespace
}  // namespace sward::impostor
