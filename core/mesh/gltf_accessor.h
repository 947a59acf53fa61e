#pragma once

#include "mesh/gltf_document.h"

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

namespace sward::mesh {

/// Reads the elements of one accessor where they lie: nothing is copied, so that many accessors over one buffer cost no
/// memory. Every byte that at() or index() touches was checked against its buffer when the view was made.
class AccessorView {
 public:
  /// Errors: a view that is too short, a stride below the element's size, bad sparse indices.
  static Result<AccessorView> make(const GltfDocument& document, int accessor);

  std::uint64_t count() const { return m_count; }
  int components() const { return m_components; }  ///< 1 to 4; 0 for matrices
  int componentType() const { return m_componentType; }
  bool isFloat() const { return m_componentType == TINYGLTF_COMPONENT_TYPE_FLOAT; }
  const std::string& where() const { return m_where; }

  /// Element i < count(): normalised integers as glTF 2.0 has them (signed ones at least -1), others by their value;
  /// absent components are 0.
  glm::dvec4 at(std::uint64_t i) const;
  /// Element i < count() of a scalar of unsigned integers.
  std::uint32_t index(std::uint64_t i) const;

 private:
  const std::byte* element(std::uint64_t i) const;  ///< nullptr: all zero

  const std::byte* m_data = nullptr;
  std::uint64_t m_stride = 0;
  std::uint64_t m_count = 0;
  int m_components = 0;
  int m_componentType = 0;
  int m_componentBytes = 0;
  bool m_normalised = false;
  std::string m_where;
  // Sparse substitution: indices rise strictly, so that a binary search finds an element.
  const std::byte* m_sparseIndices = nullptr;
  const std::byte* m_sparseValues = nullptr;
  int m_sparseType = 0;
  std::uint64_t m_sparseCount = 0;
};

}  // namespace sward::mesh
