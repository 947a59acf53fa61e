#include "trace/model_scene.h"

#include "trace/patch_scene_impl.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace sward::trace {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

Result<void> fill(RTCGeometry geometry, const mesh::Model& model) {
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                           model.positions.size());
  void* corners = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                          model.triangles.size());
  if (vertices == nullptr || corners == nullptr) {
    return Error::failed("there is not enough memory to trace it", "plant " + model.name, "Use a simpler mesh.");
  }
  std::memcpy(vertices, model.positions.data(), model.positions.size() * sizeof(glm::vec3));
  std::memcpy(corners, model.triangles.data(), model.triangles.size() * sizeof(glm::uvec3));
  return {};
}

}  // namespace

struct ModelScene::Impl {
  const mesh::Model* model = nullptr;
  bool alpha = false;
  DevicePtr device;  ///< before the scene, which goes first
  ScenePtr scene;    ///< null when nothing can be hit
};

ModelScene::ModelScene(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
ModelScene::ModelScene(ModelScene&&) noexcept = default;
ModelScene& ModelScene::operator=(ModelScene&&) noexcept = default;
ModelScene::~ModelScene() = default;

const mesh::Model& ModelScene::model() const {
  return *m_impl->model;
}

Result<ModelScene> ModelScene::create(const mesh::Model& model) {
  const auto isFinite = [](const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  if (!std::all_of(model.positions.begin(), model.positions.end(), isFinite)) {
    return Error::badInput("a vertex is not finite", "plant " + model.name, "Export the mesh again.");
  }
  auto impl = std::make_unique<Impl>();
  impl->model = &model;
  impl->alpha = mesh::hasAlpha(model);
  if (model.empty()) return ModelScene(std::move(impl));
  impl->device.reset(rtcNewDevice(nullptr));
  if (!impl->device) return Error::failed("Embree cannot start", "ray tracing", "Free some memory.");
  impl->scene.reset(rtcNewScene(impl->device.get()));
  const RTCGeometry geometry = rtcNewGeometry(impl->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const Result<void> filled = fill(geometry, model);
  if (filled.ok()) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl->scene.get(), geometry);
  }
  rtcReleaseGeometry(geometry);
  if (!filled.ok()) return filled.error();
  rtcCommitScene(impl->scene.get());
  return ModelScene(std::move(impl));
}

ModelScene::Found ModelScene::nearest(const glm::vec3& origin, const glm::vec3& direction, float start,
                                      float chance) const {
  Found found;
  if (!m_impl->scene) return found;
  float near = start;
  for (int leaf = 0; leaf < kMostLeaves; ++leaf) {
    RTCRayHit ray{};
    ray.ray = {origin.x, origin.y, origin.z, near, direction.x, direction.y, direction.z, 0.0f, kInfinity, ~0u, 0, 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context = packetContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    rtcIntersect1(m_impl->scene.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return found;
    found.surface = mesh::surfaceAt(*m_impl->model, ray.hit.primID, ray.hit.u, ray.hit.v);
    if (found.surface.alpha > chance) {
      found.any = true;
      found.t = ray.ray.tfar;
      found.u = ray.hit.u;
      found.v = ray.hit.v;
      found.triangle = ray.hit.primID;
      return found;
    }
    near = std::nextafter(ray.ray.tfar * (1.0f + 1e-6f), kInfinity);
  }
  return found;
}

bool ModelScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float start, float chance) const {
  if (!m_impl->scene) return false;
  if (m_impl->alpha) return nearest(origin, direction, start, chance).any;
  RTCRay ray = {origin.x, origin.y, origin.z, start, direction.x, direction.y, direction.z, 0.0f, kInfinity, ~0u, 0, 0};
  RTCIntersectContext context = packetContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  rtcOccluded1(m_impl->scene.get(), &context, &ray);
  return ray.tfar < 0.0f;  // Embree marks an occluded ray by -infinity
}

}  // namespace sward::trace
