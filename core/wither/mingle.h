#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <span>

namespace sward::wither {

/// A sample that is mixed.
struct MingleInput {
  const Texel* texel = nullptr;
  double density = 1.0;  ///< times its own, at least 0; 0 leaves it out
};

/// Several texels of one grid as one (TVT paper, algorithm 2): rho = sum of density_i rho_i, S alike; normal, tangent,
/// diffuse, transmitted and specular are means weighted by density_i rho_i, directions of unit length again, zero where
/// they cancel. A voxel that one sample alone fills is that sample's, so one sample of density 1 is returned unchanged.
/// Same bytes on any number of threads. Errors: no samples, different grids, a density that is negative or not finite;
/// Error::cancelled().
Result<Texel> mingle(std::span<const MingleInput> samples, const JobContext& job);

/// Between two key frames of one grid: mingle of a with density 1 - t and b with t; a and b themselves at 0 and 1,
/// where t is clamped.
Result<Texel> lerp(const Texel& a, const Texel& b, double t, const JobContext& job = {});

}  // namespace sward::wither
