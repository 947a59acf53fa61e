#pragma once

#include "base/curve.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sward::wither {

/// The autumn that water and chlorophyll follow (TVT paper, figure 9).
enum class Autumn : std::uint8_t {
  Normal,
  AmpleWater,      ///< chlorophyll falls as in the normal autumn, water stays: yellow but upright
  LowTemperature,  ///< both fall early and fast
  Custom           ///< AgeingOptions::water and ::chlorophyll
};

/// How a sward ages. The season runs from 0 (summer's end) to 1; shares are of what the leaf had at 0.
struct AgeingOptions {
  Autumn autumn = Autumn::Normal;
  base::Curve water;        ///< share in [0, 1] over the season, read for Custom; empty: the normal autumn's
  base::Curve chlorophyll;  ///< the same
  /// Weathering degree in [0, 1] over the season, never falling; empty: equal to the season.
  base::Curve weathering;
  double tipLead = 0.30;    ///< of the season: how much earlier the tip of a blade ages than its root
  double variation = 0.12;  ///< of the season: standard deviation of the blades' own start, cut at two
  bool operator==(const AgeingOptions&) const = default;
};

/// How blades give way as they dry.
struct BodyOptions {
  double shrinkVein = 0.12;       ///< volume lost with all water, of the vein: 0 to 0.9; length follows a third of it
  double shrinkMesophyll = 0.60;  ///< the same of the mesophyll, at least the vein's: width and thickness
  double stiffening = 4.0;        ///< what Young's modulus grows to over the season, 1 to 100: shrinking slows down
  double droopDeg = 130.0;        ///< how far the tip of a dry blade has turned, 0 to 170
  double droopVariation = 0.25;   ///< relative standard deviation between blades, cut at two
  double response = 0.04;         ///< of the season: time in which a blade follows two thirds of lost turgor
  bool operator==(const BodyOptions&) const = default;
};

/// A block of voxels that stands for a square of the sward.
struct TexelOptions {
  int resolution = 256;         ///< voxels along each side and over the height: 8 to 512, a multiple of 8
  double proportion = 6.0;      ///< points for a voxel whose leaf area is that of its face: 0.1 to 100
  double splatVoxels = 0.6;     ///< sigma of the points' Gaussian, in voxels
  bool operator==(const TexelOptions&) const = default;
};

/// One of the samples that are mixed: a part of the blades that ages by its own curve.
struct MingleSample {
  std::string name = "sample";
  double share = 1.0;    ///< of the blades; relative to the sum
  double density = 1.0;  ///< times the density that the share gives, 0 to 10
  base::Curve ageing;    ///< Mg: its own weathering degree over the sward's, in [0, 1], never falling; empty: equal
  bool operator==(const MingleSample&) const = default;
};

/// Everything about withering that a project says.
struct WitherOptions {
  double weathering = 0.0;  ///< weathering degree that is shown, 0 to 1
  AgeingOptions ageing;
  BodyOptions body;
  TexelOptions texel;
  std::vector<MingleSample> mingle;  ///< empty: all blades age alike, but for their variation
  bool operator==(const WitherOptions&) const = default;
};

}  // namespace sward::wither
