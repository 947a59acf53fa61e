#pragma once

#include "base/result.h"
#include "mesh/model.h"

#include <filesystem>
#include <vector>

namespace sward::mesh {

struct GltfReadOptions {
  std::optional<double> heightM;  ///< scale to this height; absent: the file's own metres
  std::optional<MaterialOverride> material;
};

/// Reads a glTF 2.0 file (.glb, or .gltf with files or data URIs): the default scene's triangles (all modes: lists,
/// strips, fans; points and lines are left out with a warning) with node transforms, sparse and normalised accessors,
/// vertex colours, base-colour texture and factor, KHR_texture_transform, alpha modes; normals are computed where
/// missing. Turns y up into z up, stands the model on z = 0, centred in x and y. Errors name the file, the place in it
/// and a remedy: truncated, malformed or hostile data, unsupported required extensions (by name), non-finite positions,
/// no triangles.
Result<Model> readGltf(const std::filesystem::path& path, const GltfReadOptions& options = {});

/// Every file whose bytes decide the result: the file itself, its buffers and its images (existing ones), sorted.
Result<std::vector<std::filesystem::path>> gltfClosure(const std::filesystem::path& path);

}  // namespace sward::mesh
