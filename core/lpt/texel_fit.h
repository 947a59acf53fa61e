#pragma once

#include "lpt/fit.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt::detail {

/// Values at a light of the functions that a layer texel's response is a sum of.
using LightFunctions = std::vector<double> (*)(const glm::dvec3& light);

/// Least squares of every layer texel by itself, as fit() does a PTM but in any functions, `constant` the index of the
/// one that is free of the ridge lightRidge. In the result perColumn is layers times the number of functions, and rank,
/// condition and path stay empty. Errors as fit().
Result<Fit> fitTexels(const FitInput& input, const FitOptions& options, LightFunctions functions, std::size_t constant,
                      const JobContext& job);

}  // namespace sward::lpt::detail
