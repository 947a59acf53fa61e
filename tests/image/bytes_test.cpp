#include "image/bytes.h"

#include "image/colour.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>

namespace sward::image {
namespace {

std::uint8_t slowly(float linear) {
  return toByte(srgbFromLinear(linear < 0.0f ? 0.0f : (linear > 1.0f ? 1.0f : linear)));
}

TEST(Bytes, RoundToNearestAndClamp) {
  EXPECT_EQ(toByte(0.0f), 0);
  EXPECT_EQ(toByte(0.49f / 255.0f), 0);
  EXPECT_EQ(toByte(0.51f / 255.0f), 1);
  EXPECT_EQ(toByte(254.49f / 255.0f), 254);
  EXPECT_EQ(toByte(1.0f), 255);
  EXPECT_EQ(toByte(7.0f), 255);
  EXPECT_EQ(toByte(-0.2f), 0);
  EXPECT_EQ(toByte(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Bytes, PicturesThereAndBack) {
  Image display(3, 2, 3);
  for (std::size_t i = 0; i < display.pixels.size(); ++i) display.pixels[i] = static_cast<float>(i * 15) / 255.0f;
  const ByteImage bytes = toBytes(display);
  EXPECT_EQ(bytes.width, 3);
  EXPECT_EQ(bytes.height, 2);
  ASSERT_EQ(bytes.rgba.size(), 24u);
  EXPECT_EQ(bytes.at(1, 1)[2], 14 * 15);
  EXPECT_EQ(bytes.at(1, 1)[3], 255);
  const Image back = fromBytes(bytes);
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.pixels, display.pixels);
}

TEST(Bytes, TheTableIsTheCurveRightUpToEveryStep) {
  const SrgbBytes& table = srgbBytes();
  int steps = 0;
  for (int byte = 1; byte < 256; ++byte) {
    // The float at which the byte begins, and its neighbours.
    std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (slowly(std::bit_cast<float>(middle)) < byte ? low : high) = middle;
    }
    for (std::uint32_t bits = high - 40; bits < high + 40; ++bits) {
      const auto linear = std::bit_cast<float>(bits);
      ASSERT_EQ(table(linear), slowly(linear)) << linear;
    }
    ++steps;
  }
  EXPECT_EQ(steps, 255);
}

TEST(Bytes, TheTableIsTheCurveEverywhereElseToo) {
  const SrgbBytes& table = srgbBytes();
  for (std::uint32_t bits = 0; bits < std::bit_cast<std::uint32_t>(4.0f); bits += 997) {
    const auto linear = std::bit_cast<float>(bits);
    ASSERT_EQ(table(linear), slowly(linear)) << linear;
  }
  for (const float odd :
       {-1.0f, -0.0f, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()})
    EXPECT_EQ(table(odd), slowly(odd)) << odd;
  EXPECT_EQ(table(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace sward::image
