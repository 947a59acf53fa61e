#include "wither/packed_texel.h"

#include "wither/texel_test_help.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sward::wither {
namespace {

using testing::cube;
using testing::randomTexel;
using testing::sameBytes;
using testing::texelOf;

double angle(const glm::vec3& a, const glm::vec3& b) {
  return 2.0 * std::asin(std::min(0.5 * glm::length(glm::dvec3(a) - glm::dvec3(b)), 1.0));
}

/// The bounds of the header, and what floats round.
void expectClose(const Texel& texel, const Texel& back) {
  ASSERT_EQ(texel.size(), back.size());
  float least = std::numeric_limits<float>::max(), largest = 0.0f;
  for (const Voxel& voxel : texel.voxels()) {
    least = std::min(least, voxel.density);
    largest = std::max(largest, voxel.density);
  }
  const double range = std::log(static_cast<double>(largest)) - std::log(static_cast<double>(least));
  constexpr double kFloat = 1e-6;
  for (std::size_t i = 0; i < texel.size(); ++i) {
    ASSERT_EQ(texel.places()[i], back.places()[i]);
    const Voxel &a = texel.voxels()[i], &b = back.voxels()[i];
    const double d = static_cast<double>(a.density);
    ASSERT_NEAR(static_cast<double>(b.density) / d, 1.0, 1.001 * range / 131068.0 + kFloat);
    ASSERT_EQ(a.normal == glm::vec3(0.0f), b.normal == glm::vec3(0.0f));
    ASSERT_EQ(a.tangent == glm::vec3(0.0f), b.tangent == glm::vec3(0.0f));
    // Half a step, and half a step of the 16 bits on the way there and back.
    ASSERT_LT(angle(a.normal, b.normal), std::sqrt(18.0) * (0.5 / 2047.0 + 2.0 * 0.5 / 32767.0));
    ASSERT_LT(angle(a.tangent, b.tangent), std::sqrt(18.0) * (0.5 / 127.0 + 2.0 * 0.5 / 32767.0));
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(std::sqrt(a.diffuse[c]), std::sqrt(b.diffuse[c]), 1.0f / 510.0f + 1e-6f);
      ASSERT_NEAR(std::sqrt(a.transmitted[c]), std::sqrt(b.transmitted[c]), 1.0f / 510.0f + 1e-6f);
    }
    ASSERT_NEAR(a.specular, b.specular, 1.0f / 510.0f + 1e-6f);
    const auto share = [](const Voxel& v, std::size_t e) {
      return static_cast<double>(v.spread[e]) / static_cast<double>(v.density);
    };
    const double most = std::max({share(a, 0), share(a, 3), share(a, 5)});
    for (std::size_t e = 0; e < 6; ++e) {
      ASSERT_NEAR(share(a, e), share(b, e), share(a, e) == most ? 3.0 / 510.0 : 1.0 / 508.0 + kFloat) << e;
    }
    ASSERT_NEAR(share(b, 0) + share(b, 3) + share(b, 5), share(a, 0) + share(a, 3) + share(a, 5), 1.0 / 510.0 + kFloat);
  }
}

Texel roundTrip(const Texel& texel) {
  return PackedTexel::pack(texel, {}).unpack({});
}

TEST(PackedTexel, KeepsItsBounds) {
  const Texel texel = randomTexel({32, 24, 1.0, 0.3}, 0.3, 6);
  const PackedTexel packed = PackedTexel::pack(texel, {});
  expectClose(texel, packed.unpack({}));
  EXPECT_EQ(packed.size(), texel.size());
  EXPECT_EQ(packed.bytes(), 20 * texel.size() + 68 * texel.stored().size());
  // Of a trace that is the density nothing is lost: no leaf loses its normal by packing.
  const Texel back = packed.unpack({});
  for (const Voxel& voxel : back.voxels()) {
    ASSERT_NEAR((voxel.spread[0] + voxel.spread[3] + voxel.spread[5]) / voxel.density, 1.0f, 1e-6f);
  }
}

TEST(PackedTexel, DirectionsAtCornersEdgesAndFolds) {
  std::vector<Texel::Entry> entries;
  int i = 0;
  for (const float x : {-1.0f, -0.5f, 0.0f, 1e-7f, 1.0f}) {
    for (const float y : {-1.0f, -1e-7f, 0.0f, 0.3f, 1.0f}) {
      for (const float z : {-1.0f, -1e-7f, 0.0f, 1e-7f, 1.0f}) {
        if (x == 0.0f && y == 0.0f && z == 0.0f) continue;
        Voxel voxel;
        voxel.density = 1.0f;
        voxel.normal = voxel.tangent = glm::normalize(glm::vec3(x, y, z));
        entries.push_back({{i % 8, i / 8 % 8, i / 64}, voxel});
        ++i;
      }
    }
  }
  const Texel texel = texelOf(cube(8), entries);
  expectClose(texel, roundTrip(texel));
}

TEST(PackedTexel, ExtremesOneAndNone) {
  Voxel least, most;
  least.density = std::numeric_limits<float>::min();
  most.density = std::numeric_limits<float>::max();
  most.diffuse = most.transmitted = glm::vec3(1.0f);
  most.specular = 1.0f;
  const Texel both = texelOf(cube(8), {{{0, 0, 0}, least}, {{7, 7, 7}, most}});
  expectClose(both, roundTrip(both));
  const Texel one = texelOf(cube(8), {{{3, 4, 5}, most}});
  expectClose(one, roundTrip(one));
  EXPECT_TRUE(roundTrip(texelOf(cube(8), {})).empty());
  EXPECT_TRUE(roundTrip(Texel()).empty());
}

TEST(PackedTexel, BytesComeBackAndDamageIsFound) {
  const Texel texel = randomTexel(cube(16), 0.02, 6);
  const PackedTexel packed = PackedTexel::pack(texel, {});
  const std::vector<std::byte> bytes = packed.serialised();
  const auto back = PackedTexel::parse(bytes);
  ASSERT_TRUE(back.ok());
  EXPECT_TRUE(sameBytes(back->unpack({}), packed.unpack({})));
  ASSERT_TRUE(PackedTexel::parse(PackedTexel::pack(Texel(), {}).serialised()).ok());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    ASSERT_FALSE(PackedTexel::parse(std::span(bytes).first(length)).ok()) << length;
  }
  std::vector<std::byte> longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(PackedTexel::parse(longer).ok());
  // Any one byte changed: an error, or a texel of the same places or others, never anything out of bounds.
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::vector<std::byte> damaged = bytes;
    damaged[at] ^= std::byte{0xff};
    const auto result = PackedTexel::parse(damaged);
    if (!result.ok()) continue;
    const Texel read = result->unpack({});
    ASSERT_EQ(read.size(), texel.size());
    for (const Voxel& voxel : read.voxels()) ASSERT_TRUE(std::isfinite(voxel.density) && voxel.density > 0.0f);
  }
}

TEST(PackedTexel, ThreadsGiveTheSameBytes) {
  const Texel texel = randomTexel(cube(32), 0.3, 6);
  JobContext one, three;
  one.threads = 1;
  three.threads = 3;
  EXPECT_EQ(PackedTexel::pack(texel, one).serialised(), PackedTexel::pack(texel, three).serialised());
}

}  // namespace
}  // namespace sward::wither
