#pragma once

#include "base/result.h"
#include "mesh/model.h"

#include <filesystem>

namespace sward::mesh {

/// Writes the model as one binary glTF 2.0 file (.glb): y up, metres, one primitive a material, textures embedded as
/// PNG. readGltf gives it back (positions to float rounding; colours to 8 bits of texture).
Result<void> writeGlb(const std::filesystem::path& path, const Model& model);

}  // namespace sward::mesh
