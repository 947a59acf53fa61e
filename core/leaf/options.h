#pragma once

namespace sward::leaf {

/// How a leaf's colour follows from what it contains, and what a healthy leaf of grass contains. Contents are per leaf
/// area, one side. Ranges are checked by leaf::checkOptions.
struct LeafOptions {
  enum class Model {
    Plates,      ///< PROSPECT: light through plates that absorb; reflectance and transmittance
    Subtraction  ///< the paper of time-varying texels: light minus what dissolved pigments absorb; reflectance alone
  };
  Model model = Model::Plates;

  double structure = 1.5;     ///< N, number of plates, 1 to 100: 1 to 1.5 in grasses (Jacquemoud and Baret 1990)
  double chlorophyll = 35.0;  ///< a and b, ug/cm2, 0 to 1000
  /// ug/cm2, 0 to 1000: between the paper's moles (2.4 to 35 of chlorophyll) and what broad leaves have (8).
  double carotenoid = 5.0;
  double waterCm = 0.012;     ///< equivalent thickness of the water, cm, 0 to 10
  double dryMatter = 0.0045;  ///< g/cm2, 0 to 1
  /// Brown pigments without water, PROSPECT's unit, 0 to 100; none when fresh. Measured dry grasses have 0.6.
  double brownWhenDry = 0.35;
  /// Carotenoids without water, ug/cm2, 0 to 1000. The paper keeps them all (set it to `carotenoid`), which leaves
  /// straw orange; measured dry grasses have 0.3 to 1, measured yellow leaves still all of them.
  double carotenoidWhenDry = 1.5;
  /// Plates without water, 1 to 100: above 2.5 in senescent leaves, whose inner structure falls apart and lets air
  /// between the walls of cells (Jacquemoud and Baret 1990). It makes straw bright.
  double structureWhenDry = 2.6;

  /// Plates: part of the light that the leaf's surface reflects (0.03 to 0.04 of all, colourless) which the colour
  /// includes, 0 to 1: wax and ribs scatter about as much widely as they mirror. 0 leaves all of it to a highlight.
  double surfaceShare = 0.5;

  /// Subtraction: reflectance of a leaf without pigments; the paper's L over the light, which is 1 as printed.
  double subtractionLevel = 0.42;
  /// Subtraction: what all pigments of a fresh leaf subtract, as moles of chlorophyll a at its peak: the unit of the
  /// paper's 27 : 9 : 4.
  double subtractionStrength = 2.2;
  /// Subtraction: transmittance over reflectance; the paper has no transmittance.
  double subtractionTransmission = 0.6;

  bool operator==(const LeafOptions&) const = default;
};

}  // namespace sward::leaf
