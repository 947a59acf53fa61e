#pragma once

#include "mesh/model.h"

#include <cstdint>
#include <vector>

namespace sward::mesh {

/// A mesh taken apart: triangles that share places of vertices are one part. Files split vertices where normals or
/// texture coordinates differ, so places count, not indices.
struct Parts {
  std::vector<std::uint32_t> welded;      ///< one a vertex: the number of its place, from 0 in order of appearance
  std::vector<std::uint32_t> ofTriangle;  ///< parts are named by one of their places
  std::vector<bool> open;                 ///< by part's name: an edge is not crossed as often one way as the other
};
Parts findParts(const Model& model);

}  // namespace sward::mesh
