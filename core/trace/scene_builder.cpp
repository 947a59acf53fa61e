#include "trace/scene_builder.h"

#include "base/check.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace sward::trace {
namespace {

struct GeometryRelease {
  void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using GeometryPtr = std::unique_ptr<RTCGeometryTy, GeometryRelease>;

/// A copy of an instance, moved by whole patches.
struct Placement {
  std::uint32_t instance = 0;
  glm::mat4x3 worldFromModel{1.0f};
};

/// Axis-aligned box of a model's box under a transform.
mesh::Bounds transformedBounds(const mesh::Bounds& box, const glm::mat4x3& m) {
  mesh::Bounds out{glm::vec3(m[3]), glm::vec3(m[3])};
  for (int column = 0; column < 3; ++column) {
    const glm::vec3 a = m[column] * box.low[column];
    const glm::vec3 b = m[column] * box.high[column];
    out.low += glm::min(a, b);
    out.high += glm::max(a, b);
  }
  return out;
}

/// Whole patches by which an extent [low, high] may be moved so that it overlaps [0, side].
struct Shifts {
  int first = 0, last = -1;
};
Shifts overlappingShifts(double low, double high, double side) {
  const double slack = 1e-5 * side;
  return {static_cast<int>(std::ceil((-high - slack) / side)),
          static_cast<int>(std::floor((side + slack - low) / side))};
}

bool isFinite(const glm::vec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Boxes of the models, zero for empty ones.
Result<std::vector<mesh::Bounds>> modelBoxes(const scene::Patch& patch) {
  std::vector<mesh::Bounds> boxes;
  for (const auto& model : patch.models) {
    boxes.push_back(model ? mesh::bounds(*model) : mesh::Bounds{});
    if (!model || std::all_of(model->positions.begin(), model->positions.end(), isFinite)) continue;
    return Error::badInput("a vertex is not finite", "plant " + model->name, "Export the mesh again.");
  }
  return boxes;
}

/// The box of an instance in the world, or what is wrong with it.
Result<mesh::Bounds> instanceBox(const scene::Patch& patch, const scene::Instance& instance,
                                 const mesh::Bounds& model) {
  const mesh::Bounds box = transformedBounds(model, instance.worldFromModel);
  const std::string where = "plant " + patch.models[instance.model]->name;
  if (!isFinite(box.low) || !isFinite(box.high)) {
    return Error::badInput("an instance's transform is not finite", where, "Check its size and tilt.");
  }
  const double reach = static_cast<double>(std::max({-box.low.x, -box.low.y, box.high.x, box.high.y}));
  if (reach > kMaxReach * patch.sideM) {
    return Error::badInput("the plant is more than " + std::to_string(kMaxReach) + " times as wide as the patch", where,
                           "Make the patch larger or the plant smaller.");
  }
  return box;
}

bool standsThere(const scene::Patch& patch, const scene::Instance& instance) {
  SWARD_CHECK_LT(instance.model, patch.models.size());
  return patch.models[instance.model] && !patch.models[instance.model]->empty();
}

Result<std::vector<Placement>> placeCopies(const scene::Patch& patch) {
  SWARD_ASSIGN(const std::vector<mesh::Bounds> boxes, modelBoxes(patch));
  std::vector<Placement> placements;
  for (std::size_t i = 0; i < patch.instances.size(); ++i) {
    const scene::Instance& instance = patch.instances[i];
    if (!standsThere(patch, instance)) continue;
    SWARD_ASSIGN(const mesh::Bounds box, instanceBox(patch, instance, boxes[instance.model]));
    const Shifts sx = overlappingShifts(box.low.x, box.high.x, patch.sideM);
    const Shifts sy = overlappingShifts(box.low.y, box.high.y, patch.sideM);
    for (int y = sy.first; y <= sy.last; ++y) {
      for (int x = sx.first; x <= sx.last; ++x) {
        Placement placement{static_cast<std::uint32_t>(i), instance.worldFromModel};
        placement.worldFromModel[3].x = static_cast<float>(placement.worldFromModel[3].x + x * patch.sideM);
        placement.worldFromModel[3].y = static_cast<float>(placement.worldFromModel[3].y + y * patch.sideM);
        placements.push_back(placement);
      }
    }
  }
  return placements;
}

/// A triangle geometry of these vertices, with the alpha filter when the model needs it.
GeometryPtr makeTriangles(PatchScene::Impl& impl, const std::vector<glm::vec3>& positions,
                          const std::vector<glm::uvec3>& triangles, const AlphaGeometry* alpha) {
  GeometryPtr geometry(rtcNewGeometry(impl.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  void* vertices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(glm::vec3), positions.size());
  void* indices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(glm::uvec3), triangles.size());
  if (vertices == nullptr || indices == nullptr) return nullptr;
  std::memcpy(vertices, positions.data(), positions.size() * sizeof(glm::vec3));
  std::memcpy(indices, triangles.data(), triangles.size() * sizeof(glm::uvec3));
  if (alpha != nullptr) {
    rtcSetGeometryUserData(geometry.get(), const_cast<AlphaGeometry*>(alpha));
    rtcSetGeometryIntersectFilterFunction(geometry.get(), filterByAlpha);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filterByAlpha);
  }
  rtcCommitGeometry(geometry.get());
  return geometry;
}

/// The triangles of a transformed model that overlap the square.
struct ClippedMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> source;  ///< model triangle of each triangle; empty: all of them, in order
};

ClippedMesh clipToSquare(const mesh::Model& model, const glm::mat4x3& worldFromModel, float side) {
  ClippedMesh out;
  std::vector<glm::vec3> world(model.positions.size());
  for (std::size_t i = 0; i < world.size(); ++i) world[i] = worldFromModel * glm::vec4(model.positions[i], 1.0f);
  const float low = -1e-5f * side, high = side * (1.0f + 1e-5f);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const glm::uvec3 c = model.triangles[t];
    const glm::vec3 least = glm::min(world[c.x], glm::min(world[c.y], world[c.z]));
    const glm::vec3 most = glm::max(world[c.x], glm::max(world[c.y], world[c.z]));
    if (most.x < low || most.y < low || least.x > high || least.y > high) continue;
    out.source.push_back(static_cast<std::uint32_t>(t));
  }
  if (out.source.size() == model.triangles.size()) {
    out.source.clear();
    out.positions = std::move(world);
    out.triangles = model.triangles;
    return out;
  }
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> renamed(world.size(), kUnused);
  for (const std::uint32_t t : out.source) {
    glm::uvec3 corner = model.triangles[t];
    for (int k = 0; k < 3; ++k) {
      std::uint32_t& name = renamed[corner[k]];
      if (name == kUnused) {
        name = static_cast<std::uint32_t>(out.positions.size());
        out.positions.push_back(world[corner[k]]);
      }
      corner[k] = name;
    }
    out.triangles.push_back(corner);
  }
  return out;
}

Result<void> outOfMemory() {
  return Error::failed("there is not enough memory for the patch's ray tracing scene", "ray tracing",
                       "Use fewer plants, or plants of fewer triangles.");
}

/// Every copy's triangles in one tree.
bool buildFlat(PatchScene::Impl& impl, const std::vector<Placement>& placements) {
  std::vector<char> alphaOf;
  for (const auto& model : impl.patch->models) alphaOf.push_back(model && mesh::hasAlpha(*model) ? 1 : 0);
  for (const Placement& placement : placements) {
    const std::uint32_t modelIndex = impl.patch->instances[placement.instance].model;
    const mesh::Model& model = *impl.patch->models[modelIndex];
    ClippedMesh mesh = clipToSquare(model, placement.worldFromModel, impl.side);
    if (mesh.triangles.empty()) continue;
    const AlphaGeometry* alpha = nullptr;
    if (alphaOf[modelIndex] != 0) {
      alpha = &impl.alpha.emplace_back(AlphaGeometry{&impl, &model, static_cast<std::uint32_t>(impl.copies.size())});
    }
    const GeometryPtr geometry = makeTriangles(impl, mesh.positions, mesh.triangles, alpha);
    if (!geometry) return false;
    rtcAttachGeometryByID(impl.top.get(), geometry.get(), static_cast<unsigned>(impl.copies.size()));
    impl.copies.push_back({placement.instance, std::move(mesh.source)});
  }
  return true;
}

/// One tree a model, instances of it on top.
bool buildInstanced(PatchScene::Impl& impl, const std::vector<Placement>& placements) {
  impl.modelScenes.resize(impl.patch->models.size());
  for (const Placement& placement : placements) {
    const std::uint32_t modelIndex = impl.patch->instances[placement.instance].model;
    const mesh::Model& model = *impl.patch->models[modelIndex];
    ScenePtr& scene = impl.modelScenes[modelIndex];
    if (!scene) {
      const AlphaGeometry* alpha = nullptr;
      if (mesh::hasAlpha(model)) alpha = &impl.alpha.emplace_back(AlphaGeometry{&impl, &model});
      const GeometryPtr geometry = makeTriangles(impl, model.positions, model.triangles, alpha);
      if (!geometry) return false;
      scene.reset(rtcNewScene(impl.device.get()));
      rtcAttachGeometry(scene.get(), geometry.get());
      rtcCommitScene(scene.get());
    }
    const GeometryPtr geometry(rtcNewGeometry(impl.device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), scene.get());
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &placement.worldFromModel[0].x);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(impl.top.get(), geometry.get(), static_cast<unsigned>(impl.copies.size()));
    impl.copies.push_back({placement.instance, {}});
  }
  return true;
}

}  // namespace

Result<void> requireTraceable(const scene::Patch& patch) {
  SWARD_ASSIGN(const std::vector<mesh::Bounds> boxes, modelBoxes(patch));
  for (const scene::Instance& instance : patch.instances) {
    if (!standsThere(patch, instance)) continue;
    SWARD_TRY(instanceBox(patch, instance, boxes[instance.model]));
  }
  return {};
}

Result<void> buildScene(PatchScene::Impl& impl, const JobContext& job) {
  SWARD_ASSIGN(const std::vector<Placement> placements, placeCopies(*impl.patch));
  if (placements.empty()) return {};
  std::uint64_t triangles = 0;
  for (const scene::Instance& instance : impl.patch->instances) {
    if (impl.patch->models[instance.model]) triangles += impl.patch->models[instance.model]->triangles.size();
  }
  impl.top.reset(rtcNewScene(impl.device.get()));
  const bool flat = triangles <= kMaxFlatTriangles;
  if (!(flat ? buildFlat(impl, placements) : buildInstanced(impl, placements))) return outOfMemory();
  if (impl.copies.empty()) {
    impl.top.reset();
    return {};
  }
  if (job.cancelled()) return Error::cancelled();
  rtcSetSceneProgressMonitorFunction(
      impl.top.get(), [](void* asked, double) { return !static_cast<const JobContext*>(asked)->cancelled(); },
      const_cast<JobContext*>(&job));
  rtcCommitScene(impl.top.get());
  rtcSetSceneProgressMonitorFunction(impl.top.get(), nullptr, nullptr);
  if (job.cancelled()) return Error::cancelled();
  const RTCError error = rtcGetDeviceError(impl.device.get());
  if (error == RTC_ERROR_OUT_OF_MEMORY) return outOfMemory();
  if (error != RTC_ERROR_NONE) {
    return Error::failed("Embree refused the patch (error " + std::to_string(static_cast<int>(error)) + ")",
                         "ray tracing", "Check the plants' meshes.");
  }
  return {};
}

void filterByAlpha(const RTCFilterFunctionNArguments* arguments) {
  const auto* geometry = static_cast<const AlphaGeometry*>(arguments->geometryUserPtr);
  const unsigned count = arguments->N;
  for (unsigned lane = 0; lane < count; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const unsigned primitive = RTCHitN_primID(arguments->hit, count, lane);
    const bool instanced = geometry->copy == AlphaGeometry::kInstanced;
    const unsigned copy = instanced ? RTCHitN_instID(arguments->hit, count, lane, 0) : geometry->copy;
    const SurfaceId surface = geometry->scene->surfaceOf(copy, primitive, RTC_INVALID_GEOMETRY_ID);
    const float alpha = mesh::alphaAt(*geometry->model, surface.triangle, RTCHitN_u(arguments->hit, count, lane),
                                      RTCHitN_v(arguments->hit, count, lane));
    const std::uint64_t chance =
        base::mix64(RTCRayN_id(arguments->ray, count, lane), surface.instance, surface.triangle);
    if (!(base::unitFloat(chance) < alpha)) arguments->valid[lane] = 0;
  }
}

}  // namespace sward::trace
