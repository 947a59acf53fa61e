#pragma once

#include "leaf/options.h"
#include "leaf/pigment_subtraction.h"
#include "leaf/prospect.h"

namespace sward::leaf {

/// What a leaf contains, from its measured reflectance with surface light, as an integrating sphere sees it: least
/// squares, weighted by what the eye sees of a wavelength, of structure, chlorophyll, carotenoids, brown pigments and
/// dry matter, with PROSPECT-D. Structure is kept in the 1 to 4 that leaves were found to have (Jacquemoud and Baret
/// 1990). Water absorbs too little of what is visible to be found, and is 0. The transmittance, where it was measured,
/// counts as much; nullptr: it was not, and structure and contents are then known only in proportion where a leaf is
/// opaque. Some 3000 evaluations, about 40 ms.
struct FittedContents {
  LeafContents contents;
  LeafSpectra spectra;  ///< of these contents
  double rmse = 0.0;    ///< of the reflectance over all samples, unweighted
  double max = 0.0;
};
FittedContents fitContents(const Spectrum& reflectance, const Spectrum* transmittance = nullptr);

/// The same for the paper's subtraction: level, strength and the share of chlorophyll that remains.
struct FittedSubtraction {
  double level = 0.0, strength = 0.0, chlorophyllShare = 0.0;
  SubtractionSpectra spectra;
  double rmse = 0.0;
  double max = 0.0;
};
FittedSubtraction fitSubtraction(const Spectrum& reflectance);

}  // namespace sward::leaf
