#pragma once

#include "base/result.h"

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::mesh {

// Limits on what one file may make this program allocate.
inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t{1} << 30;    ///< the glTF file, and all buffers together
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{16} << 20;   ///< in the whole scene
inline constexpr std::uint64_t kMaxVertices = std::uint64_t{48} << 20;    ///< three a triangle, where none are shared
inline constexpr std::uint64_t kMaxEmptyCount = std::uint64_t{16} << 20;  ///< elements of an accessor without data

/// A glTF document whose structure was checked: every index within tinygltf's model is in range, every array has its
/// length, every number is finite. Buffers are loaded; `model.buffers` stays empty.
struct GltfDocument {
  std::filesystem::path folder;
  tinygltf::Model model;
  std::vector<std::string> bufferUris;  ///< empty for the binary chunk
  std::vector<std::uint64_t> bufferLengths;
  std::vector<std::string> imageUris;             ///< empty where the image is in a buffer view
  std::vector<std::vector<std::byte>> ownedData;  ///< one a buffer; empty for the binary chunk's
  std::vector<std::span<const std::byte>> buffers;
  std::vector<std::byte> file;  ///< the bytes that the binary chunk's span looks at
  std::span<const std::byte> binaryChunk;
  std::vector<std::string> warnings;
};

/// Structure only: no buffer is read. Errors give the place within the document.
Result<GltfDocument> parseGltf(const std::filesystem::path& path);
/// Fills `buffers`: the binary chunk, data URIs and files; a missing or short one is an error.
Result<void> loadBuffers(GltfDocument& document);
/// The bytes of a buffer view, checked against its buffer.
Result<std::span<const std::byte>> bufferViewBytes(const GltfDocument& document, int bufferView);

}  // namespace sward::mesh
