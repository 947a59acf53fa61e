#pragma once

#include "base/result.h"
#include "leaf/spectra.h"

namespace sward::leaf {

/// PROSPECT (Jacquemoud and Baret 1990, Remote Sensing of Environment 34, 75-91; Feret et al. 2008): a leaf is N plates
/// with rough surfaces, of which the first is lit within a cone and the others diffusely (Allen et al. 1969, Stokes
/// 1862 for piles of plates, continued to N that are not whole).

/// E1(x), the integral of exp(-t)/t from x to infinity; x > 0. Within 4 units of the last place (leaf tests).
double exponentialIntegral(double x);

/// Part of isotropic light that passes one plate of optical depth k >= 0 (Allen et al. 1969, equation 15):
/// (1 - k) exp(-k) + k^2 E1(k), and 1 minus it without cancellation.
struct PlateTransmission {
  double passed = 1.0;
  double absorbed = 0.0;
};
PlateTransmission plateTransmission(double k);

/// Mean of Fresnel's transmission from air into a material of index n >= 1 over a cone of half angle `alphaDeg` (above
/// 0, 90 at most) of even radiance (Stern 1964).
double meanFresnelTransmission(double alphaDeg, double n);

/// The surfaces of a plate, which only the refractive index makes.
struct PlateSurface {
  double index = 1.4;      ///< above 1
  double litPasses = 1.0;  ///< into the first plate, lit within 40 degrees of the normal (Jacquemoud and Baret 1990)
  double diffusePasses = 1.0;
};
PlateSurface plateSurface(double index);

/// Part of the light reflected by the first surface, in [0, 1], that the reflectance includes. That light is colourless
/// and 0.03 to 0.04 of all. 1: all of it, as an integrating sphere measures; 0: none, the shading has a specular part.
struct SurfaceLight {
  double share = 1.0;
};
inline constexpr SurfaceLight kSurfaceKept{1.0}, kSurfaceRemoved{0.0};

/// Both in [0, 1] with a sum of 1 at most.
struct PlateLight {
  double reflectance = 0.0;
  double transmittance = 0.0;
};
/// N = structure plates (1 or more) that have the optical depth `depth` (0 or more) in all.
PlateLight platesLight(const PlateSurface& surface, double depth, double structure, SurfaceLight light);

/// Contents of a leaf per area of one side; defaults are a healthy leaf of grass.
struct LeafContents {
  double structure = 1.5;     ///< number of plates, 1 to 100
  double chlorophyll = 35.0;  ///< a and b, ug/cm2, 0 to 1000
  double carotenoid = 5.0;    ///< ug/cm2, 0 to 1000
  double brown = 0.0;         ///< PROSPECT's unit, 0 to 100
  double waterCm = 0.012;     ///< 0 to 10
  double dryMatter = 0.0045;  ///< g/cm2, 0 to 1
  bool operator==(const LeafContents&) const = default;
};
/// An error names the first value that is not finite or outside its range, with its unit.
Result<void> checkContents(const LeafContents& contents);

/// At any wavelength of [400, 750] nm. Contents must pass checkContents.
PlateLight leafLightAt(const LeafContents& contents, double nm, Calibration calibration, SurfaceLight light);

struct LeafSpectra {
  Spectrum reflectance{}, transmittance{};
};
/// At all samples of a Spectrum, with coefficients that are computed once. Errors of checkContents.
Result<LeafSpectra> leafSpectra(const LeafContents& contents, Calibration calibration, SurfaceLight light);

}  // namespace sward::leaf
