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

}  // namespace
}  // namespace sward::image
