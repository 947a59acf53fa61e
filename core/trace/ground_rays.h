#pragma once

#include "trace/layer_pattern.h"
#include "trace/patch_scene_impl.h"
#include "trace/tiled_ground.h"

#include <cstdint>

#include <glm/glm.hpp>

/// Private to core/trace: rays over a tiled ground against the patch's geometry.
namespace sward::trace {

/// What a ray over the ground met.
struct GroundHit {
  bool any = false;
  bool givenUp = false;  ///< after GroundWalk::kMaxPieces pieces of the patch
  RawHit raw{};          ///< raw.t counts within the last segment
  double t = 0.0;        ///< along the whole ray
  glm::ivec2 shift{0};   ///< of the last piece: patch texel = world texel + shift, modulo the patch
};

/// Traces one ray at a time, segment by segment. (Packets of 16, gathered over 32 x 32 pixels, were measured: no faster
/// with Embree's mode for rays that part, and half as fast with its mode for coherent ones.) A worker's own.
class GroundRays {
 public:
  explicit GroundRays(const PatchScene::Impl& scene) : m_scene(scene) {}

  /// The nearest surface, those nearer than `start` metres passed over. `id` decides about alpha.
  GroundHit nearest(GroundWalk walk, const glm::dvec3& direction, float start, std::uint32_t id);
  /// Whether anything is met at all; a ray that is given up met nothing.
  bool occluded(GroundWalk walk, const glm::dvec3& direction, float start, std::uint32_t id);

  /// Traced since the object was made.
  std::uint64_t rays() const { return m_rays; }
  std::uint64_t nearestSegments() const { return m_nearest; }
  std::uint64_t occlusionSegments() const { return m_occlusion; }

 private:
  const PatchScene::Impl& m_scene;
  std::uint64_t m_rays = 0, m_nearest = 0, m_occlusion = 0;
};

}  // namespace sward::trace
