#include "image/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward::image {
namespace {

TEST(Colour, srgbMatchesTheStandardInDoublePrecision) {
  for (int i = 0; i <= 1000; ++i) {
    const double linear = i / 1000.0;
    const double expected = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    EXPECT_NEAR(srgbFromLinear(static_cast<float>(linear)), expected, 2e-6) << linear;
  }
}

TEST(Colour, srgbRoundTripsBeyondTheUnitRange) {
  for (int i = -400; i <= 400; ++i) {
    const float linear = static_cast<float>(i) / 100.0f;
    EXPECT_NEAR(linearFromSrgb(srgbFromLinear(linear)), linear, 4e-6f * (1.0f + std::abs(linear)));
  }
}

TEST(Colour, knownCodeValues) {
  EXPECT_NEAR(srgbFromLinear(0.18f) * 255.0f, 117.7f, 0.1f);  // middle grey
  EXPECT_NEAR(linearFromSrgb(128.0f / 255.0f), 0.21586f, 1e-5f);
  EXPECT_FLOAT_EQ(srgbFromLinear(-0.5f), -srgbFromLinear(0.5f));
}

TEST(Colour, luminanceOfWhiteIsOne) {
  EXPECT_FLOAT_EQ(luminance({1.0f, 1.0f, 1.0f}), 1.0f);
  EXPECT_GT(luminance({0.0f, 1.0f, 0.0f}), luminance({1.0f, 0.0f, 0.0f}));
}

// IEC 61966-2-1 prints the matrix with 4 decimals, for a white that differs from CIE's D65 by up to 1.6e-4 in Z.
TEST(Colour, xyzMatchesTheStandardsMatrix) {
  const glm::dvec3 red(0.4124, 0.2126, 0.0193);
  const glm::dvec3 green(0.3576, 0.7152, 0.1192);
  const glm::dvec3 blue(0.1805, 0.0722, 0.9505);
  const glm::dvec3 published[3] = {red, green, blue};
  for (int c = 0; c < 3; ++c) {
    glm::dvec3 primary(0.0);
    primary[c] = 1.0;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(xyzFromLinear(primary)[i], published[c][i], 2e-4) << c << ' ' << i;
  }
}

TEST(Colour, xyzRoundTrips) {
  for (int i = -3; i <= 3; ++i) {
    const glm::dvec3 linear(0.3 * i, 1.0 - 0.2 * i, 0.05 * i * i);
    const glm::dvec3 back = linearFromXyz(xyzFromLinear(linear));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], linear[c], 1e-14);
  }
}

TEST(Colour, labOfGreysHasNoChromaAndKnownLightness) {
  for (int i = -2; i <= 20; ++i) {
    const Lab lab = labFromLinear(glm::dvec3(0.1 * i));
    EXPECT_NEAR(lab.a, 0.0, 1e-12);
    EXPECT_NEAR(lab.b, 0.0, 1e-12);
  }
  EXPECT_NEAR(labFromLinear(glm::dvec3(1.0)).l, 100.0, 1e-12);
  EXPECT_NEAR(labFromLinear(glm::dvec3(0.0)).l, 0.0, 1e-12);
  EXPECT_NEAR(labFromLinear(glm::dvec3(0.184186518512444)).l, 50.0, 1e-9);  // ((50 + 16) / 116)^3
  EXPECT_NEAR(labFromLinear(glm::dvec3(0.001)).l, 0.9033, 1e-4);            // the straight part: 903.3 Y
}

// Lab of the sRGB primaries as widely tabulated (D65): to the hundredth that the choice of white leaves open.
TEST(Colour, labOfThePrimaries) {
  const Lab red = labFromSrgb({1.0, 0.0, 0.0});
  EXPECT_NEAR(red.l, 53.24, 0.01);
  EXPECT_NEAR(red.a, 80.09, 0.02);
  EXPECT_NEAR(red.b, 67.20, 0.02);
  const Lab blue = labFromSrgb({0.0, 0.0, 1.0});
  EXPECT_NEAR(blue.l, 32.30, 0.01);
  EXPECT_NEAR(blue.a, 79.19, 0.02);
  EXPECT_NEAR(blue.b, -107.86, 0.02);
  EXPECT_NEAR(labFromSrgb(glm::dvec3(0.5)).l, labFromLinear(glm::dvec3(linearFromSrgb(0.5f))).l, 1e-4);
}

}  // namespace
}  // namespace sward::image
