#include "bake/ground_plan.h"

#include "bake/bake.h"
#include "bake/small_project.h"

#include <gtest/gtest.h>

namespace sward::bake {
namespace {

TEST(GroundPlan, NamesThePatchColumnOfEveryTexel) {
  Baker baker;
  const auto ground = baker.ground(test::smallProject(), {});
  ASSERT_TRUE(ground.ok()) << ground.error().text();
  const GroundBake& bake = **ground;
  const trace::GroundPlan plan = groundPlan(bake);
  EXPECT_EQ(plan.patchSideM, bake.patchSideM);
  EXPECT_EQ(plan.patchTexels, 32);
  EXPECT_EQ(plan.tileTexels, 16);
  EXPECT_DOUBLE_EQ(plan.tileSideM(), bake.tileSideM());
  ASSERT_EQ(plan.offsets.size(), bake.tiles.tiles.size());
  ASSERT_GT(plan.offsets.size(), 1u);
  std::size_t texel = 0;
  for (std::size_t tile = 0; tile < plan.offsets.size(); ++tile) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x, ++texel) {
        const glm::ivec2 offset = plan.offsets[tile][plan.owner[texel]];
        const auto modulo = [](int v) { return (v % 32 + 32) % 32; };
        ASSERT_EQ(static_cast<std::uint32_t>(modulo(y + offset.y) * 32 + modulo(x + offset.x)),
                  bake.tiles.patchColumn(static_cast<int>(tile), x, y));
      }
    }
  }
  EXPECT_EQ(texel, plan.owner.size());
  EXPECT_EQ(plan.mapWidth, bake.map.width);
  EXPECT_EQ(plan.mapHeight, bake.map.height);
  EXPECT_EQ(plan.map, bake.map.tiles);
}

}  // namespace
}  // namespace sward::bake
