#pragma once

#include "trace/patch_scene_impl.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// Borders of patches that a ray may cross before it counts as free. Rays that rise less than 1e-6 a metre never leave
/// the grass by their height.
inline constexpr int kMaxCrossings = 4096;
inline constexpr int kMaxHorizontalCrossings = 64;
inline constexpr double kHorizontal = 1e-6;

/// Occlusion rays of one direction through the periodic patch: add origins, trace, read `occluded`. Reusable; not
/// shared between threads.
class OcclusionBatch {
 public:
  void clear();
  /// A ray from a point of the square, 0 <= z; `id` decides about alpha.
  void add(const glm::vec3& origin, std::uint32_t id);
  std::size_t size() const { return m_occluded.size(); }

  /// Traces every ray toward the unit vector `direction`, z >= 0, until it is above the patch.
  void trace(const PatchScene::Impl& scene, const glm::dvec3& direction);
  /// After trace: whether something stood in the way of the i-th ray added.
  bool occluded(std::size_t i) const { return m_occluded[i] != 0; }

 private:
  /// Rays under way, all inside the square; arrays padded to whole packets.
  struct Rays {
    std::vector<float> x, y, z, near;
    std::vector<std::uint32_t> id, index;
    std::size_t count = 0;
    void clear() { count = 0; }
    void push(float px, float py, float pz, float start, std::uint32_t rayId, std::uint32_t rayIndex);
  };
  struct Direction;
  void tracePacket(const PatchScene::Impl& scene, const Direction& direction, std::size_t first);

  Rays m_active, m_next;
  std::vector<std::uint8_t> m_occluded;
};

}  // namespace sward::trace
