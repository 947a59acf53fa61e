#pragma once

#include "base/curve.h"

#include <cstdint>
#include <optional>
#include <string>

#include <glm/glm.hpp>

namespace sward::mesh {

/// How a leaf's surface answers light, from one base colour b (linear RGB, what a photograph of its lit side shows).
/// Reflectance r = b; transmittance t = translucency * tint * b; both scaled down together where r + t would pass 1.
struct LeafOptics {
  double translucency = 0.6;                     ///< 0 opaque (wood, soil, thick petals) to 1
  glm::dvec3 transmissionTint{1.15, 1.1, 0.45};  ///< light that passes a leaf is yellower than what it reflects
  bool operator==(const LeafOptics&) const = default;
};

/// Replaces what a glTF file says of its materials, or gives what it does not say.
struct MaterialOverride {
  std::optional<glm::dvec3> baseColour;  ///< linear RGB; replaces factor and texture
  std::optional<double> alphaCutoff;     ///< (0, 1): treat the texture's alpha as a mask with this cut-off
  LeafOptics optics;
  double brightness = 1.0;  ///< times the base colour, texture included; the product is cut off at 1
  bool operator==(const MaterialOverride&) const = default;
};

/// Heights that GrassShape::heightDistribution can give blades, relative to heightM.
inline constexpr double kLowestRelativeHeight = 0.05;  ///< shorter blades would be no blades
inline constexpr double kHighestRelativeHeight = 2.0;

/// A tuft of procedural grass; lengths in metres, angles in degrees. Ranges are checked by project::validate.
struct GrassShape {
  int bladesPerPlant = 9;
  int segments = 6;               ///< quads along a blade
  double heightM = 0.40;          ///< along the blade, before bending
  double heightVariation = 0.30;  ///< relative standard deviation, cut at two
  /// Relative density of blades over relative height (0 to kHighestRelativeHeight, times heightM): what the blades'
  /// heights are drawn from in place of the normal distribution. Empty: that one. Only its form counts, not its scale.
  base::Curve heightDistribution;
  double widthM = 0.005;       ///< at the widest place
  base::Curve profile;         ///< relative width over 0 (root) to 1 (tip); empty: the built-in lanceolate taper
  double bendDeg = 50.0;       ///< how far the tip's direction turns from the root's
  double leanDeg = 12.0;       ///< inclination at the root, outward from the tuft's middle
  double twistDeg = 40.0;      ///< rotation about the blade's axis, root to tip
  double foldDeg = 25.0;       ///< crease along the midrib; 0 is flat
  double clumpRadiusM = 0.03;  ///< roots stand within this radius of the plant's foot
  double seedHeadShare = 0.0;  ///< fraction of the blades that are stems with a seed head
  glm::dvec3 rootColour{0.060, 0.085, 0.022};  ///< linear RGB
  glm::dvec3 tipColour{0.150, 0.235, 0.045};
  /// Part of the tip's colour in the mix over 0 (root) to 1 (tip), 0 to 1; empty: the built-in rise. Seen at the ends
  /// of the blade's segments, between which colours are mixed linearly.
  base::Curve colourAlong;
  glm::dvec3 seedHeadColour{0.32, 0.24, 0.11};
  double colourVariation = 0.15;  ///< relative, blade to blade
  LeafOptics optics;
  bool operator==(const GrassShape&) const = default;
};

/// A flower: a stem with a few leaves and one head of petals round a centre.
struct FlowerShape {
  double heightM = 0.35;
  double heightVariation = 0.2;
  double stemWidthM = 0.003;
  int leaves = 4;
  double leafLengthM = 0.08;
  int petals = 14;
  double petalLengthM = 0.014;
  double petalWidthM = 0.006;
  double centreRadiusM = 0.006;
  double bendDeg = 15.0;
  glm::dvec3 petalColour{0.85, 0.85, 0.82};
  glm::dvec3 centreColour{0.75, 0.45, 0.03};
  glm::dvec3 leafColour{0.10, 0.17, 0.04};
  double colourVariation = 0.08;
  LeafOptics optics;
  bool operator==(const FlowerShape&) const = default;
};

/// Clover: stems that each carry three leaflets, and now and then a round head.
struct CloverShape {
  int stems = 7;
  double heightM = 0.12;
  double heightVariation = 0.3;
  double leafletLengthM = 0.016;
  double spreadM = 0.05;
  double headShare = 0.08;  ///< fraction of the stems with a flower head instead of leaflets
  glm::dvec3 leafColour{0.075, 0.16, 0.035};
  glm::dvec3 headColour{0.62, 0.42, 0.48};
  double colourVariation = 0.12;
  LeafOptics optics;
  bool operator==(const CloverShape&) const = default;
};

/// A mesh from a glTF 2.0 file.
struct GltfSource {
  std::string path;               ///< relative to the project file
  std::optional<double> heightM;  ///< scale so that it stands this high; absent: the file's own metres
  std::optional<MaterialOverride> material;
  bool operator==(const GltfSource&) const = default;
};

}  // namespace sward::mesh
