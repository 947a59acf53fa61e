#pragma once

#include <algorithm>
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

/// toByte(srgbFromLinear(linear)) for any float, by a table: a fiftieth of the time of the power.
class SrgbBytes {
 public:
  SrgbBytes();
  std::uint8_t operator()(float linear) const;

 private:
  // Floats from 2^-13 on by exponent and eight bits of mantissa; steps of the curve are wider than these cells, so that
  // each holds one threshold at most.
  static constexpr int kMantissaBits = 8, kOctaves = 13;
  static constexpr int kCells = kOctaves << kMantissaBits;
  float m_threshold[kCells];    ///< least float of the cell that is one byte brighter; 2 where none is
  std::uint8_t m_byte[kCells];  ///< of the cell's first float
};

/// Made once for the process, when first asked for.
const SrgbBytes& srgbBytes();

}  // namespace sward::image
