#include "trace/ground_rays.h"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

namespace sward::trace {
namespace {

constexpr int kLanes = 16;
/// Segments overlap by this fraction of the patch's side, so that rounding leaves no gap at a border.
constexpr float kOverlap = 1e-6f;
constexpr std::uint32_t kIdStep = 0x9e3779b9u;  ///< a piece gives a ray a new id: the next piece's leaf is another

RTCRay16& rayOf(RTCRay16& packet) {
  return packet;
}
RTCRay16& rayOf(RTCRayHit16& packet) {
  return packet.ray;
}

}  // namespace

void GroundRays::clear() {
  m_walks.clear();
  m_rays.clear();
}

void GroundRays::add(const GroundWalk& walk, const glm::dvec3& direction, float start, std::uint32_t id) {
  m_walks.push_back(walk);
  m_rays.push_back({glm::vec3(direction), start, id});
}

void GroundRays::traceNearest(const PatchScene::Impl& scene, const TiledGround& ground,
                              RTCIntersectContextFlags flags) {
  trace<RTCRayHit16>(scene, ground, flags);
}

void GroundRays::traceOcclusion(const PatchScene::Impl& scene, const TiledGround& ground) {
  trace<RTCRay16>(scene, ground, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
}

template <typename Packet>
void GroundRays::trace(const PatchScene::Impl& scene, const TiledGround& ground, RTCIntersectContextFlags flags) {
  m_hits.assign(m_walks.size(), {});
  if (!scene.top) return;
  m_active.resize(m_walks.size());
  std::iota(m_active.begin(), m_active.end(), 0u);
  m_laneStart.resize(kLanes);
  m_laneRay.resize(kLanes);
  const float slack = kOverlap * scene.side;
  alignas(64) Packet packet;
  while (!m_active.empty()) {
    m_next.clear();
    int lanes = 0;
    for (const std::uint32_t index : m_active) {
      WalkSegment segment;
      if (!m_walks[index].next(ground, segment)) {
        m_hits[index].givenUp = m_walks[index].givenUp();
        continue;
      }
      const auto lane = static_cast<std::size_t>(lanes);
      Ray& own = m_rays[index];
      RTCRay16& ray = rayOf(packet);
      ray.org_x[lane] = segment.origin.x;
      ray.org_y[lane] = segment.origin.y;
      ray.org_z[lane] = segment.origin.z;
      ray.dir_x[lane] = own.direction.x;
      ray.dir_y[lane] = own.direction.y;
      ray.dir_z[lane] = own.direction.z;
      ray.tnear[lane] = std::max(0.0f, own.start - static_cast<float>(segment.start));
      ray.tfar[lane] = segment.length + slack;
      ray.time[lane] = 0.0f;
      ray.mask[lane] = ~0u;
      ray.id[lane] = own.id;
      ray.flags[lane] = 0;
      own.id += kIdStep;
      m_laneStart[lane] = segment.start;
      m_laneRay[lane] = index;
      if (++lanes == kLanes) {
        flush(scene, packet, lanes, flags);
        lanes = 0;
      }
    }
    if (lanes > 0) flush(scene, packet, lanes, flags);
    std::swap(m_active, m_next);
  }
}

template <typename Packet>
void GroundRays::flush(const PatchScene::Impl& scene, Packet& packet, int lanes, RTCIntersectContextFlags flags) {
  alignas(64) int valid[kLanes];
  for (int i = 0; i < kLanes; ++i) valid[i] = i < lanes ? -1 : 0;
  m_segments += static_cast<std::uint64_t>(lanes);
  RTCIntersectContext context = packetContext(flags);
  if constexpr (std::is_same_v<Packet, RTCRay16>) {
    rtcOccluded16(valid, scene.top.get(), &context, &packet);
    for (std::size_t i = 0; i < static_cast<std::size_t>(lanes); ++i) {
      if (packet.tfar[i] < 0.0f) {  // Embree marks an occluded ray by -infinity
        m_hits[m_laneRay[i]].any = true;
      } else {
        m_next.push_back(m_laneRay[i]);
      }
    }
  } else {
    for (int i = 0; i < lanes; ++i) {
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, scene.top.get(), &context, &packet);
    for (std::size_t i = 0; i < static_cast<std::size_t>(lanes); ++i) {
      const std::uint32_t index = m_laneRay[i];
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) {
        m_next.push_back(index);
        continue;
      }
      GroundHit& hit = m_hits[index];
      hit.any = true;
      hit.raw = {packet.ray.tfar[i], packet.hit.u[i], packet.hit.v[i],
                 scene.surfaceOf(packet.hit.geomID[i], packet.hit.primID[i], packet.hit.instID[0][i])};
      hit.t = m_laneStart[i] + static_cast<double>(packet.ray.tfar[i]);
      hit.shift = m_walks[index].shift();
    }
  }
}

}  // namespace sward::trace
