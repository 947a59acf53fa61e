#include "image/bytes.h"

#include "base/check.h"
#include "image/colour.h"

namespace sward::image {
namespace {

std::uint8_t exactByte(float linear) {
  return toByte(srgbFromLinear(linear));
}

}  // namespace

ByteImage toBytes(const Image& display) {
  SWARD_CHECK_EQ(display.channels, 3);
  ByteImage out{display.width, display.height, {}};
  out.rgba.reserve(display.pixels.size() / 3 * 4);
  for (std::size_t i = 0; i < display.pixels.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) out.rgba.push_back(toByte(display.pixels[i + c]));
    out.rgba.push_back(255);
  }
  return out;
}

Image fromBytes(const ByteImage& bytes) {
  Image out(bytes.width, bytes.height, 3);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = static_cast<float>(bytes.rgba[i / 3 * 4 + i % 3]) / 255.0f;
  return out;
}

SrgbBytes::SrgbBytes() {
  constexpr int kShift = 23 - kMantissaBits;
  for (std::uint32_t cell = 0; cell < kCells; ++cell) {
    std::uint32_t low = kFirst + (cell << kShift), high = low + (1u << kShift);
    m_byte[cell] = exactByte(std::bit_cast<float>(low));
    m_threshold[cell] = 2.0f;
    if (exactByte(std::bit_cast<float>(high - 1)) == m_byte[cell]) continue;
    --high;
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (exactByte(std::bit_cast<float>(middle)) == m_byte[cell] ? low : high) = middle;
    }
    m_threshold[cell] = std::bit_cast<float>(high);
  }
}

const SrgbBytes& srgbBytes() {
  static const SrgbBytes table;
  return table;
}

}  // namespace sward::image
