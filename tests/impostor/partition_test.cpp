#include "impostor/partition.h"

#include "mesh/tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace sward::impostor {
namespace {

void addTriangle(mesh::Model& model, const glm::vec3& at, float size) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.push_back(at);
  model.positions.push_back(at + glm::vec3(size, 0, 0));
  model.positions.push_back(at + glm::vec3(0, size, 0));
  model.triangles.emplace_back(first, first + 1, first + 2);
  model.triangleMaterial.push_back(0);
}

/// Heaps of small triangles about some places.
mesh::Model heaps(const std::vector<glm::vec3>& places) {
  mesh::Model model;
  model.materials.resize(1);
  for (int i = 0; i < 50; ++i) {
    for (const glm::vec3& place : places) {
      addTriangle(model, place + 0.3f * glm::vec3(std::sin(i * 1.1f), std::cos(i * 2.3f), std::sin(i * 3.7f)), 0.02f);
    }
  }
  return model;
}

Partition cut(const mesh::Model& model, int parts, std::uint64_t seed = 1) {
  auto made = partition(model, parts, seed);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

TEST(PartitionTest, FindsHeapsThatStandApart) {
  const std::vector<glm::vec3> places{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  const Partition out = cut(heaps(places), 4);
  ASSERT_EQ(out.boxes.size(), 4u);
  for (std::size_t t = 0; t < out.ofTriangle.size(); ++t) EXPECT_EQ(out.ofTriangle[t], out.ofTriangle[t % 4]);
  EXPECT_EQ((std::set<std::uint32_t>(out.ofTriangle.begin(), out.ofTriangle.begin() + 4)).size(), 4u);
  EXPECT_NEAR(out.spreadM2, 1.5 * 0.3 * 0.3, 0.01) << "three sines of amplitude 0.3";
}

TEST(PartitionTest, OfATreeIsCompactAndCoversIt) {
  const mesh::Model tree = mesh::growTree(mesh::treePresets()[0].shape, 3);
  double before = std::numeric_limits<double>::infinity();
  for (const int parts : {1, 4, kDefaultParts, 40}) {
    const Partition out = cut(tree, parts);
    EXPECT_EQ(out.boxes.size(), static_cast<std::size_t>(parts));
    ASSERT_EQ(out.ofTriangle.size(), tree.triangles.size());
    for (std::size_t t = 0; t < out.ofTriangle.size(); ++t) {
      const Box& box = out.boxes[out.ofTriangle[t]];
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 p(tree.positions[tree.triangles[t][corner]]);
        ASSERT_TRUE(glm::all(glm::lessThanEqual(box.low, p)) && glm::all(glm::lessThanEqual(p, box.high)));
      }
    }
    EXPECT_LT(out.spreadM2, before);
    before = out.spreadM2;
  }
  // Parts of equal size have radii that fall by the cube root of their number; a crown is no lattice.
  EXPECT_LT(cut(tree, 14).spreadM2, 0.35 * cut(tree, 1).spreadM2);
}

TEST(PartitionTest, LeavesStayWhole) {
  const mesh::Model tree = mesh::growTree(mesh::treePresets()[0].shape, 3);
  const Partition out = cut(tree, 14);
  int leaves = 0;
  for (std::size_t t = 1; t < tree.triangles.size(); ++t) {
    const bool oneLeaf = tree.triangleMaterial[t] == 1 && tree.triangles[t].x == tree.triangles[t - 1].z;
    if (oneLeaf) {
      ++leaves;
      ASSERT_EQ(out.ofTriangle[t], out.ofTriangle[t - 1]);
    }
  }
  EXPECT_GT(leaves, 1000);
}

TEST(PartitionTest, PlanesOfPartsErrLessThanOnePlane) {
  // What the cut is for: seen from elsewhere, parts on planes of their own stand nearer to where they are.
  const mesh::Model tree = mesh::growTree(mesh::treePresets()[0].shape, 3);
  const glm::dvec3 made(30.0, 0.0, 2.0), seen(29.0, 4.0, 2.0);
  const auto worst = [&](int parts) {
    double error = 0.0;
    for (const Box& box : cut(tree, parts).boxes) {
      error = std::max(error, displacement(pictureOf(box, made), box, seen));
    }
    return error;
  };
  EXPECT_LT(worst(kDefaultParts), 0.75 * worst(1));
}

TEST(PartitionTest, FewPiecesSameSeedAndErrors) {
  EXPECT_TRUE(cut(mesh::Model{}, 14).boxes.empty());
  mesh::Model one;
  one.materials.resize(1);
  addTriangle(one, {1, 2, 3}, 0.5f);
  EXPECT_EQ(cut(one, 14).boxes.size(), 1u);
  addTriangle(one, {1, 2, 3}, 0.0f);  // without area
  EXPECT_EQ(cut(one, 3).ofTriangle.size(), 2u);
  const mesh::Model heap = heaps({{0, 0, 0}});
  EXPECT_EQ(cut(heap, 7, 5).ofTriangle, cut(heap, 7, 5).ofTriangle);
  EXPECT_FALSE(partition(heap, 0, 1).ok());
  EXPECT_FALSE(partition(heap, 5000, 1).ok());
}

}  // namespace
}  // namespace sward::impostor
