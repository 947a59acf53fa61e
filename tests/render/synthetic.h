#pragma once

#include "bake/ground_bake.h"

#include <cstdint>

namespace sward::testing {

/// A hand-made ground: grass drawn straight into layers, without tracing, or an even medium.
struct SyntheticOptions {
  int patchTexels = 256;
  int tileTexels = 64;  ///< equal to patchTexels: one tile that is the periodic patch itself
  int tiles = 18;       ///< cut at different places of the patch; their borders do not match
  int apron = 8;
  int layers = 16;
  int blades = 8;
  int bladeTexelsPerSlice = 2;
  int bladeRows = 128;
  double patchSideM = 1.0;
  double heightM = 0.4;
  int mapSide = 64;
  int plants = 1400;
  lpt::Basis basis = lpt::Basis::Lpt;
  int bits = 8;
  bool common = false;  ///< of an LPT: coefficients are what columns differ from a common response
  /// Above 0: an even medium of this coverage a slice layer, coverage of blade texels to match, instead of grass.
  double evenCoverage = 0.0;
  double soilReflectance = -1.0;  ///< not negative: one grey, instead of grainy earth
  std::uint64_t seed = 1;
};

bake::GroundBake syntheticGround(const SyntheticOptions& options);

}  // namespace sward::testing
