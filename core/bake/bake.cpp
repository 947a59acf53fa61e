#include "bake/bake.h"

#include "bake/memory_size.h"
#include "bake/payload.h"
#include "bake/session.h"
#include "bake/texel_baker.h"
#include "bake/texel_payload.h"
#include "bake/withering.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"
#include "trace/canopy_light.h"

#include <algorithm>
#include <chrono>
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
  Result<std::shared_ptr<const TexelBake>> texelsOf(const GroundRequest& request, const base::Hash128& key,
                                                    const JobContext& job, BakeReport& report);
  Result<std::shared_ptr<const TexelBake>> madeTexels(const GroundRequest& request, const base::Hash128& key,
                                                      const JobContext& job, DiskCache* cache, BakeReport& report);
  Result<base::Hash128> texelKey(const GroundRequest& request);

  Options options;
  TexelBaker texels;
  std::optional<DiskCache> disk, noDisk;
  MemoryCache memory;
  AssetHashes assets;
};

namespace {

constexpr const char* kTexelKind = "texels";
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

Result<std::shared_ptr<const TexelBake>> Baker::Impl::madeTexels(const GroundRequest& request, const base::Hash128& key,
                                                                 const JobContext& job, DiskCache* cache,
                                                                 BakeReport& report) {
  NodeReport &rest = report.nodes[0], &node = report.nodes[1];
  TexelReport made;
  SWARD_ASSIGN(auto bake, texels.texels(atQuality(request.project, request.quality), job, &made, cache));
  using From = TexelReport::Rest;
  rest.state = made.rest == From::Made   ? NodeReport::State::Baked
               : made.rest == From::Held ? NodeReport::State::FromMemory
                                         : NodeReport::State::FromDisk;
  rest.seconds = made.restSeconds;
  rest.bytes = made.restBytes;
  report.warnings = std::move(made.warnings);
  node.state = NodeReport::State::Baked;
  node.seconds = made.ageSeconds + made.levelSeconds;
  node.bytes = made.bytes;
  if (request.quality != Quality::Full) return bake;
  // What the disk would give back, whether there is one or not: texels are packed there, and a picture must not depend
  // on where they came from.
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::byte> payload = payloadOf(*bake);
  auto stored = fromPayload<TexelBake>(payload);
  if (job.cancelled()) return Error::cancelled();
  if (!stored) {  // values that packing has no codes for, which no valid project should give
    report.warnings.emplace_back("the texels cannot be packed, and are made anew for every picture");
    return bake;
  }
  node.bytes = payload.size();
  if (cache != nullptr && options.storeTexels) {
    if (const auto kept = cache->put(kTexelKind, key, payload); !kept.ok()) {
      report.warnings.push_back(kept.error().text());
    }
  }
  node.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return std::make_shared<const TexelBake>(std::move(*stored));
}

Result<std::shared_ptr<const TexelBake>> Baker::Impl::texelsOf(const GroundRequest& request, const base::Hash128& key,
                                                               const JobContext& job, BakeReport& report) {
  // What is only looked at for a moment is not worth a place on the disk.
  DiskCache* cache = request.quality == Quality::Full && disk ? &*disk : nullptr;
  if (cache != nullptr) {
    const auto start = std::chrono::steady_clock::now();
    const auto payload = cache->get(kTexelKind, key);
    auto known = payload ? fromPayload<TexelBake>(*payload) : std::nullopt;
    if (known && known->grid().columns == request.project.wither.texel.resolution) {
      NodeReport& node = report.nodes[1];
      node.state = NodeReport::State::FromDisk;
      node.bytes = payload->size();
      node.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      return std::make_shared<const TexelBake>(std::move(*known));
    }
  }
  return madeTexels(request, key, job, cache, report);
}

Result<std::shared_ptr<const GroundBake>> Baker::Impl::texelGround(const GroundRequest& request, const JobContext& job,
                                                                   BakeReport* report) {
  SWARD_ASSIGN(const base::Hash128 key, texelKey(request));
  BakeReport done;
  done.nodes = {{"rest", "", NodeReport::State::Skipped}, {"texels", "", NodeReport::State::FromMemory}};
  auto ground = memory.get<GroundBake>(key);
  if (ground) done.nodes[1].bytes = memoryBytes(*ground);
  if (!ground) {
    auto fresh = std::make_shared<GroundBake>();
    SWARD_ASSIGN(fresh->texels, texelsOf(request, key, job, done));
    fresh->patchSideM = fresh->texels->grid().sideM;
    fresh->heightM = fresh->texels->grid().heightM;
    // One tile, the patch itself, and a map of it that only varies in brightness.
    fresh->tiles.resolution = fresh->tiles.patchResolution = 1;
    fresh->map.width = fresh->map.height = kTexelMap;
    fresh->map.tiles.assign(std::size_t{kTexelMap} * kTexelMap, 0);
    memory.put(key, fresh, memoryBytes(*fresh));
    ground = std::move(fresh);
  }
  for (const NodeReport& node : done.nodes) done.seconds += node.seconds;
  if (report != nullptr) *report = std::move(done);
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
  return m_impl->memory.contains(groundKey) || (m_impl->disk && (m_impl->disk->contains("ground", groundKey) ||
                                                                 m_impl->disk->contains(kTexelKind, groundKey)));
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
