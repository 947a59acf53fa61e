#include "wither/points.h"

#include "wither/test_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

constexpr TexelGrid kGrid{32, 32, 1.0, 0.5};

Texel splat(const Points& points, double sigma = 0.6, const TexelGrid& grid = kGrid, int threads = 0) {
  JobContext job;
  job.threads = threads;
  return pointsToTexel(points, grid, sigma, job).value();
}

Points scattered(int count, std::uint64_t seed) {
  base::Random random(seed);
  Points points;
  for (int i = 0; i < count; ++i) {
    Points one = pointAt({random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), random.uniform(-0.1, 0.6)},
                         static_cast<float>(random.uniform(0.0, 1e-3)));
    one.normals[0] = glm::normalize(glm::vec3(random.normal(), random.normal(), random.normal()));
    const glm::vec3 n = one.normals[0];
    one.spread[0] = {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
    one.tangents[0] = glm::normalize(glm::vec3(random.normal(), random.normal(), random.normal()));
    one.diffuse[0] = {random.uniform(), random.uniform(), random.uniform()};
    add(points, one);
  }
  return points;
}

/// One point against the formula, with the weights' sum taken over the voxels that there are.
TEST(PointsToTexel, FollowsTheFormula) {
  const glm::dvec3 edge = kGrid.voxelM();
  for (const double sigma : {0.3, 0.6, 1.0}) {
    const int reach = sigma > 0.7 ? 2 : 1;
    for (const glm::dvec3& at :
         {glm::dvec3(10.2, 7.9, 12.5), glm::dvec3(0.1, 31.9, 0.2), glm::dvec3(8.0, 16.0, 31.7)}) {
      const Texel texel = splat(pointAt(glm::vec3(at * edge), 2e-4f), sigma);
      const glm::ivec3 cell(at);
      double sum = 0.0;
      const auto weight = [&](const glm::ivec3& v) {
        const glm::dvec3 d = glm::dvec3(v) + 0.5 - at;
        return std::exp(-glm::dot(d, d) / (2.0 * sigma * sigma));
      };
      const auto each = [&](auto&& visit) {
        for (int z = -reach; z <= reach; ++z) {
          if (cell.z + z < 0 || cell.z + z >= 32) continue;
          for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) visit(cell + glm::ivec3(x, y, z));
          }
        }
      };
      each([&](const glm::ivec3& v) { sum += weight(v); });
      each([&](const glm::ivec3& v) {
        const Voxel* voxel = texel.at({(v.x + 32) % 32, (v.y + 32) % 32, v.z});
        ASSERT_NE(voxel, nullptr);
        const double density = 2e-4 * weight(v) / sum / kGrid.voxelVolumeM3();
        // The place is stored in single precision: 2e-6 voxels, times the slope of the exponent, at most 2.5 / sigma^2.
        EXPECT_NEAR(voxel->density / density, 1.0, 1e-4);
        EXPECT_NEAR(voxel->spread[3], voxel->density, 1e-5f * voxel->density);  // n = y: all of it is yy
        EXPECT_EQ(voxel->spread[0], 0.0f);
        EXPECT_LT(glm::length(voxel->diffuse - glm::vec3(0.1f, 0.2f, 0.3f)), 1e-6f);
        EXPECT_NEAR(voxel->specular, 0.5f, 1e-6f);
      });
    }
  }
}

TEST(PointsToTexel, KeepsLeafArea) {
  const Points points = scattered(3000, 5);
  for (const double sigma : {0.0, 0.05, 0.1, 0.3, 0.6, 0.71, 1.0, 50.0, 1e9}) {
    const Texel texel = splat(points, sigma);
    EXPECT_NEAR(texel.areaM2() / points.totalAreaM2(), 1.0, 1e-5) << sigma;
    for (const Voxel& voxel : texel.voxels()) {
      ASSERT_GT(voxel.density, 0.0f);
      const float trace = voxel.spread[0] + voxel.spread[3] + voxel.spread[5];
      EXPECT_NEAR(trace, voxel.density, 1e-4f * voxel.density);
    }
  }
}

TEST(PointsToTexel, SmallSigmaFillsTheVoxelItIsIn) {
  const Texel texel = splat(pointAt({0.51f, 0.51f, 0.26f}), 0.1);
  const Voxel* voxel = texel.at({16, 16, 16});
  ASSERT_NE(voxel, nullptr);
  EXPECT_GT(voxel->density * kGrid.voxelVolumeM3(), 0.99);
}

TEST(PointsToTexel, IsPeriodicAndBoundByGroundAndTop) {
  const Points inside = pointAt({0.01f, 0.99f, 0.2f});
  const Points outside = pointAt({-2.99f, 4.99f, 0.2f});
  const Texel a = splat(inside), b = splat(outside);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.places()[i], b.places()[i]);
    EXPECT_NEAR(a.voxels()[i].density, b.voxels()[i].density, 2e-4f * a.voxels()[i].density);
  }
  EXPECT_TRUE(sameBytes(splat(pointAt({0.5f, 0.5f, -7.0f})), splat(pointAt({0.5f, 0.5f, 0.0f}))));
  EXPECT_EQ(splat(pointAt({0.5f, 0.5f, 1e9f})).places().back().z, 31);
  const TexelGrid small{8, 8, 1.0, 1.0};  // one brick, which repeats into itself
  EXPECT_NEAR(splat(scattered(100, 2), 1.0, small).areaM2() / scattered(100, 2).totalAreaM2(), 1.0, 1e-5);
}

TEST(PointsToTexel, MeansAreWeightedByArea) {
  Points points = pointAt({0.5f, 0.5f, 0.25f}, 1.0f);
  Points other = pointAt({0.5f, 0.5f, 0.25f}, 3.0f);
  other.diffuse[0] = {0.5f, 0.6f, 0.7f};
  other.tangents[0] = {1.0f, 0.0f, 0.0f};
  add(points, other);
  const Texel texel = splat(points);
  for (const Voxel& voxel : texel.voxels()) {
    EXPECT_LT(glm::length(voxel.diffuse - glm::vec3(0.4f, 0.5f, 0.6f)), 1e-6f);
    EXPECT_LT(glm::length(voxel.tangent - glm::normalize(glm::vec3(3.0f, 0.0f, 1.0f))), 1e-6f);
  }
}

TEST(PointsToTexel, OppositeNormalsCancelAndStillSpread) {
  Points points = pointAt({0.5f, 0.5f, 0.25f}, 1.0f);
  add(points, points);
  points.normals[1] = -points.normals[0];
  const Texel texel = splat(points);
  for (const Voxel& voxel : texel.voxels()) {
    EXPECT_EQ(voxel.normal, glm::vec3(0.0f));
    EXPECT_NEAR(voxel.spread[3], voxel.density, 1e-5f * voxel.density);
    EXPECT_NEAR(glm::length(voxel.tangent), 1.0f, 1e-6f);
  }
}

TEST(PointsToTexel, SameBytesOnAnyNumberOfThreads) {
  const Points points = scattered(4000, 8);
  const Texel one = splat(points, 0.6, kGrid, 1);
  EXPECT_TRUE(sameBytes(one, splat(points, 0.6, kGrid, 2)));
  EXPECT_TRUE(sameBytes(one, splat(points, 0.6, kGrid, 7)));
}

TEST(PointsToTexel, ExtremesOfDensity) {
  for (const float area : {1e-20f, 1e-6f, 1e6f, 1e20f}) {
    const Texel texel = splat(pointAt({0.3f, 0.3f, 0.3f}, area));
    EXPECT_NEAR(texel.areaM2() / static_cast<double>(area), 1.0, 1e-5);
    for (const Voxel& voxel : texel.voxels()) EXPECT_TRUE(std::isfinite(voxel.diffuse.r));
  }
  EXPECT_TRUE(splat(pointAt({0.3f, 0.3f, 0.3f}, 0.0f)).empty());
  EXPECT_TRUE(splat(Points{}).empty());
}

TEST(PointsToTexel, Refuses) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  for (const glm::vec3& p : {glm::vec3(nan, 0, 0), glm::vec3(0, infinite, 0), glm::vec3(0, 0, -infinite)}) {
    EXPECT_FALSE(pointsToTexel(pointAt(p), kGrid, 0.6, {}).ok());
  }
  EXPECT_FALSE(pointsToTexel(pointAt({0, 0, 0}, nan), kGrid, 0.6, {}).ok());
  EXPECT_FALSE(pointsToTexel(pointAt({0, 0, 0}, -1.0f), kGrid, 0.6, {}).ok());
  EXPECT_FALSE(pointsToTexel(pointAt({0, 0, 0}, 1e38f), kGrid, 0.6, {}).ok());  // its density would be infinite
  Points odd = pointAt({0, 0, 0});
  odd.diffuse[0].g = nan;
  EXPECT_FALSE(pointsToTexel(odd, kGrid, 0.6, {}).ok());
  EXPECT_FALSE(pointsToTexel(Points{}, {31, 32, 1.0, 1.0}, 0.6, {}).ok());
  std::stop_source source;
  source.request_stop();
  JobContext job;
  job.stop = source.get_token();
  const Result<Texel> stopped = pointsToTexel(pointAt({0, 0, 0}), kGrid, 0.6, job);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
}

/// Texel to points to texel: leaf area to rounding, places to half a voxel (where the point lies in its voxel) and the
/// Gaussian's reach: no voxel is more than two away from one that was there.
TEST(RoundTrip, KeepsAreaAndPlaces) {
  for (const double proportion : {0.1, 6.0, 100.0}) {
    const Blades blades = uprightBlades(12, 64, 0.7);
    const Points points = texelToPoints(blades.texel, blades.attachments, blades.strands, proportion, 3, {}).value();
    const Texel back = pointsToTexel(points, blades.texel.grid(), 0.6, {}).value();
    EXPECT_NEAR(back.areaM2() / blades.texel.areaM2(), 1.0, 1e-5);
    const auto centre = [](const Texel& texel) {
      glm::dvec2 sum(0.0);  // height: mean, and mean square
      for (std::size_t i = 0; i < texel.size(); ++i) {
        const double z = texel.places()[i].z + 0.5, weight = static_cast<double>(texel.voxels()[i].density);
        sum += weight * glm::dvec2(z, 1.0);
      }
      return sum.x / sum.y;
    };
    for (const glm::u16vec3& place : back.places()) {
      bool near = false;
      for (int i = 0; i < 27 && !near; ++i) {
        const glm::ivec3 at = glm::ivec3(place) + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        near = at.z >= 0 && at.z < 64 && blades.texel.at({(at.x + 64) % 64, (at.y + 64) % 64, at.z}) != nullptr;
      }
      EXPECT_TRUE(near);  // 3^3 voxels: one away
    }
    // The mean height of n points errs by a column's deviation (38 / sqrt(12)) over sqrt(n), times four; the ground
    // cuts the Gaussian of the lowest of 38 layers, which lifts them by less than a quarter of a voxel.
    const auto n = static_cast<double>(points.size());
    EXPECT_NEAR(centre(back), centre(blades.texel), 4.0 * 11.0 / std::sqrt(n) + 0.25 / 38);
  }
}

/// A round stem, whose normals cancel, hides as much after the round as before: the spread is kept.
TEST(RoundTrip, KeepsWhatRoundStemsHide) {
  std::vector<Texel::Entry> entries;
  for (int z = 0; z < 20; ++z) {
    Voxel voxel = leafVoxel(3.0);
    voxel.normal = {0.0f, 0.0f, 1.0f};  // what a taper leaves over
    voxel.spread = {1.5f, 0, 0, 1.5f, 0, 0};
    entries.push_back({{16, 16, z}, voxel});
  }
  const Texel texel = Texel::fromEntries(kGrid, std::move(entries)).value();
  const Points points = texelToPoints(texel, {}, {}, 50.0, 1, {}).value();
  const Texel back = pointsToTexel(points, kGrid, 0.6, {}).value();
  for (const Voxel& voxel : back.voxels()) {
    EXPECT_NEAR(voxel.spread[0] / voxel.density, 0.5f, 1e-5f);
    EXPECT_NEAR(voxel.spread[3] / voxel.density, 0.5f, 1e-5f);
    EXPECT_NEAR(voxel.spread[5] / voxel.density, 0.0f, 1e-5f);
  }
}

}  // namespace
}  // namespace sward::wither
