#pragma once

#include "scene/patch.h"

#include <cstddef>
#include <cstdint>
#include <vector>

/// Private to core/trace: how high a patch stands where.
namespace sward::trace {

/// The top of everything over each texel of a periodic patch, never too low, and over squares of texels.
class HeightField {
 public:
  static constexpr int kSteps = 255;  ///< of the patch's height

  /// `texels` along the patch's side; vertices must be finite.
  HeightField(const scene::Patch& patch, int texels);

  double unitM() const { return m_unitM; }
  /// Highest over the square of `side` x `side` texels from (x, y) on toward +x and +y, all in [0, texels); in units.
  std::uint8_t over(int x, int y, int side) const;

 private:
  void raise(const scene::Patch& patch, const scene::Instance& instance);
  void buildLevels();
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(m_texels) + static_cast<std::size_t>(x);
  }
  int wrap(int i) const { return i >= m_texels ? i - m_texels : i; }

  int m_texels;
  double m_sideM, m_unitM;
  std::vector<std::vector<std::uint8_t>> m_levels;  ///< [k][y][x]: over 2^k x 2^k texels
};

}  // namespace sward::trace
