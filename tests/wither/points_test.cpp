#include "wither/points.h"

#include "wither/test_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace sward::wither {
namespace {

Points sampled(const Blades& blades, double proportion, std::uint64_t seed = 1, int threads = 0) {
  JobContext job;
  job.threads = threads;
  return texelToPoints(blades.texel, blades.attachments, blades.strands, proportion, seed, job).value();
}

TEST(TexelToPoints, CountsAndSharesArea) {
  // Shares of 2 give 2 x 3 = 6 points to every voxel, of 1 / 3 of its area each... exactly.
  const Blades blades = uprightBlades(20, 64, 2.0);
  const Points points = sampled(blades, 3.0);
  EXPECT_EQ(points.size(), 6 * blades.texel.size());
  const double voxelArea = blades.texel.areaM2() / static_cast<double>(blades.texel.size());
  for (const float area : points.areaM2) EXPECT_NEAR(area, voxelArea / 6.0, 1e-6 * voxelArea);
  std::map<std::tuple<int, int, int>, int> counts;
  const glm::dvec3 edge = blades.texel.grid().voxelM();
  for (const glm::vec3& p : points.positions) {
    const glm::dvec3 at = glm::dvec3(p) / edge;
    ++counts[{static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)}];
  }
  int right = 0;
  for (const glm::u16vec3& place : blades.texel.places()) right += counts[{place.x, place.y, place.z}] == 6 ? 1 : 0;
  // Rounding to single precision may carry a point over a voxel's face: 2^-24 / (1 / 64) of them a face.
  EXPECT_GE(right, static_cast<int>(blades.texel.size()) - 2);
}

TEST(TexelToPoints, ConservesAreaAtAnyProportion) {
  for (const double share : {1e-6, 0.02, 0.4, 1.3, 30.0}) {
    for (const double proportion : {0.1, 1.0, 6.0, 100.0}) {
      if (share * proportion > 200.0) continue;
      const Blades blades = uprightBlades(10, 64, share);
      const Points points = sampled(blades, proportion);
      ASSERT_FALSE(points.empty());
      // Areas are stored in single precision: half an ulp each, 6e-8 of the sum.
      EXPECT_NEAR(points.totalAreaM2() / blades.texel.areaM2(), 1.0, 1e-6) << share << " " << proportion;
    }
  }
}

/// Sparse voxels: as many points as expected (binomial, five deviations), each of the same area.
TEST(TexelToPoints, SparseVoxelsAreRightInTheMean) {
  const Blades blades = uprightBlades(100, 64, 0.05);
  const Points points = sampled(blades, 6.0);
  const auto voxels = static_cast<double>(blades.texel.size());
  EXPECT_NEAR(static_cast<double>(points.size()), 0.3 * voxels, 5.0 * std::sqrt(0.21 * voxels));
  EXPECT_EQ(points.areaM2.front(), points.areaM2.back());
  // The common factor is within the count's own deviation of 1.
  const double own = blades.texel.areaM2() / voxels / 0.3;
  EXPECT_NEAR(points.areaM2.front() / own, 1.0, 5.0 * std::sqrt(0.7 / 0.3 / voxels));
}

/// 0.3 points a voxel: a point in every third or fourth voxel of a blade, from a start of its own.
TEST(TexelToPoints, SparsePointsAreEvenlySpacedAlongABlade) {
  const Blades blades = uprightBlades(20, 64, 0.05);
  const Points points = sampled(blades, 6.0);
  const double edge = blades.texel.grid().voxelM().z;
  std::set<int> starts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int layer = static_cast<int>(points.positions[i].z / edge);
    if (i == 0 || points.attachments[i].strand != points.attachments[i - 1].strand) {
      starts.insert(layer);
      EXPECT_LT(layer, 4);
      continue;
    }
    const int gap = layer - static_cast<int>(points.positions[i - 1].z / edge);
    EXPECT_TRUE(gap == 3 || gap == 4) << gap;
  }
  EXPECT_GT(starts.size(), 2u);
}

TEST(TexelToPoints, InheritsAndSortsByStrand) {
  const Blades blades = uprightBlades(15, 32, 1.0);
  const Points points = sampled(blades, 6.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points.normals[i], glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(points.diffuse[i], glm::vec3(0.1f, 0.2f, 0.05f));
    const Attachment& at = points.attachments[i];
    ASSERT_GE(at.strand, 0);
    if (i > 0) {
      EXPECT_LE(points.attachments[i - 1].strand, at.strand);
    }
    const Strand& strand = blades.strands[static_cast<std::size_t>(at.strand)];
    EXPECT_NEAR(points.positions[i].x, strand.vein[0].x, 0.5 / 32 + 1e-6);
    EXPECT_NEAR(points.positions[i].z / strand.lengthM, at.s, 0.6 / 19);
  }
}

TEST(TexelToPoints, StaysBesideAStrandThatLeavesTheBlock) {
  Blades blades = uprightBlades(1, 32, 1.0);
  for (glm::dvec3& p : blades.strands[0].vein) p += glm::dvec3(1.0, -2.0, 0.0);  // whole blocks
  const Points points = sampled(blades, 6.0);
  for (const glm::vec3& p : points.positions) {
    EXPECT_NEAR(p.x, blades.strands[0].vein[0].x, 0.02);
    EXPECT_NEAR(p.y, blades.strands[0].vein[0].y, 0.02);
  }
}

TEST(TexelToPoints, SameOnAnyNumberOfThreads) {
  const Blades blades = uprightBlades(60, 64, 0.9);
  const Points one = sampled(blades, 6.0, 5, 1), four = sampled(blades, 6.0, 5, 4), other = sampled(blades, 6.0, 6, 1);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.areaM2, four.areaM2);
  EXPECT_NE(one.positions, other.positions);
}

TEST(TexelToPoints, Refuses) {
  const Blades blades = uprightBlades(3, 32, 1.0);
  for (const double proportion : {0.0, -1.0, 1e9, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(texelToPoints(blades.texel, {}, {}, proportion, 1, {}).ok());
  }
  EXPECT_FALSE(texelToPoints(blades.texel, blades.attachments, {}, 6.0, 1, {}).ok());
  std::vector<Attachment> few(2);
  EXPECT_FALSE(texelToPoints(blades.texel, few, blades.strands, 6.0, 1, {}).ok());
  EXPECT_TRUE(texelToPoints(Texel{}, {}, {}, 6.0, 1, {}).value().empty());
  EXPECT_EQ(texelToPoints(blades.texel, {}, {}, 6.0, 1, {}).value().attachments[0].strand, -1);
}

TEST(MergePoints, AllIntoOne) {
  Points points;
  base::Random random(3);
  double area = 0.0;
  glm::dvec3 centre(0.0);
  for (int i = 0; i < 500; ++i) {
    const glm::vec3 place(random.uniform(), random.uniform(), random.uniform());
    const auto own = static_cast<float>(random.uniform(0.1, 1.0));
    add(points, pointAt(place, own));
    area += static_cast<double>(own);
    centre += static_cast<double>(own) * glm::dvec3(place);
  }
  for (const double threshold : {2.0, 1e6, 1e300}) {
    const Points one = mergePoints(points, threshold);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_NEAR(one.areaM2[0], area, 1e-6 * area);
    EXPECT_LT(glm::length(glm::dvec3(one.positions[0]) - centre / area), 1e-6);
    EXPECT_LT(glm::length(one.normals[0] - glm::vec3(0, 1, 0)), 1e-6f);
    EXPECT_NEAR(one.specular[0], 0.5f, 1e-6f);
  }
}

TEST(MergePoints, ChecksDistances) {
  Points points;
  base::Random random(4);
  for (int i = 0; i < 2000; ++i) add(points, pointAt({random.uniform(), random.uniform(), random.uniform(-0.5, 0.5)}));
  const double threshold = 0.06;
  const Points merged = mergePoints(points, threshold);
  EXPECT_LT(merged.size(), points.size());
  EXPECT_NEAR(merged.totalAreaM2(), points.totalAreaM2(), 1e-3);
  // Against the same rule without a grid.
  std::vector<glm::vec3> leaders;
  for (const glm::vec3& p : points.positions) {
    bool led = false;
    for (const glm::vec3& l : leaders) led = led || glm::length(glm::dvec3(l) - glm::dvec3(p)) < threshold;
    if (!led) leaders.push_back(p);
  }
  EXPECT_EQ(merged.size(), leaders.size());
  EXPECT_EQ(mergePoints(points, 0.0).size(), points.size());
  EXPECT_EQ(mergePoints(points, std::numeric_limits<double>::quiet_NaN()).size(), points.size());
  EXPECT_EQ(mergePoints(points, 1e-300).size(), points.size());
  EXPECT_TRUE(mergePoints(Points{}, 1.0).empty());
}

TEST(MergePoints, OppositeNormalsCancel) {
  Points points = pointAt({0.1f, 0.1f, 0.1f});
  add(points, pointAt({0.1f, 0.1f, 0.1f}));
  points.normals[1] = -points.normals[0];
  points.diffuse[1] = {0.3f, 0.4f, 0.5f};
  const Points merged = mergePoints(points, 0.01);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged.normals[0], glm::vec3(0.0f));
  EXPECT_LT(glm::length(merged.diffuse[0] - glm::vec3(0.2f, 0.3f, 0.4f)), 1e-6f);
  EXPECT_EQ(merged.areaM2[0], 2.0f);
}

}  // namespace
}  // namespace sward::wither
