#include "wither/leaf_ageing.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::wither {
namespace {

double aged(double colour, double fresh, double now, double exponent) {
  return now * std::pow(std::max(colour, 1e-3) / std::max(fresh, 1e-3), exponent);
}

/// Powers in single precision: an exponent of 1 of a logarithm up to 10, known to 2e-7 of 10, gives 2e-6.
TEST(LeafAgeing, PowersOfTintsAreThoseOfTheLibrary) {
  const leaf::AgeingColours table = leaf::AgeingColours::build({}).value();
  const AgeColour colour = ageColour(table);
  const leaf::LeafColour fresh = table(1.0, 1.0);
  base::Random random(12);
  for (int i = 0; i < 4000; ++i) {
    const Season::Shares shares{random.uniform(), random.uniform()};
    // Authors' colours of every kind, down to black.
    const auto channel = [&] { return static_cast<float>(std::pow(10.0, random.uniform(-5.0, -0.4))); };
    const glm::vec3 diffuse(channel(), channel(), channel()), transmitted(channel(), channel(), 0.0f);
    glm::vec3 d = diffuse, t = transmitted;
    colour(d, t, shares);
    const leaf::LeafColour now = table(shares.chlorophyll, shares.water);
    const double exponent = kLastingTint + (1.0 - kLastingTint) * std::min(shares.chlorophyll, shares.water);
    for (int c = 0; c < 3; ++c) {
      const double r = aged(double{diffuse[c]}, fresh.reflectance[c], now.reflectance[c], exponent);
      const double through =
          c == 2 ? 0.0 : aged(double{transmitted[c]}, fresh.transmittance[c], now.transmittance[c], exponent);
      const double scale = 1.0 / std::max(r + through, 1.0);
      EXPECT_NEAR(d[c], r * scale, 3e-6 * r * scale);
      EXPECT_NEAR(t[c], through * scale, 3e-6 * through * scale);
    }
  }
}

TEST(LeafAgeing, AFreshLeafKeepsItsColourAndWoodLetsNothingThrough) {
  const AgeColour colour = ageColour(leaf::AgeingColours::build({}).value());
  glm::vec3 d(0.1f, 0.2f, 0.05f), t(0.07f, 0.1f, 0.0f);
  colour(d, t, {1.0, 1.0});
  EXPECT_EQ(d, glm::vec3(0.1f, 0.2f, 0.05f));
  EXPECT_EQ(t, glm::vec3(0.07f, 0.1f, 0.0f));
  t = glm::vec3(0.0f);
  colour(d, t, {0.1, 0.2});
  EXPECT_EQ(t, glm::vec3(0.0f));
}

/// A white, wholly transparent leaf would send more than it gets.
TEST(LeafAgeing, NoChannelSendsMoreThanItGets) {
  const AgeColour colour = ageColour(leaf::AgeingColours::build({}).value());
  for (const double share : {0.0, 0.3, 0.9}) {
    glm::vec3 d(1.0f), t(1.0f);
    colour(d, t, {share, share});
    for (int c = 0; c < 3; ++c) EXPECT_LE(d[c] + t[c], 1.0f + 1e-6f);
  }
}

}  // namespace
}  // namespace sward::wither
