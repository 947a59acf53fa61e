#pragma once

#include "base/result.h"
#include "trace/patch_scene_impl.h"

namespace sward::trace {

/// Up to this many triangles stand in one tree, transformed: tufts overlap so much that instances trace some ten times
/// slower (measured: 0.24 against 3 million occlusion rays a second). Above it, memory decides for instances.
inline constexpr std::uint64_t kMaxFlatTriangles = 2'000'000;
/// Copies are made of plants that reach at most this many patches away.
inline constexpr int kMaxReach = 8;

/// Whether every vertex and transform is finite, and no plant far larger than the patch.
Result<void> requireTraceable(const scene::Patch& patch);

/// Fills copies, modelScenes, alpha and top from impl.patch, with impl.device, side and height set. Errors: a vertex
/// that is not finite, a plant far larger than the patch, Embree out of memory, cancellation.
Result<void> buildScene(PatchScene::Impl& impl, const JobContext& job);

}  // namespace sward::trace
