#pragma once

#include "base/result.h"
#include "project/project.h"

#include <filesystem>

namespace sward::bake {

/// A plant of the project from a glTF file: named after it, in its own metres where they are a grass's (2 cm to 2 m
/// high) and else scaled to 30 cm, and as many on a square metre as make a dense sward (a leaf area index of 3, 4 to
/// 1500 plants). Its share is 0: that is for the caller, who knows the others'. `folder` is the project's; empty while
/// it lies nowhere. Reads the whole mesh: large ones take seconds.
Result<project::Plant> plantFromMesh(const std::filesystem::path& mesh, const std::filesystem::path& folder);

}  // namespace sward::bake
