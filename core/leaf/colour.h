#pragma once

#include "leaf/spectra.h"

#include <glm/glm.hpp>

namespace sward::leaf {

/// CIE XYZ under D65 of a surface of this reflectance or transmittance, over [400, 750] nm. Scaled so that 1 everywhere
/// gives image::kWhiteXyz, each of X, Y and Z apart, within 1e-12: the rest of vision (0.3 % of Z, below 0.1 % of X
/// and Y) and what the compact forms of observer and light miss then cost no neutral grey its hue.
glm::dvec3 xyzFromSpectrum(const Spectrum& spectrum);

/// The same as linear Rec. 709 RGB: 1 everywhere gives (1, 1, 1). Not limited: saturated yellows, such as light through
/// a leaf, lie outside the gamut and have a negative blue.
glm::dvec3 linearFromSpectrum(const Spectrum& spectrum);

/// A colour that Rec. 709 can show.
struct GamutColour {
  glm::dvec3 linear{0.0};     ///< in [0, 1]
  double desaturation = 0.0;  ///< 0: unchanged; 1: all grey
};
/// Moves a linear RGB colour towards the grey of its own luminance until all channels are in [0, 1]: keeps luminance
/// and, in linear light, hue, where clamping channels would change both. Luminances outside [0, 1] are limited first.
GamutColour intoGamut(const glm::dvec3& linear);

}  // namespace sward::leaf
