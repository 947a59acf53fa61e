#pragma once

#include <array>
#include <cstddef>

namespace sward::leaf {

/// Spectra are sampled at 400, 405, ... 750 nm: what PROSPECT's coefficients and nearly all of vision span. 5 nm is the
/// step that the CIE tabulates colour at.
inline constexpr double kFirstNm = 400.0;
inline constexpr double kLastNm = 750.0;
inline constexpr double kStepNm = 5.0;
inline constexpr std::size_t kSamples = 71;
using Spectrum = std::array<double, kSamples>;

/// Wavelength of sample i, in nm.
constexpr double wavelengthNm(std::size_t i) {
  return kFirstNm + kStepNm * static_cast<double>(i);
}

/// Which published coefficients are meant. They differ in the refractive index, chlorophyll and carotenoids alone.
enum class Calibration {
  Prospect5,  ///< Feret et al. 2008, Remote Sensing of Environment 112, 3030-3043
  ProspectD   ///< Feret et al. 2017, Remote Sensing of Environment 193, 204-215: made for the whole life of a leaf
};

/// What the material of a leaf does at one wavelength. Contents are per leaf area.
struct Absorption {
  double refractiveIndex = 1.4;
  double chlorophyll = 0.0;  ///< a and b together, cm2/ug
  double carotenoid = 0.0;   ///< cm2/ug
  double brown = 0.0;        ///< a unit content's optical depth
  double water = 0.0;        ///< 1/cm
  double dryMatter = 0.0;    ///< cm2/g
};

/// Our compact forms of the published coefficients: a constant and a few Gaussians each (spectra_lobes.h), never
/// negative. They miss the published values by 0.4 % of the greatest one, root mean square, or less (the refractive
/// index by 0.0014). nm in [400, 750]; beyond, the forms only decay.
Absorption absorptionAt(double nm, Calibration calibration);

/// Absorbance of pigments in solution, over that of chlorophyll a at its peak of 427.75 nm (111,700 / (cm M)), at equal
/// moles. Chlorophylls in diethyl ether (PhotochemCAD: Du et al. 1998, Dixon et al. 2005); carotenoids as a green leaf
/// mixes them (Lichtenthaler 1987), 142,000 / (cm M) at the peak.
struct PigmentAbsorbance {
  double chlorophyllA = 0.0, chlorophyllB = 0.0, carotenoid = 0.0;
};
PigmentAbsorbance pigmentAbsorbanceAt(double nm);

/// CIE 1931 2-degree colour-matching functions, our compact forms: within 0.01 of the tables.
struct Observer {
  double x = 0.0, y = 0.0, z = 0.0;
};
Observer observerAt(double nm);

/// Relative power of D65, 1 at 560 nm; a smooth form of the table.
double daylightAt(double nm);

}  // namespace sward::leaf
