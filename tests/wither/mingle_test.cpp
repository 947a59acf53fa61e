#include "wither/mingle.h"

#include "wither/texel_test_help.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace sward::wither {
namespace {

using testing::cube;
using testing::randomTexel;
using testing::sameBytes;
using testing::texelOf;

Texel mixed(const std::vector<MingleInput>& samples, int threads = 0) {
  JobContext job;
  job.threads = threads;
  auto result = mingle(samples, job);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().text());
  return result.ok() ? std::move(result).value() : Texel();
}

TEST(Mingle, IsTheWeightedMeanOfADensePass) {
  const TexelGrid grid{24, 16, 1.0, 0.4};
  std::vector<Texel> texels;
  std::vector<MingleInput> samples;
  for (std::uint64_t i = 0; i < 7; ++i) texels.push_back(randomTexel(grid, 0.15, i));
  for (std::size_t i = 0; i < 7; ++i) samples.push_back({&texels[i], 0.3 * static_cast<double>(i)});
  const Texel out = mixed(samples);
  std::size_t filled = 0;
  for (int z = 0; z < 16; ++z) {
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        glm::dvec3 normal(0.0), tangent(0.0), diffuse(0.0), transmitted(0.0);
        double rho = 0.0, specular = 0.0;
        std::array<double, 6> spread{};
        for (const MingleInput& sample : samples) {
          const Voxel* voxel = sample.texel->at({x, y, z});
          if (voxel == nullptr) continue;
          const double w = sample.density * static_cast<double>(voxel->density);
          rho += w;
          normal += w * glm::dvec3(voxel->normal);
          tangent += w * glm::dvec3(voxel->tangent);
          diffuse += w * glm::dvec3(voxel->diffuse);
          transmitted += w * glm::dvec3(voxel->transmitted);
          specular += w * static_cast<double>(voxel->specular);
          for (std::size_t i = 0; i < 6; ++i) spread[i] += sample.density * static_cast<double>(voxel->spread[i]);
        }
        const Voxel* voxel = out.at({x, y, z});
        ASSERT_EQ(voxel != nullptr, rho > 0.0);
        if (voxel == nullptr) continue;
        ++filled;
        // Results are floats: half an ulp, 6e-8, of each; directions have the rounding of the summands besides.
        ASSERT_NEAR(static_cast<double>(voxel->density) / rho, 1.0, 1e-6);
        ASSERT_NEAR(glm::length(glm::dvec3(voxel->diffuse) - diffuse / rho), 0.0, 1e-6);
        ASSERT_NEAR(glm::length(glm::dvec3(voxel->transmitted) - transmitted / rho), 0.0, 1e-6);
        ASSERT_NEAR(static_cast<double>(voxel->specular), specular / rho, 1e-6);
        for (std::size_t i = 0; i < 6; ++i) {
          ASSERT_NEAR(static_cast<double>(voxel->spread[i]), spread[i], 1e-6 * rho);
        }
        if (glm::length(normal) > 1e-3 * rho) {
          ASSERT_NEAR(glm::length(glm::dvec3(voxel->normal) - glm::normalize(normal)), 0.0, 1e-6);
        }
        if (glm::length(tangent) > 1e-3 * rho) {
          ASSERT_NEAR(glm::length(glm::dvec3(voxel->tangent) - glm::normalize(tangent)), 0.0, 1e-6);
        }
      }
    }
  }
  EXPECT_GT(filled, 3000u);
  EXPECT_EQ(filled, out.size());
  double area = 0.0;
  for (const MingleInput& sample : samples) area += sample.density * sample.texel->areaM2();
  EXPECT_NEAR(out.areaM2() / area, 1.0, 1e-6);
}

TEST(Mingle, OneSampleOfDensityOneIsUnchanged) {
  const Texel texel = randomTexel(cube(16), 0.3, 4);
  EXPECT_TRUE(sameBytes(mixed({{&texel, 1.0}}), texel));
  const Texel empty = texelOf(cube(16), {});
  EXPECT_TRUE(sameBytes(mixed({{&empty, 2.0}, {&texel, 1.0}, {&texel, 0.0}}), texel));
  EXPECT_TRUE(mixed({{&texel, 0.0}}).empty());
  EXPECT_TRUE(mixed({{&empty, 1.0}}).empty());
}

TEST(Mingle, OppositeNormalsCancelToZero) {
  Voxel up;
  up.density = 2.0f;
  up.normal = {0.0f, 0.6f, 0.8f};
  up.tangent = {1.0f, 0.0f, 0.0f};
  Voxel down = up;
  down.normal = -up.normal;
  const Texel a = texelOf(cube(8), {{{1, 2, 3}, up}}), b = texelOf(cube(8), {{{1, 2, 3}, down}});
  const Texel out = mixed({{&a, 1.0}, {&b, 1.0}});
  EXPECT_EQ(out.voxels()[0].normal, glm::vec3(0.0f));
  EXPECT_EQ(out.voxels()[0].tangent, glm::vec3(1.0f, 0.0f, 0.0f));
  EXPECT_EQ(out.voxels()[0].density, 4.0f);
}

TEST(Mingle, HugeAndTinyDensitiesStayFinite) {
  Voxel voxel;
  voxel.density = std::numeric_limits<float>::max();
  Voxel tiny;
  tiny.density = std::numeric_limits<float>::denorm_min();
  const Texel a = texelOf(cube(8), {{{1, 2, 3}, voxel}, {{0, 0, 0}, tiny}});
  const Texel out = mixed({{&a, 10.0}, {&a, 10.0}});
  EXPECT_EQ(out.at({1, 2, 3})->density, std::numeric_limits<float>::max());
  // What is there stays there, with the least density that a float has in full.
  const Texel thin = mixed({{&a, 1e-30}});
  ASSERT_NE(thin.at({0, 0, 0}), nullptr);
  EXPECT_EQ(thin.at({0, 0, 0})->density, std::numeric_limits<float>::min());
}

TEST(Mingle, Errors) {
  const Texel a = randomTexel(cube(8), 0.3, 4), b = randomTexel(cube(8, 2.0), 0.3, 4);
  EXPECT_FALSE(mingle({}, {}).ok());
  EXPECT_FALSE(mingle(std::vector<MingleInput>{{&a, 1.0}, {&b, 1.0}}, {}).ok());
  for (const double density : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_FALSE(mingle(std::vector<MingleInput>{{&a, density}}, {}).ok());
  }
  std::stop_source stop;
  stop.request_stop();
  JobContext job;
  job.stop = stop.get_token();
  const auto cancelled = mingle(std::vector<MingleInput>{{&a, 1.0}}, job);
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(Mingle, ThreadsGiveTheSameBytes) {
  const Texel a = randomTexel(cube(32), 0.2, 1), b = randomTexel(cube(32), 0.2, 2);
  EXPECT_TRUE(sameBytes(mixed({{&a, 1.0}, {&b, 0.7}}, 1), mixed({{&a, 1.0}, {&b, 0.7}}, 3)));
}

TEST(Lerp, IsLinearInDensityAndEndsAtTheKeyFrames) {
  const Texel a = randomTexel(cube(16), 0.2, 1), b = randomTexel(cube(16), 0.2, 2);
  EXPECT_TRUE(sameBytes(*lerp(a, b, 0.0), a));
  EXPECT_TRUE(sameBytes(*lerp(a, b, 1.0), b));
  EXPECT_TRUE(sameBytes(*lerp(a, b, -3.0), a));
  EXPECT_TRUE(sameBytes(*lerp(a, b, std::nan("")), a));
  EXPECT_TRUE(sameBytes(*lerp(a, a, 0.0), a));
  const Texel quarter = *lerp(a, b, 0.25);
  EXPECT_NEAR(quarter.areaM2(), 0.75 * a.areaM2() + 0.25 * b.areaM2(), 1e-6 * a.areaM2());
  EXPECT_FALSE(lerp(a, randomTexel(cube(8), 0.2, 2), 0.5).ok());
}

}  // namespace
}  // namespace sward::wither
