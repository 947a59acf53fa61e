#include "bake/bake.h"

#include "bake/memory_size.h"
#include "bake/session.h"
#include "bake/texel_baker.h"
#include "bake/withering.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"
#include "trace/canopy_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::bake {

struct Baker::Impl {
  Impl(std::optional<DiskCache> cache, const Options& given)
      : options(given), disk(std::move(cache)), memory(given.memoryLimitBytes) {}

  /// All that one walk of the graph needs; errors as Baker::key.
  struct Plan {
    project::Project project;
    std::vector<glm::dvec3> lights;
    GroundSettings settings;
    GroundKeys keys;
  };
  Result<Plan> plan(const GroundRequest& request);
  /// Walks the graph of a request: walk(session) gives what is wanted.
  template <typename Walk>
  auto run(const GroundRequest& request, const JobContext& job, BakeReport* report, const Walk& walk)
      -> decltype(walk(std::declval<Session&>()));

  /// The same for projects that are drawn as texels: no layers, none of the graph's nodes.
  Result<std::shared_ptr<const GroundBake>> texelGround(const GroundRequest& request, const JobContext& job,
                                                        BakeReport* report);
  Result<base::Hash128> texelKey(const GroundRequest& request);

  Options options;
  TexelBaker texels;
  std::optional<DiskCache> disk, noDisk;
  MemoryCache memory;
  AssetHashes assets;
};

namespace {

constexpr int kTexelMap = 128;  ///< cells of a map of texels along each side

/// A sun below the horizon lights nothing, whatever is baked for it; passes follow no shadow beyond their lowest light.
glm::dvec3 aboveHorizon(const glm::dvec3& sun, Sampler sampler) {
  const double lowest = sampler == Sampler::Passes ? trace::CanopyLight::kLowestZ : 0.0;
  if (sun.z >= lowest) return sun;
  const double level = std::hypot(sun.x, sun.y);
  if (!(level > 0.0)) return {std::sqrt(1.0 - lowest * lowest), 0.0, lowest};
  const double wide = std::sqrt(1.0 - lowest * lowest) / level;
  return {sun.x * wide, sun.y * wide, lowest};
}

}  // namespace

Result<Baker::Impl::Plan> Baker::Impl::plan(const GroundRequest& request) {
  SWARD_TRY(project::requireValid(request.project));
  Plan plan;
  plan.project = atQuality(request.project, request.quality);
  SWARD_ASSIGN(plan.lights, scene::lightDirections(plan.project.lights));
  plan.settings = {request.quality == Quality::Coarse ? Sampler::Passes : Sampler::Rays, request.layout, {}};
  if (lpt::needsSun(plan.project.fit.basis)) {
    SWARD_ASSIGN(const glm::dvec3 sun, scene::sunDirection(plan.project.sun));
    plan.settings.sun = aboveHorizon(sun, plan.settings.sampler);
  }
  SWARD_ASSIGN(plan.keys, groundKeys(plan.project, plan.lights, plan.settings, assets));
  return plan;
}

template <typename Walk>
auto Baker::Impl::run(const GroundRequest& request, const JobContext& job, BakeReport* report, const Walk& walk)
    -> decltype(walk(std::declval<Session&>())) {
  SWARD_ASSIGN(const Plan planned, plan(request));
  // What is only looked at for a moment is not worth a place on the disk; nor is what hangs on an earlier picture.
  const bool keep = request.quality == Quality::Full && request.layout.empty();
  Session session({planned.project, planned.lights, planned.settings, planned.keys, memory, keep ? disk : noDisk,
                   options.holdTraced},
                  job);
  auto result = walk(session);
  if (report != nullptr) *report = session.takeReport();
  return result;
}

Result<base::Hash128> Baker::Impl::texelKey(const GroundRequest& request) {
  SWARD_TRY(project::requireValid(request.project));
  return texels.key(atQuality(request.project, request.quality));
}

Result<std::shared_ptr<const GroundBake>> Baker::Impl::texelGround(const GroundRequest& request, const JobContext& job,
                                                                   BakeReport* report) {
  SWARD_ASSIGN(const base::Hash128 key, texelKey(request));
  NodeReport node{"texels", "", NodeReport::State::FromMemory};
  auto ground = memory.get<GroundBake>(key);
  if (!ground) {
    TexelReport made;
    auto fresh = std::make_shared<GroundBake>();
    SWARD_ASSIGN(fresh->texels, texels.texels(atQuality(request.project, request.quality), job, &made));
    fresh->patchSideM = fresh->texels->grid().sideM;
    fresh->heightM = fresh->texels->grid().heightM;
    // One tile, the patch itself, and a map of it that only varies in brightness.
    fresh->tiles.resolution = fresh->tiles.patchResolution = 1;
    fresh->map.width = fresh->map.height = kTexelMap;
    fresh->map.tiles.assign(std::size_t{kTexelMap} * kTexelMap, 0);
    node.state = NodeReport::State::Baked;
    node.seconds = made.restSeconds + made.ageSeconds + made.levelSeconds;
    memory.put(key, fresh, memoryBytes(*fresh));
    ground = std::move(fresh);
  }
  node.bytes = memoryBytes(*ground);
  if (report != nullptr) {
    *report = {};
    report->seconds = node.seconds;
    report->nodes.push_back(std::move(node));
  }
  return ground;
}

std::vector<glm::ivec2> layoutOf(const GroundBake& ground) {
  if (ground.texels) return {};
  const int pitch = ground.tiles.patchResolution / ground.bladesPerPatch;
  std::vector<glm::ivec2> layout = ground.tiles.diamonds;
  for (glm::ivec2& diamond : layout) diamond /= pitch;
  return layout;
}

Baker::Baker(std::optional<DiskCache> cache) : Baker(std::move(cache), Options{}) {}
Baker::Baker(std::optional<DiskCache> cache, const Options& options)
    : m_impl(std::make_unique<Impl>(std::move(cache), options)) {}
Baker::~Baker() = default;
Baker::Baker(Baker&&) noexcept = default;
Baker& Baker::operator=(Baker&&) noexcept = default;

Result<std::shared_ptr<const GroundBake>> Baker::ground(const project::Project& project, const JobContext& job,
                                                        BakeReport* report) {
  return ground(GroundRequest{project, Quality::Full, {}}, job, report);
}

Result<std::shared_ptr<const GroundBake>> Baker::ground(const GroundRequest& request, const JobContext& job,
                                                        BakeReport* report) {
  if (drawnAsTexels(request.project)) return m_impl->texelGround(request, job, report);
  return m_impl->run(request, job, report, [](Session& session) { return session.ground(); });
}

Result<std::vector<tiles::SeamColumn>> Baker::seamColumns(const GroundRequest& request, const JobContext& job) {
  return m_impl->run(request, job, nullptr, [](Session& session) { return session.seamColumns(); });
}

Result<base::Hash128> Baker::key(const GroundRequest& request) {
  if (drawnAsTexels(request.project)) return m_impl->texelKey(request);
  SWARD_ASSIGN(const Impl::Plan plan, m_impl->plan(request));
  return plan.keys.ground;
}

Result<bool> Baker::tracesNothing(const GroundRequest& request) {
  if (drawnAsTexels(request.project)) return false;
  SWARD_ASSIGN(const Impl::Plan plan, m_impl->plan(request));
  const MemoryCache& memory = m_impl->memory;
  return memory.contains(plan.keys.seamFit) &&
         std::all_of(plan.keys.sets.begin(), plan.keys.sets.end(), [&](const SetKeys& keys) {
           return memory.contains(keys.hits) && memory.contains(keys.visibility) && memory.contains(keys.fit);
         });
}

bool Baker::holds(const base::Hash128& groundKey) const {
  return m_impl->memory.contains(groundKey) || (m_impl->disk && m_impl->disk->contains("ground", groundKey));
}

Result<std::shared_ptr<const Inspection>> Baker::inspection(const project::Project& project, const JobContext& job,
                                                            BakeReport* report) {
  return inspection(GroundRequest{project, Quality::Full}, job, report);
}

Result<std::shared_ptr<const Inspection>> Baker::inspection(const GroundRequest& request, const JobContext& job,
                                                            BakeReport* report) {
  if (drawnAsTexels(request.project)) {
    return Error::badInput("texels have no layers to inspect", "render.method", "Choose another method of drawing.");
  }
  return m_impl->run(request, job, report, [](Session& session) { return session.inspection(); });
}

}  // namespace sward::bake
