#pragma once

#include "lpt/representation.h"

namespace sward::lpt {

/// Marched transmittance (science.md section 1): the response of a texel to light that nothing weakens, times the mean
/// of exp(-optical depth) over some points about its leaves, marched through the patch's voxels toward the light. It
/// needs no samples of light (input.fit.samples may be empty) and serves every weathering of the same patch. Reads
/// input.hits (positions, normals, surfaces) and input.density, a medium of the form Dominant.
///
/// Kept: the voxels and, of every layer texel, a mean normal, how much the normals spread, which sides answer light, and
/// the mean place of its leaves. Quantised to two bytes a voxel and four a texel, for both channels; as floats
/// otherwise. Layer texels that no sample hit take theirs from their neighbours. The voxels, which all layer sets of a
/// patch share, count whole in lightingBytes of each; coverage, which the march reads too, counts with the colours.
///
/// Errors: no hits or density, or they do not fit one another; Error::cancelled().
Result<std::unique_ptr<Representation>> representMarched(const RepresentationInput& input, const FitOptions& options,
                                                         bool quantised, const JobContext& job);

}  // namespace sward::lpt
