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

}  // namespace sward::mesh
