#include "image/bytes.h"

#include "image/colour.h"

#include <bit>

namespace sward::image {
namespace {

constexpr float kDarkest = 0x1p-13f;  ///< below it the curve rounds to 0 (half a step is 1.5e-4)

std::uint8_t exactByte(float linear) {
  return toByte(srgbFromLinear(linear));
}

}  // namespace

SrgbBytes::SrgbBytes() {
  constexpr int kShift = 23 - kMantissaBits;
  const auto first = std::bit_cast<std::uint32_t>(kDarkest);
  for (std::uint32_t cell = 0; cell < kCells; ++cell) {
    std::uint32_t low = first + (cell << kShift), high = low + (1u << kShift);
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

std::uint8_t SrgbBytes::operator()(float linear) const {
  if (!(linear >= kDarkest)) return 0;
  if (linear >= 1.0f) return 255;
  const std::uint32_t cell =
      (std::bit_cast<std::uint32_t>(linear) - std::bit_cast<std::uint32_t>(kDarkest)) >> (23 - kMantissaBits);
  return static_cast<std::uint8_t>(m_byte[cell] + (linear >= m_threshold[cell] ? 1 : 0));
}

const SrgbBytes& srgbBytes() {
  static const SrgbBytes table;
  return table;
}

}  // namespace sward::image
