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

  double structure = 1.5;      ///< N, number of plates, 1 to 100: 1 to 1.5 in grasses (Jacquemoud and Baret 1990)
  double chlorophyll = 45.0;   ///< a and b, ug/cm2, 0 to 1000
  double carotenoid = 9.0;     ///< ug/cm2, 0 to 1000; stays when the leaf ages
  double waterCm = 0.012;      ///< equivalent thickness of the water, cm, 0 to 10
  double dryMatter = 0.0045;   ///< g/cm2, 0 to 1
  double brownWhenDry = 0.25;  ///< brown pigments without water, PROSPECT's unit, 0 to 100; none when fresh
  /// Plates without water, 1 to 100: above 2.5 in senescent leaves, whose inner structure falls apart and lets air
  /// between the walls of cells (Jacquemoud and Baret 1990). It makes straw bright.
  double structureWhenDry = 2.6;

  /// Subtraction: reflectance of a leaf without pigments; the paper's L over the light, which is 1 as printed.
  double subtractionLevel = 0.45;
  /// Subtraction: what all pigments of a fresh leaf subtract, as moles of chlorophyll a at its peak: the unit of the
  /// paper's 27 : 9 : 4.
  double subtractionStrength = 1.0;
  /// Subtraction: transmittance over reflectance; the paper has no transmittance.
  double subtractionTransmission = 0.6;

  bool operator==(const LeafOptions&) const = default;
};

}  // namespace sward::leaf
