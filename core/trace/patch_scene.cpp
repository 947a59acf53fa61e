#include "trace/patch_scene.h"

#include "base/check.h"
#include "trace/patch_scene_impl.h"
#include "trace/scene_builder.h"

#include <cmath>

namespace sward::trace {
namespace {

/// Shadow rays start this fraction of the patch's larger extent above their surface: some 200 roundings of a float
/// coordinate, 30 micrometres on a metre.
constexpr double kOffset = 3e-5;

}  // namespace

PatchScene::PatchScene() : m_impl(std::make_unique<Impl>()) {}
PatchScene::~PatchScene() = default;

const scene::Patch& PatchScene::patch() const {
  return *m_impl->patch;
}
RayCounts PatchScene::rayCounts() const {
  return {m_impl->nearestCount.load(), m_impl->occlusionCount.load()};
}

Result<std::unique_ptr<PatchScene>> PatchScene::create(std::shared_ptr<const scene::Patch> patch,
                                                       const JobContext& job) {
  SWARD_CHECK(patch != nullptr);
  if (!std::isfinite(patch->sideM) || patch->sideM <= 0.0 || !std::isfinite(patch->heightM) || patch->heightM < 0.0) {
    return Error::badInput("the patch has no size", "patch", "Its side must be a positive number of metres.");
  }
  std::unique_ptr<PatchScene> scene(new PatchScene());
  Impl& impl = *scene->m_impl;
  impl.patch = std::move(patch);
  impl.side = static_cast<float>(impl.patch->sideM);
  impl.height = std::nextafter(static_cast<float>(impl.patch->heightM) * (1.0f + 2e-7f), INFINITY);
  impl.offset = static_cast<float>(kOffset * std::max(impl.patch->sideM, impl.patch->heightM));
  impl.device.reset(rtcNewDevice(nullptr));
  if (!impl.device) {
    return Error::failed("Embree cannot start", "ray tracing", "It needs a processor with SSE2 and some free memory.");
  }
  SWARD_TRY(buildScene(impl, job));
  return scene;
}

void PatchScene::Impl::intersect(const int* valid, RTCRayHit16& packet) const {
  if (record != nullptr) {
    const std::scoped_lock lock(record->mutex);
    record->nearest.push_back(packet);
  }
  RTCIntersectContext context = packetContext(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  rtcIntersect16(valid, top.get(), &context, &packet);
}

void PatchScene::Impl::occluded(const int* valid, RTCRay16& packet) const {
  if (record != nullptr) {
    const std::scoped_lock lock(record->mutex);
    record->occlusion.push_back(packet);
  }
  RTCIntersectContext context = packetContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  rtcOccluded16(valid, top.get(), &context, &packet);
}

}  // namespace sward::trace
