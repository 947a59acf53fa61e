#include "wither/leaf_phase.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sward::wither {
namespace {

TEST(LeafPhase, IsTheMeanOverLeavesOfEveryDirection) {
  for (const double deg : {0.0, 20.0, 60.0, 90.0, 135.0, 180.0}) {
    const double b = glm::radians(deg);
    const glm::dvec3 l(0.0, 0.0, 1.0), v(std::sin(b), 0.0, std::cos(b));
    double same = 0.0, different = 0.0;
    // Fibonacci's lattice over the sphere: smooth pieces, so that the error falls faster than a thousandth here.
    constexpr int kLeaves = 20000;
    for (int i = 0; i < kLeaves; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kLeaves, azimuth = 2.399963229728653 * i, r = std::sqrt(1.0 - z * z);
      const glm::dvec3 n(r * std::cos(azimuth), r * std::sin(azimuth), z);
      const double product = glm::dot(n, l) * glm::dot(n, v);
      (product > 0.0 ? same : different) += std::abs(product) / kLeaves;
    }
    const LeafSidesSeen seen = leafSidesSeen(std::cos(b));
    EXPECT_NEAR(seen.same, same, 2e-4) << deg;
    EXPECT_NEAR(seen.different, different, 2e-4) << deg;
  }
}

TEST(LeafPhase, HasTheMeanOneOverAllEyes) {
  for (const double passed : {0.0, 0.4, 1.0, 3.0}) {
    double sum = 0.0;
    constexpr int kSteps = 2000;  // cosines are even over the sphere
    for (int i = 0; i < kSteps; ++i) sum += leafPhase(-1.0 + (2.0 * i + 1.0) / kSteps, passed) / kSteps;
    EXPECT_NEAR(sum, 1.0, 1e-5) << passed;
  }
}

TEST(LeafPhase, OpaqueLeavesAreDarkAgainstTheSun) {
  EXPECT_NEAR(leafPhase(1.0, 0.0), 8.0 / 3.0, 1e-12);
  EXPECT_NEAR(leafPhase(-1.0, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(leafPhase(1.0, 1.0), leafPhase(-1.0, 1.0), 1e-12) << "what passes is as bright as what is reflected";
  EXPECT_TRUE(std::isfinite(leafPhase(1.0 + 1e-12, 0.5)));
}

}  // namespace
}  // namespace sward::wither
