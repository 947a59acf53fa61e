#include "trace/ground_rays.h"

#include <algorithm>

namespace sward::trace {
namespace {

/// Segments overlap by this fraction of the patch's side, so that rounding leaves no gap at a border.
constexpr float kOverlap = 1e-6f;
constexpr std::uint32_t kIdStep = 0x9e3779b9u;  ///< a piece gives a ray a new id: the next piece's leaf is another

RTCRay rayOf(const glm::dvec3& direction, std::uint32_t id) {
  RTCRay ray{};
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.mask = ~0u;
  ray.id = id;
  return ray;
}

void place(RTCRay& ray, const WalkSegment& segment, float start, float overlap) {
  ray.org_x = segment.origin.x;
  ray.org_y = segment.origin.y;
  ray.org_z = segment.origin.z;
  ray.tnear = std::max(0.0f, start - static_cast<float>(segment.start));
  ray.tfar = segment.length + overlap;
}

}  // namespace

GroundHit GroundRays::nearest(GroundWalk walk, const glm::dvec3& direction, float start, std::uint32_t id) {
  GroundHit hit;
  ++m_rays;
  if (!m_scene.top) return hit;
  RTCIntersectContext context = packetContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  RTCRayHit found{};
  found.ray = rayOf(direction, id);
  found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  WalkSegment segment;
  while (walk.next(segment)) {
    ++m_nearest;
    place(found.ray, segment, start, kOverlap * m_scene.side);
    rtcIntersect1(m_scene.top.get(), &context, &found);
    if (found.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
      hit.any = true;
      hit.raw = {found.ray.tfar, found.hit.u, found.hit.v,
                 m_scene.surfaceOf(found.hit.geomID, found.hit.primID, found.hit.instID[0])};
      hit.t = segment.start + static_cast<double>(found.ray.tfar);
      hit.shift = walk.shift();
      return hit;
    }
    found.ray.id += kIdStep;
  }
  hit.givenUp = walk.givenUp();
  return hit;
}

bool GroundRays::occluded(GroundWalk walk, const glm::dvec3& direction, float start, std::uint32_t id) {
  ++m_rays;
  if (!m_scene.top) return false;
  RTCIntersectContext context = packetContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  RTCRay ray = rayOf(direction, id);
  WalkSegment segment;
  while (walk.next(segment)) {
    ++m_occlusion;
    place(ray, segment, start, kOverlap * m_scene.side);
    rtcOccluded1(m_scene.top.get(), &context, &ray);
    if (ray.tfar < 0.0f) return true;  // Embree marks an occluded ray by -infinity
    ray.id += kIdStep;
  }
  return false;
}

}  // namespace sward::trace
