#pragma once

#include "image/image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::image {

/// A display picture in 8 bits: sRGB-encoded RGB and straight alpha, rows from the top.
struct ByteImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< width * height * 4

  const std::uint8_t* at(int x, int y) const {
    return rgba.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
  }
};

/// The one rounding of display values to 8 bits, for files and for the screen: nearest, clamped, NaN is 0.
inline std::uint8_t toByte(float encoded) {
  if (!(encoded > 0.0f)) return 0;
  return static_cast<std::uint8_t>(std::lround(std::min(encoded, 1.0f) * 255.0f));
}

/// An RGB picture of display values in 8 bits, alpha 255; and the display values of one, RGB.
ByteImage toBytes(const Image& display);
Image fromBytes(const ByteImage& bytes);

/// toByte(srgbFromLinear(linear)) for any float, by a table: a fiftieth of the time of the power.
class SrgbBytes {
 public:
  SrgbBytes();
  std::uint8_t operator()(float linear) const {
    const float kept = linear > kDarkest ? (linear < kBrightest ? linear : kBrightest) : kDarkest;  // NaN is dark
    const std::uint32_t cell = (std::bit_cast<std::uint32_t>(kept) - kFirst) >> (23 - kMantissaBits);
    return static_cast<std::uint8_t>(m_byte[cell] + (kept >= m_threshold[cell] ? 1 : 0));
  }

 private:
  // Floats from 2^-13 to 1 by exponent and eight bits of mantissa; steps of the curve are wider than these cells, so
  // that each holds one threshold at most. Below, the curve rounds to 0 (half a step is 1.5e-4).
  static constexpr int kMantissaBits = 8, kOctaves = 13;
  static constexpr int kCells = kOctaves << kMantissaBits;
  static constexpr float kDarkest = 0x1p-13f;
  static constexpr float kBrightest = 0x1.fffffep-1f;
  static constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(kDarkest);
  std::array<float, kCells> m_threshold;    ///< least float of the cell that is one byte brighter; 2 where none is
  std::array<std::uint8_t, kCells> m_byte;  ///< of the cell's first float
};

/// Made once for the process, when first asked for.
const SrgbBytes& srgbBytes();

}  // namespace sward::image
