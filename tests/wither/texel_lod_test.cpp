#include "wither/texel_lod.h"

#include "trace/occlusion.h"
#include "trace/test_patches.h"
#include "wither/extinction.h"
#include "wither/texel_test_help.h"
#include "wither/voxelise.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::wither {
namespace {

using testing::cube;
using testing::randomTexel;
using testing::sameBytes;
using testing::texelOf;

glm::dvec3 randomDirection(base::Random& random) {
  return glm::normalize(glm::dvec3(random.normal(), random.normal(), random.normal()));
}

Voxel leaves(double density, const std::vector<glm::dvec3>& normals) {
  Voxel voxel;
  voxel.density = static_cast<float>(density);
  std::array<double, 6> sum{};
  for (const glm::dvec3& n : normals) {
    const std::array<double, 6> square{n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
    for (std::size_t i = 0; i < 6; ++i) sum[i] += density * square[i] / static_cast<double>(normals.size());
  }
  for (std::size_t i = 0; i < 6; ++i) voxel.spread[i] = static_cast<float>(sum[i]);
  return voxel;
}

Voxel leavesAllAround(double density) {
  Voxel voxel;
  voxel.density = static_cast<float>(density);
  for (const std::size_t i : {0u, 3u, 5u}) voxel.spread[i] = static_cast<float>(density / 3.0);
  return voxel;
}

TEST(Extinction, IsExactForOneNormalAndForAllAlike) {
  base::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 n = randomDirection(random), l = randomDirection(random);
    // S is of floats: its rounding, 6e-8, is under a root where n.l is near 0.
    EXPECT_NEAR(extinction(leaves(7.0, {n}), l), 7.0 * std::abs(glm::dot(n, l)), 7.0 * std::sqrt(6e-8));
    EXPECT_NEAR(extinction(leavesAllAround(7.0), l), 3.5, 1e-6);
    Voxel bare;  // of no normal: counts as turned all around
    bare.density = 7.0f;
    EXPECT_NEAR(extinction(bare, l), 3.5, 1e-6);
  }
}

TEST(Extinction, OfUprightLeavesOfEveryAzimuth) {
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < 64; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 64.0;
    normals.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const Voxel voxel = leaves(1.0, normals);
  for (int i = 0; i < 32; ++i) {
    const double inclination = std::numbers::pi * i / 64.0;
    const glm::dvec3 l(std::sin(inclination) * std::cos(1.0 * i), std::sin(inclination) * std::sin(1.0 * i),
                       std::cos(inclination));
    EXPECT_NEAR(extinction(voxel, l), 2.0 / std::numbers::pi * std::sin(inclination), 0.003 * 0.64 + 1e-3);
  }
}

Texel slab(const TexelGrid& grid, const Voxel& voxel) {
  std::vector<Texel::Entry> entries;
  for (int i = 0; i < grid.columns * grid.columns * grid.layers; ++i) {
    entries.push_back({{i % grid.columns, i / grid.columns % grid.columns, i / grid.columns / grid.columns}, voxel});
  }
  return texelOf(grid, std::move(entries));
}

TEST(Transmittance, OfAHomogeneousSlabAtEveryDepthAndLevel) {
  base::Random random(4);
  const TexelGrid grid{32, 16, 0.7, 0.5};
  for (const double depth : {1e-6, 0.01, 1.0, 30.0, 1000.0}) {
    const double density = depth / 0.25;  // all around: half of it is seen, over half a metre
    const auto chain = levels(slab(grid, leavesAllAround(density)), 8, {});
    ASSERT_TRUE(chain.ok());
    ASSERT_EQ(chain->size(), 2u);
    for (const Texel& texel : *chain) {
      for (int i = 0; i < 20; ++i) {
        glm::dvec3 l = randomDirection(random);
        l.z = std::copysign(std::max(std::abs(l.z), 0.05), l.z);
        l = glm::normalize(l);
        const glm::dvec3 from(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), l.z > 0.0 ? 0.0 : 0.5);
        const double expected = depth / std::abs(l.z);
        EXPECT_NEAR(opticalDepth(texel, from, l) / expected, 1.0, 1e-5);
        EXPECT_NEAR(transmittance(texel, from, l), std::exp(-expected), 1e-5);
      }
    }
  }
}

TEST(Transmittance, OfAnEmptyTexelAndOutsideOfOne) {
  EXPECT_EQ(transmittance(Texel(), {0.1, 0.2, 0.3}, {0.0, 0.0, 1.0}), 1.0);
  EXPECT_EQ(transmittance(texelOf(cube(8), {}), {0.1, 0.2, 0.3}, {0.0, 0.0, 1.0}), 1.0);
  const Texel texel = slab(cube(8), leavesAllAround(2.0));
  EXPECT_EQ(opticalDepth(texel, {0.1, 0.1, 1.5}, {0.0, 0.0, 1.0}), 0.0);
  EXPECT_EQ(opticalDepth(texel, {0.1, 0.1, -0.5}, {0.0, 0.0, -1.0}), 0.0);
  EXPECT_NEAR(opticalDepth(texel, {0.1, 0.1, 1.5}, {0.0, 0.0, -1.0}), 1.0, 1e-6);
  EXPECT_NEAR(opticalDepth(texel, {0.1, 0.1, -0.5}, {0.0, 0.6, 0.8}), 1.25, 1e-6);
  EXPECT_NEAR(opticalDepth(texel, {0.1, 0.1, 0.25}, {0.0, 0.0, 1.0}), 0.75, 1e-6);
  const double level = opticalDepth(texel, {0.1, 0.1, 0.25}, {1.0, 0.0, 0.0});
  EXPECT_TRUE(std::isfinite(level));
  EXPECT_GT(level, 50.0);
}

TEST(Transmittance, OfAMarchIsTheIntegralOfExtinction) {
  base::Random random(5);
  const Texel texel = randomTexel(cube(16), 0.3, 9);
  for (int i = 0; i < 10; ++i) {
    glm::dvec3 l = randomDirection(random);
    l.z = std::copysign(std::max(std::abs(l.z), 0.2), l.z);
    l = glm::normalize(l);
    const glm::dvec3 from(random.uniform(), random.uniform(), random.uniform());
    constexpr int kSteps = 200000;
    const double length = (l.z > 0.0 ? 1.0 - from.z : from.z) / std::abs(l.z);
    double sum = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const glm::dvec3 p = from + (k + 0.5) / kSteps * length * l;
      const glm::ivec3 cell(glm::floor(16.0 * p));
      const Voxel* voxel = texel.at({(cell.x % 16 + 16) % 16, (cell.y % 16 + 16) % 16, std::clamp(cell.z, 0, 15)});
      if (voxel != nullptr) sum += extinction(*voxel, l);
    }
    // Each of some 100 borders is off by half a step at most, of extinctions up to 400.
    EXPECT_NEAR(opticalDepth(texel, from, l), sum * length / kSteps, 100.0 * 0.5 * 400.0 * length / kSteps);
  }
}

TEST(Levels, ConserveTheOpacityOfTheirChildrenAlongTheAxes) {
  const Texel fine = randomTexel({32, 16, 1.0, 0.3}, 0.4, 21);
  const auto half = halved(fine, {});
  ASSERT_TRUE(half.ok());
  const glm::dvec3 size = fine.grid().voxelM();
  for (std::size_t v = 0; v < half->size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 l(0.0);
      l[axis] = 1.0;
      double mean = 0.0;
      for (int column = 0; column < 4; ++column) {
        double depth = 0.0;
        for (int along = 0; along < 2; ++along) {
          glm::ivec3 at = 2 * glm::ivec3(half->places()[v]);
          at[axis] += along;
          at[(axis + 1) % 3] += column % 2;
          at[(axis + 2) % 3] += column / 2;
          if (const Voxel* child = fine.at(at)) depth += extinction(*child, l) * size[axis];
        }
        mean += 0.25 * std::exp(-depth);
      }
      const double now = std::exp(-extinction(half->voxels()[v], l) * 2.0 * size[axis]);
      ASSERT_NEAR(now, mean, 2e-6) << v << ' ' << axis;
    }
    ASSERT_LE(std::abs(glm::length(half->voxels()[v].normal) - 0.5f), 0.5f + 1e-5f);
  }
  EXPECT_LT(half->areaM2(), fine.areaM2());
}

TEST(Levels, KeepWhatASingleLeafIs) {
  const Voxel one = leaves(3.0, {glm::normalize(glm::dvec3(1.0, 2.0, 3.0))});
  Voxel leaf = one;
  leaf.normal = glm::normalize(glm::vec3(1.0f, 2.0f, 3.0f));
  leaf.tangent = glm::vec3(0.0f, 0.0f, 1.0f);
  leaf.diffuse = {0.1f, 0.2f, 0.3f};
  leaf.specular = 0.5f;
  const auto half = halved(texelOf(cube(16), {{{5, 6, 7}, leaf}}), {});
  ASSERT_TRUE(half.ok());
  ASSERT_EQ(half->size(), 1u);
  const Voxel* voxel = half->at({2, 3, 3});
  ASSERT_NE(voxel, nullptr);
  EXPECT_NEAR(glm::length(voxel->normal - leaf.normal), 0.0f, 1e-6f);
  EXPECT_NEAR(glm::length(voxel->diffuse - leaf.diffuse), 0.0f, 1e-6f);
  EXPECT_NEAR(voxel->specular, 0.5f, 1e-6f);
  // An eighth of the density, less what its column hides behind itself.
  EXPECT_LT(voxel->density, 3.0f / 8.0f);
  EXPECT_GT(voxel->density, 0.8f * 3.0f / 8.0f);
}

TEST(Levels, OfOpaqueThinAndEmptyTexelsAreFinite) {
  // Between 1e-15 and 1e-19 a transmittance rounds to 1, or to what lies next to it.
  for (const float density : {1e-30f, 1e-20f, 3e-17f, 1e-16f, 1e-15f, 1e-6f, 1e6f, 1e12f}) {
    Voxel voxel = leavesAllAround(static_cast<double>(density));
    const auto chain =
        levels(texelOf(cube(32), {{{0, 0, 0}, voxel}, {{31, 31, 31}, voxel}, {{30, 31, 31}, voxel}}), 8, {});
    ASSERT_TRUE(chain.ok());
    ASSERT_EQ(chain->size(), 3u);
    for (const Texel& texel : *chain) {
      for (const Voxel& v : texel.voxels()) {
        ASSERT_TRUE(std::isfinite(v.density));
        for (const float s : v.spread) ASSERT_TRUE(std::isfinite(s));
      }
      ASSERT_NE(texel.at({0, 0, 0}), nullptr);
    }
    if (density > 1e-5f) continue;
    // So thin that nothing hides anything: the area is shared by eight, to the precision of a float.
    EXPECT_NEAR((*chain)[1].at({0, 0, 0})->density / density, 0.125f, 1e-5f);
    EXPECT_NEAR((*chain)[2].at({0, 0, 0})->density / density, 0.125f / 8.0f, 1e-5f);
  }
  const auto none = levels(texelOf(cube(64), {}), 32, {});
  ASSERT_TRUE(none.ok());
  EXPECT_EQ(none->size(), 2u);
  EXPECT_FALSE(halved(texelOf(cube(8), {}), {}).ok());
}

/// What a splat's tail leaves: so little along one axis that the mean transmittance is 1, and more along another.
TEST(Levels, LeavesThatHideNothingAlongAnAxisAreFinite) {
  for (const float along : {0.0f, 1e-36f, 1e-24f, 1e-12f}) {
    Voxel voxel;
    voxel.density = 3.0f + along;
    voxel.normal = {1.0f, 0.0f, 0.0f};
    voxel.spread = {2.0f, 0.5f, 0.0f, 1.0f, 0.0f, along};  // two axes: one alone is scaled in one step
    Voxel thin;
    thin.density = std::numeric_limits<float>::min();
    thin.normal = {0.0f, 0.0f, 1.0f};
    thin.spread = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, thin.density};
    for (const Voxel& other : {voxel, thin}) {
      const auto half = halved(texelOf(cube(16), {{{0, 0, 0}, other}, {{1, 1, 1}, thin}}), {});
      ASSERT_TRUE(half.ok());
      ASSERT_EQ(half->size(), 1U);
      const Voxel& v = half->voxels()[0];
      EXPECT_TRUE(std::isfinite(v.density) && v.density > 0.0f) << along;
      for (const float s : v.spread) EXPECT_TRUE(std::isfinite(s)) << along;
      if (other.density > 1.0f) {
        EXPECT_GT(v.spread[0], 0.0f);
      }
    }
  }
}

TEST(Opaque, AVoxelLetsThroughWhatItsLeafDoesNotCover) {
  for (const double share : {0.0, 1e-6, 0.1, 0.5, 0.9, 0.99}) {
    // Upright leaves facing x, whose area is a share of the voxel's face.
    const Texel texel = texelOf(cube(8), {{{2, 3, 4}, leaves(share * 8.0, {{1.0, 0.0, 0.0}})}});
    const auto out = opaque(texel, {});
    ASSERT_TRUE(out.ok());
    EXPECT_NEAR(transmittance(*out, {0.01, 0.45, 0.55}, {1.0, 0.0, 1e-9}), std::pow(1.0 - share, 64.0), 1e-5);
    if (share == 0.0) continue;
    EXPECT_NEAR(extinction(out->voxels()[0], {0.0, 0.0, 1.0}), 0.0, 1e-6);
    // All around: every axis sees half.
    const auto around = opaque(texelOf(cube(8), {{{2, 3, 4}, leavesAllAround(share * 8.0)}}), {});
    for (const glm::dvec3& l : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
      EXPECT_NEAR(std::exp(-extinction(around->voxels()[0], l) / 8.0), 1.0 - 0.5 * share, 1e-6);
    }
  }
}

TEST(Opaque, NoVoxelHidesLessThanBeforeAndAllAreFinite) {
  for (const Texel& texel :
       {randomTexel(cube(16), 0.4, 6), slab(cube(8), leavesAllAround(1e9)), texelOf(cube(8), {})}) {
    const auto out = opaque(texel, {});
    ASSERT_TRUE(out.ok());
    ASSERT_EQ(out->size(), texel.size());
    for (std::size_t i = 0; i < texel.size(); ++i) {
      for (const glm::dvec3& l : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
        const double now = extinction(out->voxels()[i], l), before = extinction(texel.voxels()[i], l);
        ASSERT_TRUE(std::isfinite(now));
        ASSERT_GE(now, before * (1.0 - 1e-5));
      }
    }
  }
}

TEST(Levels, ThreadsGiveTheSameBytes) {
  const Texel fine = randomTexel(cube(32), 0.2, 8);
  JobContext one, two;
  one.threads = 1;
  two.threads = 3;
  EXPECT_TRUE(sameBytes(*halved(fine, one), *halved(fine, two)));
}

/// Small leaves at random places and of random directions, on a square metre.
std::shared_ptr<scene::Patch> confetti(int count, float side, float heightM) {
  base::Random random(17);
  mesh::Model model;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 n = randomDirection(random), a = glm::normalize(glm::cross(n, randomDirection(random)));
    const glm::dvec3 at(random.uniform(), random.uniform(), random.uniform(0.1, 0.9) * static_cast<double>(heightM));
    trace::testing::addQuad(model, glm::vec3(at), side * glm::vec3(a), side * glm::vec3(glm::cross(n, a)));
  }
  return trace::testing::patchOf(std::move(model), 1.0, heightM);
}

TEST(Transmittance, OfManySmallLeavesIsThatOfRaysThroughThem) {
  const auto patch = confetti(3000, 0.02f, 0.5f);
  const auto scene = trace::testing::sceneOf(patch);
  ASSERT_NE(scene, nullptr);
  const auto chain = levels(voxelise(*patch, {32, 16, 1.0, 0.5}, nullptr, {})->texel, 8, {});
  ASSERT_TRUE(chain.ok());
  const auto hiding = opaque(chain->front(), {});
  ASSERT_TRUE(hiding.ok());
  for (const glm::dvec3& l : {glm::dvec3(0.0, 0.0, 1.0), glm::normalize(glm::dvec3(1.0, 0.5, 1.0))}) {
    base::Random random(23);
    constexpr int kRays = 4000;
    trace::OcclusionBatch rays;
    std::array<double, 3> through{};
    double throughOpaque = 0.0;
    for (int i = 0; i < kRays; ++i) {
      const glm::dvec3 from(random.uniform(), random.uniform(), 0.0);
      rays.add(glm::vec3(from), static_cast<std::uint32_t>(i));
      for (std::size_t k = 0; k < chain->size(); ++k) through[k] += transmittance((*chain)[k], from, l) / kRays;
      throughOpaque += transmittance(*hiding, from, l) / kRays;
    }
    rays.trace(scene->impl(), l);
    double free = 0.0;
    for (std::size_t i = 0; i < kRays; ++i) free += rays.occluded(i) ? 0.0 : 1.0 / kRays;
    // Sampling: four deviations of 0.5 / sqrt(4000). Leaves in one voxel: one that hides f of it lets 1 - f pass, the
    // texel exp(-f), f = 0.2 on average: the texel's depth is 10 % too small, which is 0.04 of exp(-0.6) to exp(-0.9).
    EXPECT_NEAR(through[0], free, 0.032 + 0.04);
    EXPECT_NEAR(through[1], through[0], 0.03);
    // Without that part: leaves that cross in one voxel and seams between voxels remain.
    EXPECT_NEAR(throughOpaque, free, 0.032 + 0.02);
    EXPECT_LT(throughOpaque, through[0]);
    EXPECT_GT(free, 0.2);
    EXPECT_LT(free, 0.8);
  }
}

}  // namespace
}  // namespace sward::wither
