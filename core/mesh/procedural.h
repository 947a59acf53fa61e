#pragma once

#include "mesh/model.h"
#include "mesh/options.h"

#include <cstdint>

namespace sward::mesh {

/// One plant of each kind, standing at the origin; the same seed gives the same vertices. Never empty for valid
/// options.
Model growGrass(const GrassShape& shape, std::uint64_t seed);
Model growFlower(const FlowerShape& shape, std::uint64_t seed);
Model growClover(const CloverShape& shape, std::uint64_t seed);

/// What grass follows where a curve of its shape is empty, as curves to show and to start editing from; close to, not
/// the same as, the functions that are used then.
base::Curve builtInProfile();
base::Curve builtInColourAlong();
base::Curve builtInHeightDistribution(double heightVariation);

}  // namespace sward::mesh
