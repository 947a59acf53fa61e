#include "trace/occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::trace {
namespace {

constexpr std::size_t kLanes = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// Segments overlap by this fraction of the side, so that rounding leaves no gap at a border.
constexpr float kOverlap = 1e-6f;
constexpr std::uint32_t kIdStep = 0x9e3779b9u;  ///< a crossing gives a ray a new id: the next patch's leaf is another

/// Distance along a ray to the border it meets on one axis: (border - p) * inverse + never, never = infinity for a ray
/// along the border.
struct Axis {
  float border = 0.0f, opposite = 0.0f, inverse = 0.0f, never = kInfinity;
  float distance(float p) const { return std::max(0.0f, (border - p) * inverse) + never; }
};

Axis axisOf(double component, float extent) {
  const auto narrow = static_cast<float>(component);
  if (narrow == 0.0f || !std::isfinite(1.0f / narrow)) return {};
  return {narrow > 0.0f ? extent : 0.0f, narrow > 0.0f ? 0.0f : extent, 1.0f / narrow, 0.0f};
}

}  // namespace

struct OcclusionBatch::Direction {
  float dx, dy, dz;
  Axis x, y, z;
};

void OcclusionBatch::Rays::push(float px, float py, float pz, float start, std::uint32_t rayId,
                                std::uint32_t rayIndex) {
  if (count == x.size()) {
    const std::size_t size = std::max<std::size_t>(1024, 2 * count);
    for (auto* column : {&x, &y, &z, &near}) column->resize(size, 0.0f);
    id.resize(size, 0);
    index.resize(size, 0);
  }
  x[count] = px;
  y[count] = py;
  z[count] = pz;
  near[count] = start;
  id[count] = rayId;
  index[count] = rayIndex;
  ++count;
}

void OcclusionBatch::clear() {
  m_active.clear();
  m_occluded.clear();
}

void OcclusionBatch::add(const glm::vec3& origin, std::uint32_t id) {
  m_active.push(origin.x, origin.y, origin.z, 0.0f, id, static_cast<std::uint32_t>(m_occluded.size()));
  m_occluded.push_back(0);
}

void OcclusionBatch::trace(const PatchScene::Impl& scene, const glm::dvec3& direction) {
  if (!scene.top || m_active.count == 0) return;
  const bool horizontal = std::abs(direction.z) < kHorizontal;
  Direction d{
      static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(direction.z), {}, {}, {}};
  d.x = axisOf(direction.x, scene.side);
  d.y = axisOf(direction.y, scene.side);
  if (!horizontal) d.z = axisOf(direction.z, scene.height);
  std::fill_n(m_active.near.begin(), m_active.count, scene.offset);
  const int limit = horizontal ? kMaxHorizontalCrossings : kMaxCrossings;
  std::uint64_t traced = 0;
  for (int crossing = 0; crossing <= limit && m_active.count > 0; ++crossing) {
    m_next.clear();
    for (std::size_t first = 0; first < m_active.count; first += kLanes) tracePacket(scene, d, first);
    traced += m_active.count;
    std::swap(m_active, m_next);
  }
  m_active.clear();
  scene.occlusionCount.fetch_add(traced, std::memory_order_relaxed);
}

void OcclusionBatch::tracePacket(const PatchScene::Impl& scene, const Direction& d, std::size_t first) {
  alignas(64) RTCRay16 ray;
  alignas(64) int valid[kLanes];
  float toBorder[kLanes], toTop[kLanes];
  const std::size_t lanes = std::min(kLanes, m_active.count - first);
  const float* x = m_active.x.data() + first;
  const float* y = m_active.y.data() + first;
  const float* z = m_active.z.data() + first;
  const float slack = kOverlap * scene.side;
  for (std::size_t i = 0; i < kLanes; ++i) {
    toBorder[i] = std::min(d.x.distance(x[i]), d.y.distance(y[i]));
    toTop[i] = d.z.distance(z[i]);
    ray.org_x[i] = x[i];
    ray.org_y[i] = y[i];
    ray.org_z[i] = z[i];
    ray.dir_x[i] = d.dx;
    ray.dir_y[i] = d.dy;
    ray.dir_z[i] = d.dz;
    ray.tnear[i] = m_active.near[first + i];
    ray.tfar[i] = std::min(toBorder[i], toTop[i]) + slack;
    ray.time[i] = 0.0f;
    ray.mask[i] = ~0u;
    ray.id[i] = m_active.id[first + i];
    ray.flags[i] = 0;
    valid[i] = i < lanes ? -1 : 0;
    if (i >= lanes) ray.tfar[i] = -1.0f;
  }
  scene.occluded(valid, ray);
  for (std::size_t i = 0; i < lanes; ++i) {
    if (ray.tfar[i] < 0.0f) {  // Embree marks an occluded ray by -infinity
      m_occluded[m_active.index[first + i]] = 1;
      continue;
    }
    if (toTop[i] <= toBorder[i]) continue;
    const float t = toBorder[i];
    const bool crossesX = d.x.distance(x[i]) <= d.y.distance(y[i]);
    const float nextX = crossesX ? d.x.opposite : std::clamp(x[i] + t * d.dx, 0.0f, scene.side);
    const float nextY = crossesX ? std::clamp(y[i] + t * d.dy, 0.0f, scene.side) : d.y.opposite;
    m_next.push(nextX, nextY, z[i] + t * d.dz, std::max(0.0f, m_active.near[first + i] - t),
                m_active.id[first + i] + kIdStep, m_active.index[first + i]);
  }
}

}  // namespace sward::trace
