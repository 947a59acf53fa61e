#pragma once

#include "trace/layer_pattern.h"
#include "trace/patch_scene_impl.h"
#include "trace/tiled_ground.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/trace: rays over a tiled ground against the patch's geometry.
namespace sward::trace {

/// What a ray over the ground met.
struct GroundHit {
  bool any = false;
  bool givenUp = false;  ///< after GroundWalk::kMaxSegments pieces of the patch
  RawHit raw{};          ///< raw.t counts within the last piece
  double t = 0.0;        ///< along the whole ray
  glm::ivec2 shift{0};   ///< of the last piece: patch texel = world texel + shift, modulo the patch
};

/// Rays of all directions, traced together piece by piece of the patch in packets of 16, in the order in which they
/// were added: near and alike next to each other are faster. Reusable; not shared between threads.
class GroundRays {
 public:
  void clear();
  std::size_t size() const { return m_walks.size(); }
  /// `id` decides about alpha; surfaces nearer than `start` metres are passed over.
  void add(const GroundWalk& walk, const glm::dvec3& direction, float start, std::uint32_t id);

  /// Finds the nearest surface of every ray.
  void traceNearest(const PatchScene::Impl& scene, const TiledGround& ground, RTCIntersectContextFlags flags);
  /// Finds whether anything is met at all: GroundHit::any alone is set. A ray that is given up met nothing.
  void traceOcclusion(const PatchScene::Impl& scene, const TiledGround& ground);

  /// Of the i-th ray added.
  const GroundHit& hit(std::size_t i) const { return m_hits[i]; }
  std::uint64_t segments() const { return m_segments; }  ///< traced since the object was made

 private:
  struct Ray {
    glm::vec3 direction;
    float start;
    std::uint32_t id;
  };
  template <typename Packet>
  void trace(const PatchScene::Impl& scene, const TiledGround& ground, RTCIntersectContextFlags flags);
  template <typename Packet>
  void flush(const PatchScene::Impl& scene, Packet& packet, int lanes, RTCIntersectContextFlags flags);

  std::vector<GroundWalk> m_walks;
  std::vector<Ray> m_rays;
  std::vector<GroundHit> m_hits;
  std::vector<std::uint32_t> m_active, m_next;
  std::vector<double> m_laneStart;
  std::vector<std::uint32_t> m_laneRay;
  std::uint64_t m_segments = 0;
};

}  // namespace sward::trace
