#pragma once

#include "mesh/model.h"

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

}  // namespace sward::mesh
