#include "wither/leaf_ageing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::wither {
namespace {

/// Authored greens, straw, petals: more and less of each channel than the model's fresh leaf has.
constexpr std::array<glm::vec3, 5> kColours{
    {{0.085f, 0.12f, 0.03f}, {0.25f, 0.32f, 0.10f}, {0.5f, 0.4f, 0.3f}, {0.7f, 0.7f, 0.7f}, {0.001f, 0.02f, 0.0005f}}};

TEST(LeafAgeing, NothingJumpsAtTheSeasonsFirstMoment) {
  const AgeColour age = ageColour(leaf::AgeingColours::build({}).value());
  for (const glm::vec3& colour : kColours) {
    glm::vec3 r = colour, t = 0.4f * colour;
    age(r, t, {1.0 - 1e-5, 1.0 - 1e-5});
    for (int c = 0; c < 3; ++c) {
      // The first node below full shares is 3 % of chlorophyll off; within it colours change by less than 5 %, here by
      // 1e-5 / 0.03 of that. Authored channels below the darkest that is kept are lifted to it.
      EXPECT_NEAR(r[c], std::max(colour[c], 1e-3f), 1e-3f * std::max(colour[c], 1e-3f));
      EXPECT_NEAR(t[c], std::max(0.4f * colour[c], 1e-3f), 1e-3f * std::max(0.4f * colour[c], 1e-3f));
    }
  }
}

TEST(LeafAgeing, ColoursChangeEvenlyOverASeasonOfManyFrames) {
  const AgeColour age = ageColour(leaf::AgeingColours::build({}).value());
  constexpr int kFrames = 240;
  for (const glm::vec3& colour : kColours) {
    glm::vec3 before = glm::max(colour, 1e-3f);
    for (int frame = 1; frame <= kFrames; ++frame) {
      const double share = 1.0 - static_cast<double>(frame) / kFrames;
      glm::vec3 r = colour, t = 0.4f * colour;
      age(r, t, {share, share});
      for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(std::isfinite(r[c]) && std::isfinite(t[c]));
        // A display shows about the root; its whole range lies over the season, a frame may take a twentieth.
        EXPECT_LT(std::abs(std::sqrt(r[c]) - std::sqrt(before[c])), 0.05f) << frame << ", channel " << c;
        EXPECT_LE(r[c] + t[c], 1.0f + 1e-6f);
      }
      before = r;
    }
  }
}

TEST(LeafAgeing, WhatLetsNoLightThroughDoesNotBegin) {
  const AgeColour age = ageColour(leaf::AgeingColours::build({}).value());
  glm::vec3 r(0.4f), t(0.0f);
  age(r, t, {0.3, 0.1});
  EXPECT_EQ(t, glm::vec3(0.0f));
  glm::vec3 fresh(0.1f, 0.2f, 0.05f), through(0.05f, 0.1f, 0.0f);
  const glm::vec3 r0 = fresh, t0 = through;
  age(fresh, through, {1.0, 1.0});
  EXPECT_EQ(fresh, r0);
  EXPECT_EQ(through, t0);
}

}  // namespace
}  // namespace sward::wither
