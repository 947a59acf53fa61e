#include "wither/pose.h"

#include "wither/test_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

struct Meadow {
  Blades blades = uprightBlades(30, 64, 1.0);
  Season season = Season::create({}, {}).value();
  Points rest = texelToPoints(blades.texel, blades.attachments, blades.strands, 6.0, 1, {}).value();
  Points at(double weathering, const AgeColour& colour = {}, int threads = 0) const {
    JobContext job;
    job.threads = threads;
    Points moved;
    EXPECT_TRUE(pose(rest, blades.strands, season, {}, weathering, colour, moved, job).ok());
    return moved;
  }
};

void darken(glm::vec3& diffuse, glm::vec3& transmitted, const Season::Shares& shares) {
  diffuse *= static_cast<float>(shares.chlorophyll);
  transmitted *= static_cast<float>(shares.water);
}

TEST(Pose, RestIsTheSameToTheLastBit) {
  const Meadow meadow;
  const Points moved = meadow.at(0.0, darken);
  EXPECT_EQ(moved.positions, meadow.rest.positions);
  EXPECT_EQ(moved.normals, meadow.rest.normals);
  EXPECT_EQ(moved.diffuse, meadow.rest.diffuse);
  EXPECT_EQ(moved.areaM2, meadow.rest.areaM2);
}

/// Single precision against BentStrand: the block is a metre wide, so 1e-6 m.
TEST(Pose, AgreesWithBentStrand) {
  Meadow meadow;
  for (std::size_t k = 0; k < meadow.blades.strands.size(); ++k) {
    meadow.blades.strands[k].delay = 0.02 * static_cast<double>(k % 10) - 0.1;
    meadow.blades.strands[k].droop = 0.7 + 0.05 * static_cast<double>(k % 9);
  }
  for (const double degree : {0.2, 0.6, 1.0}) {
    const Points moved = meadow.at(degree, darken);
    for (std::size_t i = 0; i < moved.size(); i += 7) {
      const Attachment& at = meadow.rest.attachments[i];
      const Strand& strand = meadow.blades.strands[static_cast<std::size_t>(at.strand)];
      const BladeState state = meadow.season.state(degree, strand.delay, strand.droop);
      const BentStrand bent(strand, state);
      const auto s = static_cast<double>(at.s);
      EXPECT_LT(glm::length(glm::dvec3(moved.positions[i]) - bent.position(glm::dvec3(meadow.rest.positions[i]), s)),
                1e-6);
      EXPECT_LT(glm::length(glm::dvec3(moved.normals[i]) - bent.direction(glm::dvec3(meadow.rest.normals[i]), s)),
                1e-6);
      EXPECT_LT(glm::length(glm::dvec3(moved.tangents[i]) - bent.direction(glm::dvec3(meadow.rest.tangents[i]), s)),
                1e-6);
      EXPECT_GE(moved.positions[i].z, 0.0f);
      const glm::vec3 n = moved.normals[i];  // one normal: the spread is n n^T
      const std::array<float, 6> expected{n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(moved.spread[i][c], expected[c], 1e-5f);
      EXPECT_NEAR(moved.areaM2[i] / meadow.rest.areaM2[i], (1.0 - state.strainAlong) * (1.0 - state.strainAcross),
                  1e-6);
      // Shares are linear between 17 places: the curves' second derivative, below 20, times the lead of 0.3 / 16,
      // squared over 8.
      const Season::Shares shares = meadow.season.shares(degree, strand.delay, s);
      EXPECT_NEAR(moved.diffuse[i].g / meadow.rest.diffuse[i].g, shares.chlorophyll, 1e-3);
      EXPECT_NEAR(moved.transmitted[i].g / meadow.rest.transmitted[i].g, shares.water, 1e-3);
    }
  }
}

TEST(Pose, SinksMonotonically) {
  const Meadow meadow;
  double last = 1e9;
  for (int i = 0; i <= 20; ++i) {
    const Points moved = meadow.at(i / 20.0);
    double height = 0.0;
    for (const glm::vec3& p : moved.positions) height += static_cast<double>(p.z);
    EXPECT_LE(height, last);
    last = height;
  }
}

TEST(Pose, SameOnAnyNumberOfThreads) {
  const Meadow meadow;
  const Points one = meadow.at(0.7, darken, 1), four = meadow.at(0.7, darken, 4);
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.diffuse, four.diffuse);
}

TEST(Pose, HardCases) {
  Meadow meadow;
  // Strands without length, lying flat, and hanging; points on none.
  meadow.blades.strands[0].vein.assign(13, meadow.blades.strands[0].vein[0]);
  for (int i = 0; i <= 12; ++i) {
    meadow.blades.strands[1].vein[static_cast<std::size_t>(i)] = {0.02 * i, 0.0, 0.0};
    meadow.blades.strands[2].vein[static_cast<std::size_t>(i)] = {0.3, 0.3, 0.4 - 0.02 * i};
  }
  meadow.blades.strands[3].droop = 1e6;
  meadow.rest.attachments[0].s = std::numeric_limits<float>::infinity();
  for (std::size_t i = 100; i < 120; ++i) meadow.rest.attachments[i].strand = -1;
  for (const double degree : {0.01, 0.5, 1.0, 7.0}) {
    const Points moved = meadow.at(degree, darken);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      ASSERT_TRUE(std::isfinite(moved.positions[i].x) && std::isfinite(moved.normals[i].x)) << i;
      EXPECT_GE(moved.positions[i].z, 0.0f);
    }
    EXPECT_EQ(moved.positions[100], meadow.rest.positions[100]);
  }
  meadow.rest.attachments[5].strand = 10000;
  Points moved;
  EXPECT_FALSE(pose(meadow.rest, meadow.blades.strands, meadow.season, {}, 0.5, {}, moved, {}).ok());
  EXPECT_FALSE(paperPose(meadow.rest, meadow.blades.strands, meadow.season, {}, 0.5, moved, {}).ok());
  EXPECT_TRUE(pose(Points{}, {}, meadow.season, {}, 0.5, {}, moved, {}).ok());
}

TEST(PaperPose, IsFiniteAndStretches) {
  const Meadow meadow;
  Points moved;
  ASSERT_TRUE(paperPose(meadow.rest, meadow.blades.strands, meadow.season, {}, 1.0, moved, {}).ok());
  for (std::size_t i = 0; i < moved.size(); ++i) {
    ASSERT_TRUE(std::isfinite(moved.positions[i].x) && std::isfinite(moved.tangents[i].x));
    EXPECT_GE(moved.positions[i].z, 0.0f);
    EXPECT_NEAR(glm::length(moved.tangents[i]), 1.0f, 1e-5f);
  }
  ASSERT_TRUE(paperPose(meadow.rest, meadow.blades.strands, meadow.season, {}, 0.0, moved, {}).ok());
  EXPECT_EQ(moved.positions, meadow.rest.positions);
}

}  // namespace
}  // namespace sward::wither
