#include "trace/voxel_form.h"

#include "base/random.h"
#include "scene/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::trace {
namespace {

TEST(VoxelForm, StoresWithinItsBounds) {
  base::Random random(32);
  const float largest = 700.0f;
  double worstAngle = 0.0, worstShare = 0.0, worstRoot = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double z = random.uniform(-1.0, 1.0), r = std::sqrt(1.0 - z * z), azimuth = random.uniform(0.0, 6.2832);
    DominantVoxel voxel{glm::vec3(r * std::cos(azimuth), r * std::sin(azimuth), z),
                        static_cast<float>(random.uniform()),
                        largest * static_cast<float>(std::pow(random.uniform(), 4.0))};
    DominantVoxel lower = voxel;
    lower.density = largest * static_cast<float>(random.uniform());
    const std::uint32_t code = packPair(lower, voxel, largest);
    for (const bool upper : {false, true}) {
      const DominantVoxel back = unpack(code, upper, largest), &was = upper ? voxel : lower;
      // By the sine: the cosine of a small angle drowns in rounding.
      const double sine = glm::length(glm::cross(glm::dvec3(back.normal), glm::dvec3(was.normal)));
      worstAngle = std::max(worstAngle, std::asin(std::min(sine, 1.0)));
      worstShare = std::max(worstShare, std::abs(static_cast<double>(back.share - was.share)));
      if (was.density > largest / (510.0f * 510.0f)) {  // below, what is there becomes the least that there is
        worstRoot = std::max(worstRoot, std::abs(std::sqrt(static_cast<double>(back.density / largest)) -
                                                 std::sqrt(static_cast<double>(was.density / largest))));
      }
      EXPECT_GT(back.density, 0.0f);
      EXPECT_NEAR(glm::length(back.normal), 1.0f, 1e-6f);
    }
  }
  EXPECT_LT(worstAngle, std::sqrt(6.0) / 31.0);
  EXPECT_GT(worstAngle, 1.0 * std::numbers::pi / 180.0);  // or the bits are wasted
  EXPECT_LT(worstShare, 1.0 / 126.0 + 1e-6);
  EXPECT_LT(worstRoot, 1.0 / 510.0 + 1e-6);
  const DominantVoxel nothing;
  EXPECT_EQ(unpack(packPair(nothing, nothing, largest), true, largest).density, 0.0f);
}

TEST(VoxelForm, PairsBlockAsMuchAsBefore) {
  base::Random random(33);
  const glm::vec3 size(0.0125f, 0.0125f, 0.02f);
  const auto blocked = [&](const DominantVoxel& v) {
    return v.extinction({1, 0, 0}) * size.x + v.extinction({0, 1, 0}) * size.y + v.extinction({0, 0, 1}) * size.z;
  };
  for (int i = 0; i < 1000; ++i) {
    const auto voxel = [&] {
      const glm::vec3 n(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
      return DominantVoxel{glm::normalize(n), static_cast<float>(random.uniform()),
                           i % 7 == 0 ? 0.0f : static_cast<float>(random.uniform(1.0, 300.0))};
    };
    const DominantVoxel lower = voxel(), upper = voxel();
    const auto pair = paired(lower, upper, size);
    EXPECT_EQ(pair[0].normal, pair[1].normal);
    EXPECT_EQ(pair[0].share, pair[1].share);
    EXPECT_NEAR(blocked(pair[0]), blocked(lower), 1e-5f * (1.0f + blocked(lower)));
    EXPECT_NEAR(blocked(pair[1]), blocked(upper), 1e-5f * (1.0f + blocked(upper)));
  }
  // Alike, they stay as they are.
  const DominantVoxel one{glm::normalize(glm::vec3(1, 2, 3)), 0.7f, 40.0f};
  const auto pair = paired(one, one, size);
  EXPECT_GT(std::abs(glm::dot(pair[0].normal, one.normal)), 1.0f - 1e-6f);
  EXPECT_NEAR(pair[0].share, 0.7f, 1e-5f);
  EXPECT_NEAR(pair[0].density, 40.0f, 1e-3f);
}

/// S of leaves of area 1 a volume over some normals, and what they truly turn to l.
struct Leaves {
  std::array<float, 6> tensor{};
  double turned = 0.0;
};
Leaves leavesOf(const std::vector<glm::dvec3>& normals, const glm::dvec3& l) {
  std::array<double, 6> s{};
  Leaves leaves;
  for (const glm::dvec3& n : normals) {
    const double w = 1.0 / static_cast<double>(normals.size());
    const double parts[6] = {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
    for (std::size_t i = 0; i < 6; ++i) s[i] += w * parts[i];
    leaves.turned += w * std::abs(glm::dot(n, l));
  }
  for (std::size_t i = 0; i < 6; ++i) leaves.tensor[i] = static_cast<float>(s[i]);
  return leaves;
}

TEST(VoxelForm, ExtinctionOfKnownLeaves) {
  const glm::dvec3 side(1.0, 0.0, 0.0), up(0.0, 0.0, 1.0), slanted = glm::normalize(glm::dvec3(1.0, 2.0, 1.5));
  // One normal: both forms are exact.
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
  for (const glm::dvec3& l : {side, up, slanted}) {
    const Leaves one = leavesOf({normal}, l);
    EXPECT_NEAR(boundOf(one.tensor, l), one.turned, 1e-6);
    EXPECT_NEAR(dominantOf(one.tensor).extinction(glm::vec3(l)), one.turned, 1e-6);
  }
  // Every direction alike: E|n.l| = 1/2. The bound is sqrt(1/3), 15.5 % above; the dominant form is exact.
  std::vector<glm::dvec3> sphere, blades;
  for (const glm::dvec3& d : scene::fibonacciHemisphere(4000)) sphere.push_back(d);
  for (int i = 0; i < 360; ++i) {
    const double angle = std::numbers::pi * i / 180.0;
    blades.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const Leaves any = leavesOf(sphere, slanted);
  EXPECT_NEAR(any.turned, 0.5, 1e-3);
  EXPECT_NEAR(boundOf(any.tensor, slanted) / any.turned, 2.0 / std::sqrt(3.0), 3e-3);
  EXPECT_NEAR(dominantOf(any.tensor).extinction(glm::vec3(slanted)) / any.turned, 1.0, 2e-2);
  // Upright blades of every azimuth: 2/pi from the side, nothing from above. The bound is sqrt(1/2), 11.1 % above. The
  // dominant form knows one azimuth and a quarter of its area there: too dark from above (3/8), light from the side by
  // its azimuth (3/8 to 5/8); voxels as fine as blades hold one azimuth.
  const Leaves sideways = leavesOf(blades, side);
  EXPECT_NEAR(sideways.turned, 2.0 / std::numbers::pi, 1e-4);
  EXPECT_NEAR(boundOf(sideways.tensor, side) / sideways.turned, std::numbers::pi / std::sqrt(8.0), 1e-4);
  EXPECT_NEAR(boundOf(sideways.tensor, up), 0.0, 1e-4);
  const DominantVoxel upright = dominantOf(sideways.tensor);
  EXPECT_NEAR(upright.share, 0.25f, 1e-4f);
  EXPECT_NEAR(upright.extinction(glm::vec3(up)), 0.375f, 1e-4f);
}

}  // namespace
}  // namespace sward::trace
