#pragma once

#include "lpt/layer_stack.h"

#include <array>
#include <span>

#include <glm/glm.hpp>

namespace sward::render {

/// Weights of the quantised coefficients and the constants that their bases add, so that A, B and C of a column are
/// constant + sum of weight times byte: b = q / scale - base, times the light's functions (equation 5, or by power of
/// the coordinate in lpt::responseBasis).
struct LightTerms {
  std::array<float, 20> weights{};
  std::array<float, 6> constants{};
};
LightTerms lightTerms(lpt::Basis basis, lpt::LayerCoordinate coordinate, int channels,
                      std::span<const lpt::CoefficientRange> ranges, const glm::dvec3& light);

/// The same arrays for one coefficient alone, b_j of a channel: 1/2 + b_j / (2 range) as the channel's first constant
/// plus weight times byte, so that [-range, range] is [0, 1].
LightTerms coefficientTerms(lpt::Basis basis, std::span<const lpt::CoefficientRange> ranges, int channel,
                            int coefficient, double range);

}  // namespace sward::render
