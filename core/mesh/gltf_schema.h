#pragma once

#include "base/result.h"

#include <nlohmann/json_fwd.hpp>

namespace sward::mesh {

/// The part of a glTF 2.0 document that decides a mesh, checked and copied: types, ranges, lengths, enumerations and
/// that every index names an existing object. What is not in the copy was never looked at (animations, cameras, skins'
/// joints, unknown extensions and extras), so nothing of it can trip a later stage.
/// Errors say which place ("meshes[2].primitives[0].indices") is wrong and how.
Result<nlohmann::json> checkedGltf(const nlohmann::json& document);

}  // namespace sward::mesh
