#pragma once

#include "mesh/gltf_accessor.h"
#include "mesh/gltf_material.h"
#include "mesh/model.h"

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace sward::mesh {

/// Triangles of the whole scene while it is being read: positions stay in double and in glTF's own axes until the model
/// is placed.
struct Gathered {
  Model& model;
  std::vector<glm::dvec3> positions;  ///< beside model.normals, uvs and colours
  std::uint64_t degenerate = 0;       ///< triangles without area, left out
  std::uint64_t repairedNormals = 0;
  std::uint64_t otherPrimitives = 0;  ///< points and lines, left out
};

/// Appends the triangles of one primitive under the transform `worldFromMesh`. `node` names its material if the file
/// gives none; `where` names node, mesh and primitive in messages. A primitive without positions, or of points or
/// lines, adds nothing.
Result<void> appendPrimitive(Gathered& out, const GltfDocument& document, MaterialReader& materials,
                             const tinygltf::Primitive& primitive, const std::string& node,
                             const glm::dmat4& worldFromMesh, const std::string& where);

}  // namespace sward::mesh
