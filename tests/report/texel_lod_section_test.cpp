#include "report/section_texel_lod.h"

#include "bake/small_project.h"
#include "report/lod_levels.h"
#include "wither/texel_lod.h"

#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

TEST(TexelLodSection, LevelsThatKeepOpacityAreBetterThanThoseOfMeanDensity) {
  TexelLodSize size;
  size.conesColumns = 64;
  size.cones = 100;
  size.patchColumns = 64;
  size.coarsest = 16;
  size.azimuths = 2;
  size.marches = 32;
  size.rays = 96;
  const auto section = texelLodSection(size, bake::test::smallProject(), {});
  ASSERT_TRUE(section.ok()) << section.error().text();
  std::map<std::string, int> methods;
  std::map<std::string, double> change, bias;  // by method; the coarsest level's, which comes last
  for (const Row& row : section->rows) {
    ++methods[row.method];
    for (const auto& [name, value] : row.error) EXPECT_TRUE(std::isfinite(value)) << row.method << ' ' << name;
    for (const auto& [name, value] : row.numbersAndNames) EXPECT_NE(value, "null") << row.method << ' ' << name;
    if (row.method.ends_with("_traced")) continue;
    ASSERT_TRUE(row.bytes.has_value()) << row.method;
    bias[row.method] = row.error.at("bias");
    if (row.numbersAndNames.contains("change_rmse")) {
      change[row.method] = std::stod(row.numbersAndNames.at("change_rmse"));
      EXPECT_GT(change[row.method], 0.0);
    }
  }
  const std::map<std::string, int> expected{
      {"cones_traced", 1}, {"cones_as_voxelised", 1}, {"cones", 3}, {"cones_mean_density", 2},
      {"patch_traced", 1}, {"patch_as_voxelised", 1}, {"patch", 3}, {"patch_mean_density", 2}};
  EXPECT_EQ(methods, expected);
  // The same rays march through all levels, so that noise is common to them.
  EXPECT_LT(change.at("patch"), 0.5 * change.at("patch_mean_density"));
  EXPECT_LT(std::abs(bias.at("patch")), std::abs(bias.at("patch_mean_density")));
  EXPECT_LT(bias.at("patch_mean_density"), 0.0);
}

TEST(LodLevels, MeanDensityKeepsTheLeafArea) {
  const wither::TexelGrid grid{16, 16, 1.0, 0.5};
  std::vector<wither::Texel::Entry> entries;
  for (int i = 0; i < 40; ++i) {
    wither::Voxel voxel;
    voxel.density = 1.0f + static_cast<float>(i);
    entries.push_back({{i % 8, i / 8, i % 5}, voxel});
  }
  const auto fine = wither::Texel::fromEntries(grid, entries);
  ASSERT_TRUE(fine.ok()) << fine.error().text();
  const auto half = meanDensityHalved(*fine);
  ASSERT_TRUE(half.ok()) << half.error().text();
  EXPECT_EQ(half->grid().columns, 8);
  EXPECT_NEAR(half->areaM2() / fine->areaM2(), 1.0, 1e-6);
  EXPECT_LT(half->size(), fine->size());
  const auto none = marchedThrough(*wither::Texel::fromEntries(grid, {}), {{0.0, 0.0, 1.0}}, 4, {});
  ASSERT_TRUE(none.ok());
  EXPECT_EQ(none->mean.front(), 1.0);
  EXPECT_EQ(none->error.front(), 0.0);
}

}  // namespace
}  // namespace sward::report
