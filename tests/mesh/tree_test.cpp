#include "mesh/tree.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::mesh {
namespace {

/// A trunk alone.
TreeShape pole() {
  TreeShape shape;
  shape.levels = 1;
  shape.heightVariationM = 0.0;
  shape.heightM = 10.0;
  shape.flare = 0.0;
  shape.leaves = 0;
  shape.level[0].curveSegments = 5;
  return shape;
}

double lengthOf(const Stem& stem) {
  double length = 0.0;
  for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
    length += glm::length(stem.nodes[i].centre - stem.nodes[i - 1].centre);
  }
  return length;
}

TEST(CrownRatio, IsThePapersTable) {
  EXPECT_DOUBLE_EQ(crownRatio(Crown::Conical, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::Conical, 1.0), 1.0);
  EXPECT_NEAR(crownRatio(Crown::Spherical, 0.5), 1.0, 1e-15);
  EXPECT_NEAR(crownRatio(Crown::Hemispherical, 1.0), 1.0, 1e-15);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::Cylindrical, 0.3), 1.0);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::TaperedCylindrical, 0.5), 0.75);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::Flame, 0.7), 1.0);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::Flame, 1.0), 0.0);
  EXPECT_NEAR(crownRatio(Crown::InverseConical, 1.0), 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::TendFlame, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(crownRatio(Crown::TendFlame, 7.0), 0.5) << "taken as 1";
}

TEST(TreeSkeleton, AStraightTrunkIsAsHighAndAsThickAsItSays) {
  const TreeSkeleton tree = growSkeleton(pole(), 1);
  ASSERT_EQ(tree.stems.size(), 1u);
  const Stem& trunk = tree.stems[0];
  EXPECT_EQ(trunk.nodes.size(), 6u);
  EXPECT_NEAR(trunk.nodes.back().centre.z, 10.0, 1e-12);
  EXPECT_NEAR(trunk.nodes.front().radiusM, 0.15, 1e-12);
  EXPECT_NEAR(trunk.nodes.back().radiusM, 0.0, 1e-12) << "taper 1: a cone";
  EXPECT_NEAR(trunk.nodes[2].radiusM, 0.15 * 0.6, 1e-12);
}

TEST(TreeSkeleton, ATrunkTurnsByItsCurve) {
  TreeShape shape = pole();
  shape.level[0].curveDeg = 90.0;
  shape.level[0].curveSegments = 60;
  const Stem trunk = growSkeleton(shape, 1).stems[0];
  // All segments but the first have turned by 59 / 60 of a right angle.
  EXPECT_NEAR(std::acos(trunk.nodes.back().direction.z), glm::radians(90.0 * 59.0 / 60.0), 1e-9);
  // A quarter of a circle of this length: height 2 / pi of it, to the chords' second order.
  EXPECT_NEAR(trunk.nodes.back().centre.z, 10.0 * 2.0 / std::numbers::pi, 0.1);
  shape.level[0].curveBackDeg = -90.0;
  EXPECT_GT(growSkeleton(shape, 1).stems[0].nodes.back().direction.z, 0.99) << "turned there and back";
}

TEST(TreeSkeleton, BranchesFillTheTrunkAboveItsBase) {
  TreeShape shape = pole();
  shape.levels = 2;
  shape.baseSize = 0.4;
  shape.crown = Crown::Cylindrical;
  shape.level[1].branches = 40;
  shape.level[1].length = 0.3;
  shape.level[1].downAngleDeg = 60.0;
  const TreeSkeleton tree = growSkeleton(shape, 3);
  EXPECT_EQ(tree.stems.size(), 41u);
  for (std::size_t i = 1; i < tree.stems.size(); ++i) {
    const Stem& branch = tree.stems[i];
    EXPECT_GE(branch.nodes[0].centre.z, 4.0 - 1e-9);
    EXPECT_NEAR(lengthOf(branch), 3.0, 1e-9) << "a cylinder's crown";
    EXPECT_NEAR(std::acos(branch.nodes[0].direction.z), glm::radians(60.0), 1e-9);
    EXPECT_LE(branch.nodes[0].radiusM, 0.15 * std::pow(0.3, 1.2) + 1e-12);
    EXPECT_LE(branch.nodes[0].radiusM, 0.15 * (1.0 - branch.nodes[0].centre.z / 10.0) + 5e-4 + 1e-9);
  }
}

TEST(TreeSkeleton, ForksShareTheirBranchesAndComeTogether) {
  TreeShape shape = pole();
  shape.levels = 2;
  shape.baseSize = 0.0;
  shape.baseSplits = 2;
  shape.level[0].splitAngleDeg = 25.0;
  shape.level[0].curveSegments = 10;
  shape.level[1].branches = 60;
  const TreeSkeleton tree = growSkeleton(shape, 3);
  int trunks = 0, branches = 0;
  for (const Stem& stem : tree.stems) (stem.level == 0 ? trunks : branches) += 1;
  EXPECT_EQ(trunks, 3);
  EXPECT_NEAR(branches, 60, 6) << "as many as one trunk would have";
  for (const Stem& stem : tree.stems) {
    if (stem.level != 0) continue;
    EXPECT_GT(stem.nodes.back().direction.z, stem.nodes[stem.nodes.size() / 2].direction.z);
  }
}

TEST(TreeSkeleton, AttractionLiftsOrHangsTwigs) {
  const auto meanRise = [](double attraction) {
    TreeShape shape = treePresets()[0].shape;
    shape.attractionUp = attraction;
    double sum = 0.0;
    int count = 0;
    for (const Stem& stem : growSkeleton(shape, 5).stems) {
      if (stem.level != 2) continue;
      sum += stem.nodes.back().direction.z;
      ++count;
    }
    return sum / count;
  };
  const double none = meanRise(0.0);
  EXPECT_GT(meanRise(2.0), none + 0.1);
  EXPECT_LT(meanRise(-2.0), none - 0.1);
}

TEST(Tree, PresetsGrowWhatAnArtistWouldTakeForTheSpecies) {
  for (const TreePreset& preset : treePresets()) {
    const TreeSkeleton tree = growSkeleton(preset.shape, 7);
    const Model model = treeModel(preset.shape, tree, 7);
    const Bounds box = bounds(model);
    EXPECT_GT(box.high.z, 0.6 * preset.shape.heightM) << preset.name;
    EXPECT_LT(box.high.z, 1.4 * (preset.shape.heightM + preset.shape.heightVariationM)) << preset.name;
    EXPECT_GE(box.low.z, 0.0f) << preset.name;
    EXPECT_GT(model.triangles.size(), 20000u) << preset.name;
    EXPECT_LT(model.triangles.size(), 150000u) << preset.name;
    EXPECT_EQ(model.materials.size(), 2u);
    std::size_t leaves = 0;
    for (const std::uint32_t material : model.triangleMaterial) leaves += material;
    EXPECT_EQ(leaves, 2 * tree.leaves.size()) << preset.name;
    for (std::size_t v = 0; v < model.positions.size(); ++v) {
      ASSERT_TRUE(std::isfinite(model.positions[v].x + model.positions[v].y + model.positions[v].z)) << preset.name;
      ASSERT_NEAR(glm::length(model.normals[v]), 1.0f, 1e-4f) << preset.name;
    }
  }
}

TEST(Tree, TheSameSeedGivesTheSameTree) {
  const TreeShape& shape = treePresets()[3].shape;
  const Model a = growTree(shape, 9), b = growTree(shape, 9), c = growTree(shape, 10);
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.colours, b.colours);
  EXPECT_NE(a.positions.size(), c.positions.size());
}

TEST(Tree, OddShapesAreFinite) {
  TreeShape shape = treePresets()[0].shape;
  const auto fine = [&](const char* what) {
    const Model model = growTree(shape, 1);
    for (const glm::vec3& p : model.positions) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << what;
    }
  };
  shape.baseSize = 1.0;
  fine("no crown");
  shape = treePresets()[0].shape;
  shape.heightM = 0.0;
  shape.heightVariationM = 0.0;
  fine("no height");
  shape = treePresets()[0].shape;
  shape.levels = 9;
  shape.leaves = 0;
  fine("more levels than there are");
  shape = treePresets()[0].shape;
  shape.level[1].curveSegments = 0;
  shape.level[1].length = 0.0;
  fine("branches without length");
  shape = treePresets()[0].shape;
  shape.level[0].segmentSplits = 1000.0;
  shape.level[1].branches = 1000000;
  shape.leaves = 1;
  const TreeSkeleton tree = growSkeleton(shape, 1);
  EXPECT_LE(tree.stems.size(), kMostStems);
}

}  // namespace
}  // namespace sward::mesh
