#pragma once

#include <cstdint>

namespace sward::lpt {

/// Which functions a texel's light response is made of.
enum class Basis : std::uint8_t {
  Lpt,  ///< ten coefficients a pixseries: a biquadratic in (lx, ly, u)
  Ptm   ///< six coefficients a layer texel: a biquadratic in (lx, ly)
};

struct FitOptions {
  Basis basis = Basis::Lpt;
  bool paper = false;         ///< no ridge, weights delta alone, not centred: the paper's own fit, for comparison
  double layerRidge = 0.02;   ///< on the coefficients that contain v, relative to the summed weight
  double lightRidge = 0.002;  ///< on those of the light alone; the constant is free
  int bits = 8;               ///< of a quantised coefficient: 8 or 16
  double clampQuantile =
      0.0;  ///< [0, 0.5): share of the coefficients cut off at each end of the range before quantising
  bool operator==(const FitOptions&) const = default;
};

}  // namespace sward::lpt
