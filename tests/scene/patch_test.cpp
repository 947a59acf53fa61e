#include "scene/patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::scene {
namespace {

/// A vertical triangle of height 1, and a wide one of height 2 (the second with a stray vertex that no triangle uses).
std::vector<std::shared_ptr<const mesh::Model>> twoModels() {
  mesh::Model a;
  a.positions = {{-0.1f, 0.0f, 0.0f}, {0.1f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
  a.triangles = {{0, 1, 2}};
  mesh::Model b = a;
  b.positions[2].z = 2.0f;
  b.positions.emplace_back(0.0f, 0.0f, 50.0f);
  return {std::make_shared<mesh::Model>(a), std::make_shared<mesh::Model>(b)};
}

PlantScatter plant(double count, std::vector<std::uint32_t> models = {0}) {
  PlantScatter p;
  p.count = count;
  p.models = std::move(models);
  return p;
}

glm::vec3 foot(const Instance& instance) {
  return instance.worldFromModel[3];
}

/// Variance over mean of the plants in the cells of a k x k grid: 1 for independent places, below for even ones.
double dispersion(const Patch& patch, int k) {
  std::vector<double> cells(static_cast<std::size_t>(k * k), 0.0);
  for (const Instance& instance : patch.instances) {
    const auto x = static_cast<int>(static_cast<double>(foot(instance).x) / patch.sideM * k);
    const auto y = static_cast<int>(static_cast<double>(foot(instance).y) / patch.sideM * k);
    cells[static_cast<std::size_t>(std::min(y, k - 1) * k + std::min(x, k - 1))] += 1.0;
  }
  const double mean = static_cast<double>(patch.instances.size()) / static_cast<double>(cells.size());
  double sum = 0.0;
  for (const double c : cells) sum += (c - mean) * (c - mean);
  return sum / static_cast<double>(cells.size()) / mean;
}

TEST(Scatter, IsTheSameForTheSameSeed) {
  const Patch a = scatter(2.0, twoModels(), {plant(100, {0, 1})}, 5),
              b = scatter(2.0, twoModels(), {plant(100, {0, 1})}, 5);
  const Patch c = scatter(2.0, twoModels(), {plant(100, {0, 1})}, 6);
  ASSERT_EQ(a.instances.size(), 100u);
  ASSERT_EQ(b.instances.size(), 100u);
  bool differs = false;
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(a.instances[i].worldFromModel, b.instances[i].worldFromModel);
    EXPECT_EQ(a.instances[i].model, b.instances[i].model);
    differs = differs || a.instances[i].worldFromModel != c.instances[i].worldFromModel;
  }
  EXPECT_TRUE(differs);
}

TEST(Scatter, AddingAKindMovesNoOther) {
  const Patch one = scatter(1.0, twoModels(), {plant(40)}, 5),
              two = scatter(1.0, twoModels(), {plant(40), plant(9, {1})}, 5);
  ASSERT_EQ(two.instances.size(), 49u);
  for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(one.instances[i].worldFromModel, two.instances[i].worldFromModel);
}

TEST(Scatter, KeepsFeetInsideTheSquareAtAnyClumping) {
  for (const double clumping : {0.0, 0.5, 1.0}) {
    for (const double side : {1e-3, 1.0, 1000.0}) {
      PlantScatter p = plant(500);
      p.clumping = clumping;
      const Patch patch = scatter(side, twoModels(), {p}, 3);
      ASSERT_EQ(patch.instances.size(), 500u);
      for (const Instance& instance : patch.instances) {
        for (int axis = 0; axis < 2; ++axis) {
          EXPECT_GE(foot(instance)[axis], 0.0f);
          EXPECT_LT(foot(instance)[axis], static_cast<float>(side));
        }
        EXPECT_EQ(foot(instance).z, 0.0f);
      }
    }
  }
}

TEST(Scatter, IsEvenWithoutClumpingAndClusteredWithIt) {
  PlantScatter even = plant(1600), half = even, strong = even;
  half.clumping = 0.5;
  strong.clumping = 1.0;
  const double a = dispersion(scatter(1.0, twoModels(), {even}, 1), 20);
  const double b = dispersion(scatter(1.0, twoModels(), {half}, 1), 20);
  const double c = dispersion(scatter(1.0, twoModels(), {strong}, 1), 20);
  EXPECT_LT(a, 0.5);
  EXPECT_GT(b, 1.2 * a);
  EXPECT_GT(c, 2.0);
}

TEST(Scatter, SettlesFractionsOfACountByChance) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const std::size_t count = scatter(1.0, twoModels(), {plant(2.25)}, seed).instances.size();
    ASSERT_TRUE(count == 2 || count == 3);
    sum += static_cast<double>(count);
  }
  EXPECT_NEAR(sum / 2000.0, 2.25, 5.0 * std::sqrt(0.25 * 0.75 / 2000.0));
}

TEST(Scatter, TurnsTiltsAndScalesWithinItsRanges) {
  PlantScatter p = plant(4000);
  p.sizeVariation = 0.2;
  p.tiltDeg = 5.0;
  const Patch patch = scatter(1.0, twoModels(), {p}, 11);
  double meanScale = 0.0, variance = 0.0, turnX = 0.0, turnY = 0.0, largestTilt = 0.0;
  for (const Instance& instance : patch.instances) {
    const glm::dmat3 m(instance.worldFromModel);
    const double scale = glm::length(m[2]);
    EXPECT_NEAR(glm::determinant(m), scale * scale * scale, 1e-5);  // a rotation and one scale, not mirrored
    EXPECT_NEAR(glm::dot(m[0], m[1]), 0.0, 1e-5);
    EXPECT_GE(scale, 0.6 - 1e-5);
    EXPECT_LE(scale, 1.4 + 1e-5);
    meanScale += scale / 4000.0;
    variance += (scale - 1.0) * (scale - 1.0) / 4000.0;
    largestTilt = std::max(largestTilt, std::acos(std::min(1.0, m[2].z / scale)) * 180.0 / std::numbers::pi);
    turnX += m[0].x / scale / 4000.0;
    turnY += m[0].y / scale / 4000.0;
  }
  EXPECT_NEAR(meanScale, 1.0, 0.02);
  // A standard normal cut at two has the variance 1 - 4 phi(2) / (2 Phi(2) - 1) = 0.7737.
  EXPECT_NEAR(variance, 0.04 * 0.7737, 0.003);
  EXPECT_LE(largestTilt, 5.0 + 0.05);
  EXPECT_GT(largestTilt, 4.5);
  EXPECT_NEAR(turnX, 0.0, 0.06);
  EXPECT_NEAR(turnY, 0.0, 0.06);
}

TEST(Scatter, HeightIsTheTopOfTheHighestInstance) {
  PlantScatter p = plant(50, {0, 1});
  p.tiltDeg = 30.0;
  const auto models = twoModels();
  const Patch patch = scatter(1.0, models, {p}, 2);
  float top = 0.0f;
  for (const Instance& instance : patch.instances) {
    const mesh::Model& model = *models[instance.model];
    for (int corner = 0; corner < 3; ++corner) {
      top = std::max(top,
                     (instance.worldFromModel * glm::vec4(model.positions[static_cast<std::size_t>(corner)], 1.0f)).z);
    }
  }
  EXPECT_EQ(patch.heightM, static_cast<double>(top));
  EXPECT_LT(patch.heightM, 10.0);  // the unused vertex at 50 does not count
}

TEST(Scatter, PicksEveryVariantButNoEmptyOne) {
  auto models = twoModels();
  models.push_back(std::make_shared<mesh::Model>());
  const Patch patch = scatter(1.0, models, {plant(200, {0, 1, 2})}, 4);
  ASSERT_EQ(patch.instances.size(), 200u);
  std::array<int, 3> picked{};
  for (const Instance& instance : patch.instances) ++picked[instance.model];
  EXPECT_GT(picked[0], 60);
  EXPECT_GT(picked[1], 60);
  EXPECT_EQ(picked[2], 0);
  EXPECT_TRUE(scatter(1.0, models, {plant(200, {2})}, 4).instances.empty());
}

TEST(Scatter, NothingToScatterGivesAnEmptyPatch) {
  for (const auto& plants : {std::vector<PlantScatter>{}, {plant(0)}, {plant(-3)}, {plant(NAN)}, {plant(5, {})}}) {
    const Patch patch = scatter(1.0, twoModels(), plants, 1);
    EXPECT_TRUE(patch.instances.empty());
    EXPECT_EQ(patch.heightM, 0.0);
    EXPECT_EQ(patch.sideM, 1.0);
  }
}

}  // namespace
}  // namespace sward::scene
