#include "report/speed_wither.h"

#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

TEST(WitherSpeed, HasEveryRowWithItsPointsAndVoxels) {
  WitherSpeedSize size;
  size.resolution = 64;
  size.blades = 10;
  size.samples = 3;
  size.proportions[1] = 20.0;
  size.runs = 1;
  const auto rows = witherSpeedRows(size, {});
  ASSERT_TRUE(rows.ok()) << rows.error().text();
  std::map<std::string, int> methods;
  for (const Row& row : *rows) {
    ++methods[row.method];
    ASSERT_TRUE(row.timeMs.has_value()) << row.method;
    EXPECT_TRUE(row.ratio && std::isfinite(*row.ratio) && *row.ratio > 0.0) << row.method;
    EXPECT_FALSE(row.against.empty());
    for (const char* name : {"blades", "points", "voxels", "resolution"}) {
      ASSERT_TRUE(row.numbersAndNames.contains(name)) << row.method << ' ' << name;
      EXPECT_GT(std::stod(row.numbersAndNames.at(name)), 0.0) << row.method << ' ' << name;
    }
  }
  const std::map<std::string, int> expected{{"wither_to_points", 4},
                                            {"wither_step", 4},
                                            {"wither_to_texel", 4},
                                            {"wither_key_frame_bytes", 2},
                                            {"mingle_3", 1}};
  EXPECT_EQ(methods, expected);
}

}  // namespace
}  // namespace sward::report
