#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <vector>

namespace sward::wither {

/// The texel as what draws it should see it: a voxel in which leaves turn the share f of its face to an axis lets 1 - f
/// through, not exp(-f), since leaves of one voxel stand side by side, or are one leaf. S is scaled as in halved; no
/// voxel hides more than 99 % of what is behind it, unless its depth does.
/// Density is the trace of S, and areaM2() is more than the leaves' area. For texels of meshes: one made from points is
/// blurred over several voxels already. Errors: Error::cancelled().
Result<Texel> opaque(const Texel& texel, const JobContext& job);

/// The texel of half the voxels along x, y and z. What each of its voxels lets through along each axis is what the four
/// columns of its eight children let through in the mean: the extinction along an axis is -ln(mean of exp(-sum of the
/// children's)) over the thickness. S is that of the children with its rows and columns scaled so that extinction()
/// gives these three; density is its trace. So opacity along the axes is conserved, and areaM2() falls where leaves
/// stand behind one another: it is the area of leaves spread evenly that hide as much. Normals, tangents and materials
/// are means weighted by the children's area. Errors: a grid whose half is not of whole bricks; Error::cancelled().
Result<Texel> halved(const Texel& texel, const JobContext& job);

/// The texel itself and its halves, until a half would have fewer than `coarsest` columns or would not be of whole
/// bricks.
Result<std::vector<Texel>> levels(Texel texel, int coarsest, const JobContext& job);

}  // namespace sward::wither
