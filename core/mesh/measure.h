#pragma once

#include "mesh/model.h"

#include <cstdint>
#include <vector>

namespace sward::mesh {

/// What a plant's mesh amounts to, for choosing how many of them make a sward.
struct Measure {
  double leafAreaM2 = 0.0;  ///< one side of its leaves, holes of alpha left out; closed parts count half their surface
  double solidShare = 0.0;  ///< of the surface that belongs to closed parts, 0 to 1
  /// Mean width of its parts (leaves, stems, heads), weighted by area: one-sided area over the box's diagonal.
  double partWidthM = 0.0;
  double luminance = 0.0;  ///< mean of the reflectance (Rec. 709 weights) over the covered surface, 0 to 1
};

/// A part (triangles that share places of vertices) is closed when each of its edges is crossed as often in one
/// direction as in the other: solids, and leaves that are modelled once for each side.
Measure measure(const Model& model);

/// How a triangle bounds its part, in the sense of measure.
enum class Side : std::int8_t {
  Into = -1,  ///< closed, and the normal of its winding, (b - a) x (c - a), points into the enclosed volume
  Open = 0,   ///< light passes on either side
  Flat = 2,   ///< closed around no volume: a leaf that is modelled once for each side
  Out = 1     ///< closed, the normal points out of it: light comes to it from the other side alone
};
/// Of each triangle. A volume counts from 1e-5 of the surface to the power 3/2: a hundredth of a leaf that is a
/// thousandth of its length thick, and a hundred times the rounding of vertices in float.
std::vector<Side> triangleSides(const Model& model);

}  // namespace sward::mesh
