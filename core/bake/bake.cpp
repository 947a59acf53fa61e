#include "bake/bake.h"

#include "bake/session.h"
#include "scene/lights.h"

namespace sward::bake {

struct Baker::Impl {
  Impl(std::optional<DiskCache> cache, const Options& options)
      : disk(std::move(cache)), memory(options.memoryLimitBytes) {}
  std::optional<DiskCache> disk;
  std::optional<DiskCache> noDisk;
  MemoryCache memory;
};

Baker::Baker(std::optional<DiskCache> cache) : Baker(std::move(cache), Options{}) {}
Baker::Baker(std::optional<DiskCache> cache, const Options& options)
    : m_impl(std::make_unique<Impl>(std::move(cache), options)) {}
Baker::~Baker() = default;
Baker::Baker(Baker&&) noexcept = default;
Baker& Baker::operator=(Baker&&) noexcept = default;

Result<std::shared_ptr<const GroundBake>> Baker::ground(const project::Project& project, const JobContext& job,
                                                        BakeReport* report) {
  return ground(GroundRequest{project, Quality::Full}, job, report);
}

Result<std::shared_ptr<const GroundBake>> Baker::ground(const GroundRequest& request, const JobContext& job,
                                                        BakeReport* report) {
  SWARD_TRY(project::requireValid(request.project));
  const project::Project project = atQuality(request.project, request.quality);
  SWARD_ASSIGN(std::vector<glm::dvec3> lights, scene::lightDirections(project.lights));
  SWARD_ASSIGN(GroundKeys keys, groundKeys(project, lights));
  std::optional<DiskCache>& disk = request.quality == Quality::Full ? m_impl->disk : m_impl->noDisk;
  Session session(project, std::move(lights), std::move(keys), job, m_impl->memory, disk);
  auto ground = session.ground();
  if (report != nullptr) *report = session.takeReport();
  return ground;
}

Result<base::Hash128> Baker::key(const GroundRequest& request) {
  SWARD_TRY(project::requireValid(request.project));
  const project::Project project = atQuality(request.project, request.quality);
  SWARD_ASSIGN(const std::vector<glm::dvec3> lights, scene::lightDirections(project.lights));
  SWARD_ASSIGN(const GroundKeys keys, groundKeys(project, lights));
  return keys.ground;
}

bool Baker::holds(const base::Hash128& groundKey) const {
  return m_impl->memory.contains(groundKey) || (m_impl->disk && m_impl->disk->contains("ground", groundKey));
}

Result<std::shared_ptr<const Inspection>> Baker::inspection(const project::Project& project, const JobContext& job,
                                                            BakeReport* report) {
  SWARD_TRY(project::requireValid(project));
  SWARD_ASSIGN(std::vector<glm::dvec3> lights, scene::lightDirections(project.lights));
  SWARD_ASSIGN(GroundKeys keys, groundKeys(project, lights));
  Session session(project, std::move(lights), std::move(keys), job, m_impl->memory, m_impl->disk);
  auto inspection = session.inspection();
  if (report != nullptr) *report = session.takeReport();
  return inspection;
}

}  // namespace sward::bake
