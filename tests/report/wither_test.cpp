#include "report/section_wither.h"

#include "report/wither_bench.h"
#include "wither/extinction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

WitherSize smallSize() {
  WitherSize size;
  size.resolution = 64;
  size.blades = 60;
  size.weatherings = {0.0, 0.6, 1.0};
  size.proportions = {1.0, 30.0};
  size.draws = 2;
  size.mingled = {1, 3};
  size.keyResolution = 32;
  size.keyErrors = {0.3};
  size.keyHeldOut = 2;
  size.mostFrames = 5;
  return size;
}

/// Covers are summed voxel by voxel; marching the very same rays has to give the same.
TEST(WitherBench, CoverIsThatOfMarchedRays) {
  const auto bench = WitherBench::create(40, 32, 3, {});
  ASSERT_TRUE(bench.ok()) << bench.error().text();
  const auto texel = bench->direct(0.8, {});
  ASSERT_TRUE(texel.ok()) << texel.error().text();
  const Cover cover = coverOf(*texel);
  ASSERT_EQ(cover.cells, 4);
  const double column = texel->grid().sideM / 32.0;
  const glm::dvec3 views[] = {{0.0, 0.0, 1.0}, {std::numbers::sqrt2 / 2.0, 0.0, std::numbers::sqrt2 / 2.0}};
  const int fine[] = {1, 4};
  for (std::size_t view = 0; view < Cover::kViews; ++view) {
    std::vector<double> cells(16, 0.0);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32 * fine[view]; ++x) {
        const glm::dvec3 from((x + 0.5) / fine[view] * column, (y + 0.5) * column, 0.0);
        const std::size_t cell = static_cast<std::size_t>(y / 8 * 4 + x / fine[view] / 8);
        cells[cell] += -std::expm1(-wither::opticalDepth(*texel, from, views[view])) / (64.0 * fine[view]);
      }
    }
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_NEAR(cover.opacity[view][i], cells[i], 1e-6) << view;
    EXPECT_GT(cover.mean(view), 0.0);
  }
}

TEST(WitherSection, PointsComeNearerWithTheirProportionAndThePapersMotionDoesNot) {
  const auto section = witherSection(smallSize(), {});
  ASSERT_TRUE(section.ok()) << section.error().text();
  std::map<std::string, int> methods;
  std::map<std::string, double> points, paper;  // rmse by weathering
  for (const Row& row : section->rows) {
    ++methods[row.method];
    for (const auto& [name, value] : row.error) EXPECT_TRUE(std::isfinite(value)) << row.method << ' ' << name;
    for (const auto& [name, value] : row.numbersAndNames) EXPECT_NE(value, "null") << row.method << ' ' << name;
    const auto& names = row.numbersAndNames;
    if (row.method == "points") {
      const double rmse = row.error.at("rmse");
      const auto [before, first] = points.try_emplace(names.at("weathering"), rmse);
      if (!first) {
        EXPECT_LT(rmse, before->second) << names.at("weathering");
      }
      before->second = rmse;
      EXPECT_LT(std::abs(std::stod(names.at("area_error"))), 0.02);
    }
    if (row.method == "paper_motion") paper[names.at("weathering")] = row.error.at("rmse");
    if (row.method == "blade_length" && names.at("motion") == "\"ours\"") {
      EXPECT_LT(row.error.at("max"), 1e-3);
    }
    if (row.method == "season_step") {
      // Second order once steps are well below the response of 0.04.
      if (std::stoi(names.at("steps")) >= 256) {
        EXPECT_NEAR(std::stod(names.at("order")), 2.0, 0.15);
      }
    }
    if (row.method == "mingled" && names.at("samples") == "1") {
      EXPECT_EQ(row.error.at("max"), 0.0);
    }
  }
  EXPECT_GT(paper.at("1"), 2.0 * points.at("1"));
  const std::map<std::string, int> expected{{"points", 6},       {"paper_motion", 3}, {"blade_length", 6},
                                            {"season_step", 18}, {"autumn", 3},       {"mingled", 2},
                                            {"packed", 1},       {"key_frames", 1}};
  EXPECT_EQ(methods, expected);
  ASSERT_EQ(section->strips.size(), 1u);
  for (const Picture& picture : section->strips.front().pictures) {
    const auto [low, high] = std::minmax_element(picture.display.pixels.begin(), picture.display.pixels.end());
    EXPECT_GE(*low, 0.0f);
    EXPECT_LE(*high, 1.0f);
  }
  std::set<std::string> plots;
  for (const Plot& plot : section->plots) EXPECT_TRUE(plots.insert(plot.name).second) << plot.name;
}

}  // namespace
}  // namespace sward::report
