#include "mesh/gltf_primitive.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace sward::mesh {
namespace {

constexpr const char* kRemedy = "Export the file again; its data is damaged.";

/// The attributes of a primitive that are read; absent ones are empty.
struct Attributes {
  std::optional<AccessorView> positions;
  std::optional<AccessorView> normals;
  std::optional<AccessorView> uvs;
  std::optional<AccessorView> colours;
};

/// One attribute, its shape checked: components between `least` and `most`, as many elements as there are positions.
Result<std::optional<AccessorView>> attribute(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                              const std::string& name, int least, int most,
                                              const std::optional<AccessorView>& positions) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return std::optional<AccessorView>();
  SWARD_ASSIGN(const AccessorView view, AccessorView::make(document, found->second));
  if (view.components() < least || view.components() > most ||
      view.componentType() == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return Error::badInput(name + " has the wrong type of accessor", view.where(), kRemedy);
  }
  if (positions && view.count() != positions->count()) {
    return Error::badInput(
        name + " has " + std::to_string(view.count()) + " elements, POSITION has " + std::to_string(positions->count()),
        view.where(), kRemedy);
  }
  return std::optional<AccessorView>(view);
}

Result<Attributes> attributesOf(const GltfDocument& document, const tinygltf::Primitive& primitive, int texCoord) {
  Attributes result;
  SWARD_ASSIGN(result.positions, attribute(document, primitive, "POSITION", 3, 3, std::nullopt));
  if (!result.positions) return result;
  SWARD_ASSIGN(result.normals, attribute(document, primitive, "NORMAL", 3, 3, result.positions));
  SWARD_ASSIGN(result.uvs,
               attribute(document, primitive, "TEXCOORD_" + std::to_string(texCoord), 2, 2, result.positions));
  SWARD_ASSIGN(result.colours, attribute(document, primitive, "COLOR_0", 3, 4, result.positions));
  return result;
}

/// Corner k of triangle t of a list, strip or fan, as a place in the sequence of indices (glTF 2.0, 3.7.2.1).
std::array<std::uint64_t, 3> cornersOf(int mode, std::uint64_t t) {
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {t, t + 1 + t % 2, t + 2 - t % 2};
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {t + 1, t + 2, 0};
  return {3 * t, 3 * t + 1, 3 * t + 2};
}

std::uint64_t triangleCount(int mode, std::uint64_t indices) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return indices / 3;
  return indices < 3 ? 0 : indices - 2;
}

/// The index sequence of a primitive: its accessor, or 0, 1, 2, ...
class IndexSequence {
 public:
  static Result<IndexSequence> make(const GltfDocument& document, const tinygltf::Primitive& primitive,
                                    std::uint64_t vertices) {
    IndexSequence sequence;
    sequence.m_vertices = vertices;
    sequence.m_count = vertices;
    if (primitive.indices < 0) return sequence;
    SWARD_ASSIGN(const AccessorView view, AccessorView::make(document, primitive.indices));
    const int type = view.componentType();
    if (view.components() != 1 ||
        (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
      return Error::badInput("the indices are not unsigned integers", view.where(), kRemedy);
    }
    sequence.m_count = view.count();
    sequence.m_view = view;
    return sequence;
  }

  std::uint64_t count() const { return m_count; }
  Result<std::uint64_t> at(std::uint64_t i) const {
    if (!m_view) return i;
    const std::uint64_t index = m_view->index(i);
    if (index >= m_vertices) {
      return Error::badInput("index " + std::to_string(index) + " at place " + std::to_string(i) +
                                 " is out of range: there are " + std::to_string(m_vertices) + " vertices",
                             m_view->where(), kRemedy);
    }
    return index;
  }

 private:
  std::uint64_t m_vertices = 0;
  std::uint64_t m_count = 0;
  std::optional<AccessorView> m_view;
};

/// A linear map for normals: the cofactors of the linear part, turned outward again under a mirror.
glm::dmat3 normalMap(const glm::dmat3& m, double determinant) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return determinant < 0.0 ? -1.0 * cofactors : cofactors;
}

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Unit vector along v however long it is, or nothing.
std::optional<glm::dvec3> direction(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!std::isfinite(largest) || !(largest > 0.0)) return std::nullopt;
  return glm::normalize(v / largest);
}

class PrimitiveWriter {
 public:
  PrimitiveWriter(Gathered& out, const Attributes& attributes, const glm::dmat4& worldFromMesh, std::string where)
      : m_out(out),
        m_attributes(attributes),
        m_world(worldFromMesh),
        m_determinant(glm::determinant(glm::dmat3(worldFromMesh))),
        m_normalMap(normalMap(glm::dmat3(worldFromMesh), m_determinant)),
        m_where(std::move(where)) {}

  /// Adds one triangle of the source's vertices, unless it has no area.
  Result<void> add(std::array<std::uint64_t, 3> corners, std::uint32_t material) {
    if (m_determinant < 0.0) std::swap(corners[1], corners[2]);
    std::array<glm::dvec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      SWARD_ASSIGN(p[i], position(corners[i]));
    }
    const std::optional<glm::dvec3> face = direction(glm::cross(p[1] - p[0], p[2] - p[0]));
    if (!face) {
      ++m_out.degenerate;
      return {};
    }
    glm::uvec3 triangle(0);
    for (std::size_t i = 0; i < 3; ++i) {
      triangle[static_cast<glm::length_t>(i)] = vertex(corners[i], p[i], *face);
    }
    if (m_out.positions.size() > kMaxVertices || m_out.model.triangles.size() >= kMaxTriangles) {
      return Error::badInput("the scene has more than " + std::to_string(kMaxTriangles) + " triangles", m_where,
                             "Use a simpler model.");
    }
    m_out.model.triangles.push_back(triangle);
    m_out.model.triangleMaterial.push_back(material);
    return {};
  }

 private:
  Result<glm::dvec3> position(std::uint64_t source) const {
    const glm::dvec3 world(m_world * glm::dvec4(glm::dvec3(m_attributes.positions->at(source)), 1.0));
    if (!isFinite(world)) {
      return Error::badInput("the position of vertex " + std::to_string(source) + " is not a finite number", m_where,
                             "Mend the mesh (remove the vertex, apply its modifiers) and export it again.");
    }
    return world;
  }

  /// The vertex in the model: shared when the file brings a normal for it, else the triangle's own with a flat normal.
  std::uint32_t vertex(std::uint64_t source, const glm::dvec3& world, const glm::dvec3& face) {
    if (m_attributes.normals) {
      const auto found = m_written.find(source);
      if (found != m_written.end()) return found->second;
    }
    glm::dvec3 normal = face;
    if (m_attributes.normals) {
      const std::optional<glm::dvec3> given = direction(m_normalMap * glm::dvec3(m_attributes.normals->at(source)));
      if (!given) ++m_out.repairedNormals;
      normal = given.value_or(face);
    }
    m_out.positions.push_back(world);
    m_out.model.normals.emplace_back(normal);
    m_out.model.uvs.push_back(uv(source));
    m_out.model.colours.push_back(colour(source));
    const auto index = static_cast<std::uint32_t>(m_out.positions.size() - 1);
    if (m_attributes.normals) m_written.emplace(source, index);
    return index;
  }

  glm::vec2 uv(std::uint64_t source) const {
    if (!m_attributes.uvs) return glm::vec2(0.0f);
    const glm::dvec4 value = m_attributes.uvs->at(source);
    return std::isfinite(value.x) && std::isfinite(value.y) ? glm::vec2(value) : glm::vec2(0.0f);
  }

  glm::vec4 colour(std::uint64_t source) const {
    if (!m_attributes.colours) return glm::vec4(1.0f);
    glm::dvec4 value = m_attributes.colours->at(source);
    if (m_attributes.colours->components() == 3) value.a = 1.0;
    for (int c = 0; c < 4; ++c) value[c] = std::isfinite(value[c]) ? std::clamp(value[c], 0.0, 1.0) : 1.0;
    return glm::vec4(value);
  }

  Gathered& m_out;
  const Attributes& m_attributes;
  glm::dmat4 m_world;
  double m_determinant;
  glm::dmat3 m_normalMap;
  std::string m_where;
  std::unordered_map<std::uint64_t, std::uint32_t> m_written;  ///< only used vertices of a buffer that others share
};

Error placed(Error error, const std::string& where) {
  error.where = error.where.empty() || error.where == where ? where : where + ", " + error.where;
  return error;
}

}  // namespace

Result<void> appendPrimitive(Gathered& out, const GltfDocument& document, MaterialReader& materials,
                             const tinygltf::Primitive& primitive, const std::string& node,
                             const glm::dmat4& worldFromMesh, const std::string& where) {
  const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  if (mode < TINYGLTF_MODE_TRIANGLES) {
    ++out.otherPrimitives;
    return {};
  }
  Result<Attributes> attributes = attributesOf(document, primitive, materials.texCoord(primitive.material));
  if (!attributes.ok()) return placed(std::move(attributes).error(), where);
  if (!attributes->positions) return {};
  Result<IndexSequence> indices = IndexSequence::make(document, primitive, attributes->positions->count());
  if (!indices.ok()) return placed(std::move(indices).error(), where);

  const std::uint64_t count = triangleCount(mode, indices->count());
  if (count == 0) return {};
  const std::uint32_t material = materials.use(primitive.material, node);
  PrimitiveWriter writer(out, *attributes, worldFromMesh, where);
  for (std::uint64_t t = 0; t < count; ++t) {
    std::array<std::uint64_t, 3> corners = cornersOf(mode, t);
    for (std::uint64_t& corner : corners) {
      const Result<std::uint64_t> index = indices->at(corner);
      if (!index.ok()) return placed(index.error(), where);
      corner = *index;
    }
    SWARD_TRY(writer.add(corners, material));
  }
  return {};
}

}  // namespace sward::mesh
