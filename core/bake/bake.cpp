#include "bake/bake.h"

#include "bake/session.h"
#include "scene/lights.h"

#include <algorithm>

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

  Options options;
  std::optional<DiskCache> disk, noDisk;
  MemoryCache memory;
  AssetHashes assets;
};

Result<Baker::Impl::Plan> Baker::Impl::plan(const GroundRequest& request) {
  SWARD_TRY(project::requireValid(request.project));
  Plan plan;
  plan.project = atQuality(request.project, request.quality);
  SWARD_ASSIGN(plan.lights, scene::lightDirections(plan.project.lights));
  plan.settings = {request.quality == Quality::Coarse ? Sampler::Passes : Sampler::Rays, request.layout};
  SWARD_ASSIGN(plan.keys, groundKeys(plan.project, plan.lights, plan.settings, assets));
  return plan;
}

std::vector<glm::ivec2> layoutOf(const GroundBake& ground) {
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
  SWARD_ASSIGN(const Impl::Plan plan, m_impl->plan(request));
  // What is only looked at for a moment is not worth a place on the disk; nor is what hangs on an earlier picture.
  const bool keep = request.quality == Quality::Full && request.layout.empty();
  Session session({plan.project, plan.lights, plan.settings, plan.keys, m_impl->memory,
                   keep ? m_impl->disk : m_impl->noDisk, m_impl->options.holdTraced},
                  job);
  auto ground = session.ground();
  if (report != nullptr) *report = session.takeReport();
  return ground;
}

Result<base::Hash128> Baker::key(const GroundRequest& request) {
  SWARD_ASSIGN(const Impl::Plan plan, m_impl->plan(request));
  return plan.keys.ground;
}

Result<bool> Baker::tracesNothing(const GroundRequest& request) {
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
  SWARD_ASSIGN(const Impl::Plan plan, m_impl->plan(request));
  const bool keep = request.quality == Quality::Full && request.layout.empty();
  Session session({plan.project, plan.lights, plan.settings, plan.keys, m_impl->memory,
                   keep ? m_impl->disk : m_impl->noDisk, m_impl->options.holdTraced},
                  job);
  auto inspection = session.inspection();
  if (report != nullptr) *report = session.takeReport();
  return inspection;
}

}  // namespace sward::bake
