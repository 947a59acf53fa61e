#pragma once

#include "base/result.h"
#include "leaf/options.h"
#include "leaf/spectra.h"

namespace sward::leaf {

/// The paper's pigments of a fresh leaf, in moles.
inline constexpr double kChlorophyllAShare = 27.0, kChlorophyllBShare = 9.0, kCarotenoidShare = 4.0;

struct SubtractionSpectra {
  Spectrum reflectance{}, transmittance{};
  int clamped = 0;  ///< samples where more was subtracted than there is, and which are 0 for that
};

/// The colour model of time-varying texels (section 3.2): R = L - (P_c C + P_chla Chla + P_chlb Chlb) with the pigments
/// 27 : 9 : 4 of a fresh leaf, the chlorophylls falling together and the carotenoids staying. L is a constant
/// reflectance here, options.subtractionLevel (the paper's is the light itself; the colour is taken under D65
/// afterwards), and the P are the shares of 40 times options.subtractionStrength. Negative values become 0 and are
/// counted. Transmittance is options.subtractionTransmission of the reflectance.
/// Errors: chlorophyllShare outside [0, 1]; checkOptions.
Result<SubtractionSpectra> subtractionSpectra(const LeafOptions& options, double chlorophyllShare);

}  // namespace sward::leaf
