#include "bake/bake.h"

#include "bake/session.h"
#include "scene/lights.h"

namespace sward::bake {
namespace {

/// Enough for the results of two or three projects of ordinary size; a cold bake as a whole stays under 1 GiB.
constexpr std::uint64_t kMemoryCacheBytes = std::uint64_t{192} << 20;

}  // namespace

struct Baker::Impl {
  std::optional<DiskCache> disk;
  MemoryCache memory{kMemoryCacheBytes};
};

Baker::Baker(std::optional<DiskCache> cache) : m_impl(std::make_unique<Impl>()) {
  m_impl->disk = std::move(cache);
}
Baker::~Baker() = default;
Baker::Baker(Baker&&) noexcept = default;
Baker& Baker::operator=(Baker&&) noexcept = default;

Result<std::shared_ptr<const GroundBake>> Baker::ground(const project::Project& project, const JobContext& job,
                                                        BakeReport* report) {
  SWARD_TRY(project::requireValid(project));
  SWARD_ASSIGN(std::vector<glm::dvec3> lights, scene::lightDirections(project.lights));
  SWARD_ASSIGN(GroundKeys keys, groundKeys(project, lights));
  Session session(project, std::move(lights), std::move(keys), job, m_impl->memory, m_impl->disk);
  auto ground = session.ground();
  if (report != nullptr) *report = session.takeReport();
  return ground;
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
