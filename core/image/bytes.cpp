#include "image/bytes.h"

#include "image/colour.h"

namespace sward::image {
namespace {

std::uint8_t exactByte(float linear) {
  return toByte(srgbFromLinear(linear));
}

}  // namespace

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
