#include "report/section_leaf_colour.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"
#include "leaf/measured_leaves.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

TEST(LeafColour, SectionHoldsBothModelsAndEveryMeasuredLeaf) {
  const test::TemporaryFolder folder("leaf_colour");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok()) << context.error().text();
  const project::Project project = bake::test::smallProject();
  const auto measured = leafColourSection({project, **context, folder.path(), true}, {});
  ASSERT_TRUE(measured.ok()) << measured.error().text();

  std::map<std::string, int> methods;
  std::map<std::string, std::map<std::string, double>> deltaE;  // by leaf and method
  for (const Row& row : measured->rows) {
    ++methods[row.method];
    const auto& names = row.numbersAndNames;
    if (names.contains("leaf")) {
      deltaE[names.at("leaf")][row.method] = std::stod(names.at("delta_e"));
      EXPECT_GT(row.error.at("rmse"), 0.0);
      EXPECT_GE(row.error.at("max"), row.error.at("rmse"));
    }
    if (row.method.ends_with("_table")) {
      EXPECT_LT(std::stod(names.at("delta_e_max")), 0.5);
      EXPECT_LE(std::stod(names.at("delta_e_mean")), std::stod(names.at("delta_e_max")));
    }
  }
  const int leaves = static_cast<int>(leaf::measuredLeaves().size());
  const std::map<std::string, int> expected{{"plates", 1},
                                            {"plates_table", 1},
                                            {"subtraction", 1},
                                            {"subtraction_table", 1},
                                            {"plates_measured", leaves},
                                            {"subtraction_measured", leaves}};
  EXPECT_EQ(methods, expected);
  for (const auto& [name, byMethod] : deltaE) {
    EXPECT_LT(byMethod.at("plates_measured"), byMethod.at("subtraction_measured")) << name;
  }

  std::set<std::string> pictures;
  for (const Strip& strip : measured->strips) {
    for (const Picture& picture : strip.pictures) {
      EXPECT_TRUE(pictures.insert(picture.name).second) << picture.name;
      ASSERT_FALSE(picture.display.empty());
      const auto [low, high] = std::minmax_element(picture.display.pixels.begin(), picture.display.pixels.end());
      EXPECT_GE(*low, 0.0f);
      EXPECT_LE(*high, 1.0f);
    }
  }
  EXPECT_EQ(pictures.size(), 3u);
}

}  // namespace
}  // namespace sward::report
