#pragma once

#include <cstdint>

namespace sward::lpt {

/// What a texel's light response is kept as. Renderers relight the first three; the others are relit on the processor
/// for one sun, and drawn as a Constant of that light.
enum class Basis : std::uint8_t {
  Lpt,        ///< ten coefficients a pixseries: a biquadratic in (lx, ly, u)
  Ptm,        ///< six coefficients a layer texel: a biquadratic in (lx, ly)
  Constant,   ///< one value a layer texel: the same under every light
  Clustered,  ///< the layers of a pixseries in FitOptions::clusters groups, ten coefficients each
  Hsh,        ///< hemispherical harmonics a layer texel (Gautron et al. 2004)
  Sampled,    ///< nothing is fitted: light traced for the one sun, the yardstick of what a fit costs
  Marched  ///< unshadowed response times a transmittance marched through voxels (science.md section 1); needs no lights
};

/// Coefficients of one channel of a column (Lpt) or layer texel (Ptm, Constant): what stacks hold. 0 for other bases.
constexpr int stackCoefficients(Basis basis) {
  return basis == Basis::Lpt ? 10 : basis == Basis::Ptm ? 6 : basis == Basis::Constant ? 1 : 0;
}

/// What the third variable of an LPT is.
enum class LayerCoordinate : std::uint8_t {
  Response,  ///< how bright a texel is expected to be from what is stored of it anyway (CommonResponse)
  Depth      ///< u = layer / layers, as in the paper
};

/// Whether it is relit on the processor, for one sun at a time.
constexpr bool needsSun(Basis basis) {
  return stackCoefficients(basis) == 0;
}

/// What a fit minimises (LPT, without `paper`), with W = sum_i w_i over a column's texels, K lights, and f written in
/// v = u - ubar, ubar the w-weighted mean of u:
///   (1 / (W K)) sum_i w_i sum_k (f(l_k, v_i) - sample_ik)^2
///     + layerRidge (b2^2 + b4^2 + b5^2 + b8^2) + lightRidge (b0^2 + b1^2 + b3^2 + b6^2 + b7^2)
/// A ridge is so relative to the summed weight of all rows, whatever the number of lights and layers, and a column's
/// result does not change when all its weights are scaled. Rows left out (a sample that is not finite) leave W K and
/// ubar too. A PTM's texel: the same with one texel and no v. LayerCoordinate::Response: samples less the common
/// response, v = g - gbar, and the layer ridge on all coefficients that contain v.
struct FitOptions {
  Basis basis = Basis::Lpt;
  /// Of Basis::Lpt, without `paper`; Response needs the sky terms of the texels, and is Depth where they are not given.
  LayerCoordinate coordinate = LayerCoordinate::Response;
  int clusters = 2;           ///< 2 or 4, of Basis::Clustered
  bool paper = false;         ///< no ridge, weights delta alone, not centred: the paper's own fit, for comparison
  double layerRidge = 0.005;  ///< >= 0, on the coefficients that contain v, relative to the summed weight of the rows
  double lightRidge = 0.002;  ///< >= 0, on those of the light alone; the constant is free
  int bits = 8;               ///< of a quantised coefficient: 8 or 16
  double clampQuantile =
      0.0;  ///< [0, 0.5): share of the coefficients cut off at each end of the range before quantising
  bool operator==(const FitOptions&) const = default;
};

}  // namespace sward::lpt
