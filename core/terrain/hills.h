#pragma once

#include "base/job.h"
#include "base/result.h"
#include "terrain/height_field.h"
#include "terrain/options.h"

namespace sward::terrain {

/// Procedural hills: gradient noise (Perlin 2002, quintic fade) summed over octaves, each of half the size and of a
/// share of the strength that grows with the ruggedness, folded to ridges by the same share (Musgrave's ridged
/// multifractal). The grid repeats, has a sample at the world's origin, whose height is 0, and spans exactly
/// amplitudeM. The same on any number of threads. Errors: values that are not finite or not in the ranges of the
/// project's format; cancelled.
Result<HeightGrid> makeHills(const HillOptions& options, const JobContext& job = {});

}  // namespace sward::terrain
