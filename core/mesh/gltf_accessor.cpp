#include "mesh/gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace sward::mesh {
namespace {

using Bytes = std::span<const std::byte>;

constexpr const char* kRemedy = "Export the file again; its data is damaged.";

template <typename T>
T load(const std::byte* p) {
  T value;
  std::memcpy(&value, p, sizeof value);
  return value;
}

int componentCount(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      return 0;
  }
}

std::uint32_t unsignedAt(const std::byte* data, int type, std::uint64_t i) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(data + i);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(data + 2 * i);
    default:
      return load<std::uint32_t>(data + 4 * i);
  }
}

bool isIndexType(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

double component(const std::byte* p, int type, bool normalised) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double v = load<std::int8_t>(p);
      return normalised ? std::max(v / 127.0, -1.0) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
      const double v = load<std::uint8_t>(p);
      return normalised ? v / 255.0 : v;
    }
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double v = load<std::int16_t>(p);
      return normalised ? std::max(v / 32767.0, -1.0) : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
      const double v = load<std::uint16_t>(p);
      return normalised ? v / 65535.0 : v;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
      const double v = load<std::uint32_t>(p);
      return normalised ? v / 4294967295.0 : v;
    }
    default:
      return static_cast<double>(load<float>(p));
  }
}

/// Bytes from `offset` that must hold `count` elements of `size` bytes, `stride` apart.
Result<const std::byte*> checkedRange(Bytes view, std::uint64_t offset, std::uint64_t count, std::uint64_t size,
                                      std::uint64_t stride, const std::string& where) {
  // No sum or product below can overflow: offset, count and stride are at most 2^53, and count is compared by division.
  const bool fits =
      offset <= view.size() && size <= view.size() - offset && (count - 1) <= (view.size() - offset - size) / stride;
  if (!fits) {
    return Error::badInput(std::to_string(count) + " elements of " + std::to_string(size) + " bytes from byte " +
                               std::to_string(offset) + " do not fit in the buffer view's " +
                               std::to_string(view.size()) + " bytes",
                           where, kRemedy);
  }
  return view.data() + offset;
}

}  // namespace

Result<AccessorView> AccessorView::make(const GltfDocument& document, int accessor) {
  const tinygltf::Accessor& source = document.model.accessors[static_cast<std::size_t>(accessor)];
  AccessorView view;
  view.m_where = "accessors[" + std::to_string(accessor) + "]";
  view.m_count = source.count;
  view.m_components = componentCount(source.type);
  view.m_componentType = source.componentType;
  view.m_componentBytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(source.componentType));
  view.m_normalised = source.normalized;
  if (view.m_count == 0) return Error::badInput("the accessor has no elements", view.m_where, kRemedy);
  if (view.m_components == 0) return Error::badInput("the accessor holds matrices", view.m_where, kRemedy);

  const auto size = static_cast<std::uint64_t>(view.m_components * view.m_componentBytes);
  if (source.bufferView >= 0) {
    const std::uint64_t stride = document.model.bufferViews[static_cast<std::size_t>(source.bufferView)].byteStride;
    if (stride != 0 && stride < size) {
      return Error::badInput(
          "the stride of " + std::to_string(stride) + " bytes is less than an element's " + std::to_string(size),
          view.m_where, kRemedy);
    }
    view.m_stride = stride != 0 ? stride : size;
    SWARD_ASSIGN(const Bytes bytes, bufferViewBytes(document, source.bufferView));
    SWARD_ASSIGN(view.m_data, checkedRange(bytes, source.byteOffset, view.m_count, size, view.m_stride, view.m_where));
  } else if (view.m_count > kMaxEmptyCount) {
    return Error::badInput("an accessor without data claims " + std::to_string(view.m_count) + " elements",
                           view.m_where, kRemedy);
  }
  if (!source.sparse.isSparse) return view;

  const std::string where = view.m_where + ".sparse";
  view.m_sparseCount = static_cast<std::uint64_t>(std::max(source.sparse.count, 0));
  view.m_sparseType = source.sparse.indices.componentType;
  if (view.m_sparseCount == 0) return view;
  if (view.m_sparseCount > view.m_count)
    return Error::badInput("there are more sparse elements than elements", where, kRemedy);
  if (!isIndexType(view.m_sparseType))
    return Error::badInput("the sparse indices are not unsigned integers", where, kRemedy);
  if (source.sparse.indices.byteOffset < 0 || source.sparse.values.byteOffset < 0) {
    return Error::badInput("a sparse offset is out of range", where, kRemedy);
  }
  const auto indexBytes =
      static_cast<std::uint64_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(view.m_sparseType)));
  SWARD_ASSIGN(const Bytes indexView, bufferViewBytes(document, source.sparse.indices.bufferView));
  SWARD_ASSIGN(view.m_sparseIndices,
               checkedRange(indexView, static_cast<std::uint64_t>(source.sparse.indices.byteOffset), view.m_sparseCount,
                            indexBytes, indexBytes, where + ".indices"));
  SWARD_ASSIGN(const Bytes valueView, bufferViewBytes(document, source.sparse.values.bufferView));
  SWARD_ASSIGN(view.m_sparseValues, checkedRange(valueView, static_cast<std::uint64_t>(source.sparse.values.byteOffset),
                                                 view.m_sparseCount, size, size, where + ".values"));
  for (std::uint64_t i = 0; i < view.m_sparseCount; ++i) {
    const std::uint32_t here = unsignedAt(view.m_sparseIndices, view.m_sparseType, i);
    const bool rises = i == 0 || here > unsignedAt(view.m_sparseIndices, view.m_sparseType, i - 1);
    if (here >= view.m_count || !rises) {
      return Error::badInput("sparse index " + std::to_string(here) + " is out of range or out of order",
                             where + ".indices[" + std::to_string(i) + "]", kRemedy);
    }
  }
  return view;
}

const std::byte* AccessorView::element(std::uint64_t i) const {
  std::uint64_t low = 0, high = m_sparseCount;
  while (low < high) {
    const std::uint64_t middle = (low + high) / 2;
    const std::uint32_t found = unsignedAt(m_sparseIndices, m_sparseType, middle);
    if (found == i) {
      return m_sparseValues + middle * static_cast<std::uint64_t>(m_components * m_componentBytes);
    }
    if (found < i) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return m_data == nullptr ? nullptr : m_data + i * m_stride;
}

glm::dvec4 AccessorView::at(std::uint64_t i) const {
  glm::dvec4 value(0.0);
  const std::byte* p = element(i);
  if (p == nullptr) return value;
  for (int c = 0; c < m_components; ++c) value[c] = component(p + c * m_componentBytes, m_componentType, m_normalised);
  return value;
}

std::uint32_t AccessorView::index(std::uint64_t i) const {
  const std::byte* p = element(i);
  return p == nullptr ? 0 : unsignedAt(p, m_componentType, 0);
}

}  // namespace sward::mesh
