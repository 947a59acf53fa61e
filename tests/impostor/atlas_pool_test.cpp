#include "impostor/atlas_pool.h"

#include "base/random.h"

#include <map>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace sward::impostor {
namespace {

AtlasPool pool(int size, int smallest, int atlases) {
  AtlasBudget budget{size, smallest, 4, 0};
  budget.bytes =
      static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size) * 4u * static_cast<std::uint64_t>(atlases);
  auto made = AtlasPool::create(budget);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

TEST(AtlasPool, OpensAtlasesUpToItsBudget) {
  AtlasPool p = pool(64, 16, 2);
  EXPECT_EQ(p.bytes(), 0u);
  EXPECT_EQ(p.allocate(64, 1)->place, (AtlasPool::Place{0, {0, 0, 64}}));
  EXPECT_EQ(p.allocate(32, 1)->place.atlas, 1);
  EXPECT_EQ(p.atlases(), 2u);
  EXPECT_EQ(p.bytes(), 2u * 64u * 64u * 4u);
  EXPECT_DOUBLE_EQ(p.occupancy(), (1.0 + 0.25) / 2.0);
  EXPECT_FALSE(p.allocate(64, 1)) << "what was drawn in this frame stays";
  EXPECT_FALSE(p.allocate(65, 2));
  EXPECT_FALSE(p.allocate(0, 2));
}

TEST(AtlasPool, WhatWasDrawnLongestAgoGoes) {
  AtlasPool p = pool(64, 16, 1);
  std::vector<AtlasPool::Id> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(p.allocate(32, 1)->id);
  for (const std::size_t i : {0u, 2u, 3u}) EXPECT_TRUE(p.touch(ids[i], 5));
  const auto made = p.allocate(32, 6);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->evicted, std::vector{ids[1]});
  EXPECT_FALSE(p.find(ids[1]));
  EXPECT_FALSE(p.touch(ids[1], 7)) << "a picture that is gone";
  EXPECT_FALSE(p.release(ids[1]));
  // All of the atlas for one picture: the four that are there go, none of which was drawn in frame 9.
  const auto whole = p.allocate(64, 9);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->evicted.size(), 4u);
  EXPECT_EQ(p.pictures(), 1u);
  // Small again: the large one goes, once it was not drawn.
  EXPECT_FALSE(p.allocate(16, 9));
  EXPECT_EQ(p.allocate(16, 10)->evicted, std::vector{whole->id});
}

TEST(AtlasPool, AFullPoolThatIsAllInUseChangesNothing) {
  AtlasPool p = pool(32, 16, 1);
  std::vector<AtlasPool::Id> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(p.allocate(16, 3)->id);
  EXPECT_FALSE(p.allocate(16, 3));
  EXPECT_FALSE(p.allocate(32, 0)) << "the first frame has nothing before it";
  for (const AtlasPool::Id id : ids) EXPECT_TRUE(p.find(id));
  EXPECT_TRUE(p.release(ids[2]));
  EXPECT_TRUE(p.allocate(16, 3)->evicted.empty());
}

TEST(AtlasPool, ThousandsOfPicturesKeepTheirOwnPlaces) {
  AtlasPool p = pool(128, 8, 3);
  base::Random random(3);
  std::map<AtlasPool::Id, AtlasPool::Place> held;
  for (std::uint64_t frame = 1; frame < 4000; ++frame) {
    const auto made = p.allocate(8 << random.index(4), frame);
    ASSERT_TRUE(made);
    for (const AtlasPool::Id id : made->evicted) ASSERT_EQ(held.erase(id), 1u);
    held[made->id] = made->place;
    if (!held.empty() && random.uniform() < 0.3) {
      const auto some = std::next(held.begin(), random.index(static_cast<std::uint32_t>(held.size())));
      ASSERT_TRUE(p.release(some->first));
      held.erase(some);
    }
    for (int i = 0; i < 5 && !held.empty(); ++i) {
      p.touch(std::next(held.begin(), random.index(static_cast<std::uint32_t>(held.size())))->first, frame);
    }
    ASSERT_EQ(p.pictures(), held.size());
  }
  std::set<std::tuple<int, int, int>> cells;
  for (const auto& [id, place] : held) {
    ASSERT_EQ(p.find(id), place);
    for (int y = place.region.y; y < place.region.y + place.region.size; y += 8) {
      for (int x = place.region.x; x < place.region.x + place.region.size; x += 8) {
        ASSERT_TRUE(cells.insert({place.atlas, x, y}).second) << "two pictures in one place";
      }
    }
  }
  EXPECT_GT(p.occupancy(), 0.3);
  EXPECT_LE(p.bytes(), 3u * 128u * 128u * 4u);
}

TEST(AtlasPool, BadBudgetsAreRefused) {
  EXPECT_FALSE(AtlasPool::create({2048, 16, 8, 1000}).ok());
  EXPECT_FALSE(AtlasPool::create({2000, 16, 8, 1u << 30}).ok());
}

}  // namespace
}  // namespace sward::impostor
