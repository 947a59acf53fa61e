#pragma once

#include "trace/layer_pattern.h"
#include "trace/patch_scene.h"

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include <embree3/rtcore.h>

/// Private to core/trace and to the report's yardstick: what a PatchScene is made of.
namespace sward::trace {

/// Releases Embree objects.
struct EmbreeRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DevicePtr = std::unique_ptr<RTCDeviceTy, EmbreeRelease>;
using ScenePtr = std::unique_ptr<RTCSceneTy, EmbreeRelease>;

/// One geometry of the top-level scene: an instance, or its copy from a neighbouring patch, as far as it reaches into
/// the square.
struct PlacedCopy {
  std::uint32_t instance = 0;            ///< index into Patch::instances
  std::vector<std::uint32_t> triangles;  ///< model triangle of each primitive; empty: they are the same
};

/// What a geometry's alpha filter needs. `copy` is unset for a model that is instanced: the hit then names its copy.
struct AlphaGeometry {
  static constexpr std::uint32_t kInstanced = ~0u;
  const PatchScene::Impl* scene = nullptr;
  const mesh::Model* model = nullptr;
  std::uint32_t copy = kInstanced;
};

/// Packets exactly as they were handed to Embree, in order.
struct RayRecord {
  std::mutex mutex;
  std::vector<RTCRayHit16> nearest;
  std::vector<RTCRay16> occlusion;
};

/// Measured on a dense meadow: the coherent mode traces the short parallel rays of a slab three times as fast as the
/// other, and shadow rays, whose ways part among the blades, no faster and up to 40 % slower.
inline RTCIntersectContext packetContext(RTCIntersectContextFlags flags) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags;
  return context;
}

struct PatchScene::Impl {
  std::shared_ptr<const scene::Patch> patch;
  DevicePtr device;
  std::vector<ScenePtr> modelScenes;  ///< by model; null when the triangles stand in the top-level scene itself
  ScenePtr top;                       ///< null when nothing can be hit
  std::vector<PlacedCopy> copies;     ///< by geometry of `top`
  std::deque<AlphaGeometry> alpha;    ///< stable addresses: Embree keeps pointers
  float side = 0.0f;                  ///< L, metres
  float height = 0.0f;                ///< metres, a rounding above Patch::heightM
  float offset = 0.0f;  ///< start of shadow rays along their direction, metres: hides the surface's own rounding
  mutable std::atomic<std::uint64_t> nearestCount{0}, occlusionCount{0};
  RayRecord* record = nullptr;  ///< set by the report while it collects rays

  /// Traces a packet; lanes with valid[i] = 0 are left alone. The rays of a packet share one direction.
  void intersect(const int* valid, RTCRayHit16& packet) const;
  void occluded(const int* valid, RTCRay16& packet) const;
  SurfaceId surfaceOf(std::uint32_t geometry, std::uint32_t primitive, std::uint32_t instance) const {
    const PlacedCopy& copy = copies[instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry];
    return {copy.instance, copy.triangles.empty() ? primitive : copy.triangles[primitive]};
  }
};

/// Embree's filter callback of geometry that has alpha.
void filterByAlpha(const RTCFilterFunctionNArguments* arguments);

}  // namespace sward::trace
