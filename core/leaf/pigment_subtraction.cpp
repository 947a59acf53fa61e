#include "leaf/pigment_subtraction.h"

#include "leaf/ageing.h"
#include "leaf/range_check.h"

#include <array>

namespace sward::leaf {
namespace {

struct FreshPigments {
  Spectrum chlorophyll{}, carotenoid{};
};

FreshPigments freshPigments() {
  constexpr double whole = kChlorophyllAShare + kChlorophyllBShare + kCarotenoidShare;
  FreshPigments fresh;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const PigmentAbsorbance p = pigmentAbsorbanceAt(wavelengthNm(i));
    fresh.chlorophyll[i] = (kChlorophyllAShare * p.chlorophyllA + kChlorophyllBShare * p.chlorophyllB) / whole;
    fresh.carotenoid[i] = kCarotenoidShare * p.carotenoid / whole;
  }
  return fresh;
}

}  // namespace

Result<SubtractionSpectra> subtractionSpectra(const LeafOptions& options, double chlorophyllShare) {
  static const FreshPigments fresh = freshPigments();
  SWARD_TRY(checkOptions(options));
  SWARD_TRY(checkRange("the share of chlorophyll", chlorophyllShare, 0.0, 1.0, "", "colour of a leaf"));
  SubtractionSpectra spectra;
  for (std::size_t i = 0; i < kSamples; ++i) {
    double r = options.subtractionLevel -
               options.subtractionStrength * (chlorophyllShare * fresh.chlorophyll[i] + fresh.carotenoid[i]);
    if (r < 0.0) {
      r = 0.0;
      ++spectra.clamped;
    }
    spectra.reflectance[i] = r;
    spectra.transmittance[i] = options.subtractionTransmission * r;
  }
  return spectra;
}

}  // namespace sward::leaf
