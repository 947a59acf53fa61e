#include "bake/session_node.h"

#include "bake/plants.h"
#include "bake/payload.h"
#include "bake/soil.h"
#include "base/check.h"

#include <algorithm>
#include <utility>

namespace sward::bake {
namespace {

using trace::LayerSet;

/// What the disk would give back. Light is stored in 16 bits; a fit must not depend on where its samples came from.
template <typename T>
T asStored(const T& value) {
  auto stored = fromPayload<T>(payloadOf(value));
  SWARD_CHECK(stored.has_value());
  return std::move(*stored);
}

std::string lightName(LayerSet set, std::size_t light) {
  return std::string(trace::layerSetName(set)) + ", light " + std::to_string(light + 1);
}
std::string sunName(LayerSet set) {
  return std::string(trace::layerSetName(set)) + ", sun";
}

}  // namespace

Session::Session(const Input& input, const JobContext& job)
    : m_project(input.project),
      m_lights(input.lights),
      m_settings(input.settings),
      m_keys(input.keys),
      m_job(job),
      m_memory(input.memory),
      m_disk(input.disk),
      m_holdTraced(input.holdTraced) {
  plan();
}

void Session::planNode(const std::string& kind, const std::string& what, double weight) {
  NodeReport node;
  node.kind = kind;
  node.what = what;
  node.state = NodeReport::State::Skipped;
  m_report.nodes.push_back(std::move(node));
  m_progressEnd.push_back((m_progressEnd.empty() ? 0.0 : m_progressEnd.back()) + weight);
}

void Session::plan() {
  planNode("patch", "", 0.1);
  const auto planSet = [&](LayerSet set) {
    const trace::LayerShape shape = trace::layerShape(set, m_project.sampling);
    const bool flat = set == LayerSet::Slices || set == LayerSet::Ground;
    const int subSamples = flat ? m_project.sampling.sliceSubSamples : m_project.sampling.bladeSubSamples;
    // Millions of rays; about a quarter of the layer texels are covered in grass, all of the ground is.
    const double rays = 1e-6 * shape.columns() * shape.layers * subSamples;
    const double covered = set == LayerSet::Ground ? rays : 0.25 * rays;
    const std::string name = trace::layerSetName(set);
    planNode("hits", name, rays);
    planNode("visibility", name, covered * m_project.sampling.visibilityDirections);
    for (std::size_t light = 0; light < m_lights.size(); ++light) planNode("luminance", lightName(set, light), covered);
    planNode("fit", name, 0.2 * rays);
    if (lpt::needsSun(fitOptionsOf(m_project, set).basis)) {
      planNode("representation", name, 0.2 * rays);
      planNode("luminance", sunName(set), covered);
    }
    if (set == LayerSet::Slices && m_project.fit != seamOptionsOf(m_project)) planNode("fit", "seams", 0.2 * rays);
    planNode("surface", name, 0.2 * covered);
    if (set == LayerSet::Slices) planNode("tiles", "", 1.0);
    planNode("stack", name, 0.2 * rays);
  };
  for (const LayerSet set : trace::kAllLayerSets) planSet(set);
  planNode("map", "", 0.2);
  planNode("ground", "", 0.5);
}

std::size_t Session::indexOf(const std::string& kind, const std::string& what) const {
  const auto& nodes = m_report.nodes;
  const auto found = std::find_if(nodes.begin(), nodes.end(),
                                  [&](const NodeReport& node) { return node.kind == kind && node.what == what; });
  SWARD_CHECK(found != nodes.end());
  return static_cast<std::size_t>(found - nodes.begin());
}

JobContext Session::jobOf(std::size_t node) const {
  JobContext job{m_job.stop, {}, m_job.threads};
  if (!m_job.onProgress) return job;
  const double total = m_progressEnd.back();
  const double begin = node == 0 ? 0.0 : m_progressEnd[node - 1];
  const double width = m_progressEnd[node] - begin;
  const NodeReport& report = m_report.nodes[node];
  const std::string stage = report.what.empty() ? report.kind : report.kind + ": " + report.what;
  job.onProgress = [this, total, begin, width, stage](const std::string&, double fraction) {
    m_job.onProgress(stage, (begin + width * std::clamp(fraction, 0.0, 1.0)) / total);
  };
  return job;
}

Result<std::shared_ptr<const scene::Patch>> Session::patch() {
  // Colours are part of the models: a patch is the same only when both keys are.
  base::Hasher key;
  key.add("instances").add(m_keys.patch).add(m_keys.of(LayerSet::Slices).surface);
  return node<scene::Patch>("patch", "", key.finish(), Keep::Memory, [&](const JobContext&) -> Result<scene::Patch> {
    SWARD_ASSIGN(scene::Patch grown,
                 growPatch(m_project, [this](std::size_t plant, int index) { return model(plant, index); }));
    for (const auto& model : grown.models) {
      for (const std::string& warning : model->warnings) m_report.warnings.push_back(warning);
    }
    return grown;
  });
}

/// Models from files are read once for as long as they fit in memory: reading takes longer than growing grass.
Result<std::shared_ptr<const mesh::Model>> Session::model(std::size_t plant, int index) {
  const bool remembered = m_project.patch.plants[plant].kind == project::PlantKind::Gltf;
  const base::Hash128 key = base::Hasher().add(m_keys.plants[plant]).add(index).finish();
  if (remembered) {
    if (auto known = m_memory.get<mesh::Model>(key)) return known;
  }
  SWARD_ASSIGN(mesh::Model made, patchModel(m_project, plant, index));
  auto shared = std::make_shared<const mesh::Model>(std::move(made));
  if (remembered) m_memory.put(key, shared, memoryBytes(*shared));
  return shared;
}

Result<const trace::PatchScene*> Session::scene() {
  if (!m_scene) {
    SWARD_ASSIGN(auto grown, patch());
    SWARD_ASSIGN(m_scene, trace::PatchScene::create(std::move(grown), m_job));
  }
  return m_scene.get();
}

Result<const trace::TriangleField*> Session::field() {
  if (!m_field) {
    SWARD_ASSIGN(auto grown, patch());
    SWARD_ASSIGN(m_field, trace::TriangleField::create(std::move(grown), {m_job.stop, {}, m_job.threads}));
  }
  return m_field.get();
}

Result<const trace::CanopyLight*> Session::canopy() {
  if (!m_canopy) {
    SWARD_ASSIGN(const trace::TriangleField* triangles, field());
    const trace::SamplingOptions& s = m_project.sampling;
    // Voxels of two by two columns: finer ones leave single blades apart, which cast no shadow in a medium.
    std::vector<glm::dvec3> directions = m_lights;
    if (m_settings.sun) directions.push_back(*m_settings.sun);
    m_canopy = std::make_unique<trace::CanopyLight>(*triangles, std::max(s.sliceResolution / 2, 1), s.slices,
                                                    directions, JobContext{m_job.stop, {}, m_job.threads});
    if (m_job.cancelled()) return Error::cancelled();
  }
  return m_canopy.get();
}

Result<trace::LayerHits> Session::makeHits(LayerSet set, const JobContext& job) {
  if (m_settings.sampler == Sampler::Rays) {
    SWARD_ASSIGN(const trace::PatchScene* traced, scene());
    return trace::sampleHits(*traced, set, m_project.sampling, job);
  }
  if (m_passed.empty()) {
    SWARD_ASSIGN(const trace::TriangleField* triangles, field());
    SWARD_ASSIGN(m_passed, trace::passHits(*triangles, m_project.sampling, job));
  }
  return m_passed[static_cast<std::size_t>(set)];
}

Result<std::shared_ptr<const trace::LayerHits>> Session::hits(LayerSet set) {
  return node<trace::LayerHits>("hits", trace::layerSetName(set), m_keys.of(set).hits, keepTraced(),
                                [&](const JobContext& job) { return makeHits(set, job); });
}

Result<std::shared_ptr<const trace::LayerSurface>> Session::surface(LayerSet set) {
  return node<trace::LayerSurface>("surface", trace::layerSetName(set), m_keys.of(set).surface, Keep::WhileHeld,
                                   [&](const JobContext& job) -> Result<trace::LayerSurface> {
                                     SWARD_ASSIGN(const auto found, hits(set));
                                     SWARD_ASSIGN(const auto grown, patch());
                                     std::vector<glm::vec3> soil;
                                     if (set == LayerSet::Ground) {
                                       SWARD_ASSIGN(soil, soilColours(m_project, found->shape.width));
                                     }
                                     return trace::shadeSurface(*found, *grown, soil, job);
                                   });
}

/// What reaches the hits of a set from each light, by the medium.
Result<const trace::ArrivingLight*> Session::arriving(LayerSet set) {
  if (const auto made = m_arriving.find(set); made != m_arriving.end()) return &made->second;
  SWARD_ASSIGN(const auto found, hits(set));
  SWARD_ASSIGN(const trace::CanopyLight* light, canopy());
  auto arrives = light->arriving(*found, {m_job.stop, {}, m_job.threads});
  if (m_job.cancelled()) return Error::cancelled();
  return &(m_arriving[set] = std::move(arrives));
}

Result<trace::LayerVisibility> Session::makeVisibility(LayerSet set, const JobContext& job) {
  SWARD_ASSIGN(const auto found, hits(set));
  if (m_settings.sampler == Sampler::Passes) {
    SWARD_ASSIGN(const auto* arrives, arriving(set));
    return trace::visibilityOf(*found, *arrives, m_lights);
  }
  SWARD_ASSIGN(const trace::PatchScene* traced, scene());
  SWARD_ASSIGN(const trace::LayerVisibility sampled, trace::sampleVisibility(*traced, *found, m_project.sampling, job));
  return asStored(sampled);
}

Result<trace::LayerLuminance> Session::makeLuminance(LayerSet set, std::size_t light, const JobContext& job) {
  SWARD_ASSIGN(const auto found, hits(set));
  if (m_settings.sampler == Sampler::Passes) {
    SWARD_ASSIGN(const auto* arrives, arriving(set));
    return trace::luminanceOf(*found, *arrives, light);
  }
  SWARD_ASSIGN(const trace::PatchScene* traced, scene());
  const glm::dvec3& toward = light < m_lights.size() ? m_lights[light] : *m_settings.sun;
  SWARD_ASSIGN(const trace::LayerLuminance sampled, trace::sampleLuminance(*traced, *found, toward, job));
  return asStored(sampled);
}

Result<std::shared_ptr<const trace::LayerVisibility>> Session::visibility(LayerSet set) {
  return node<trace::LayerVisibility>("visibility", trace::layerSetName(set), m_keys.of(set).visibility, keepTraced(),
                                      [&](const JobContext& job) { return makeVisibility(set, job); });
}

Result<std::shared_ptr<const trace::LayerLuminance>> Session::luminance(LayerSet set, std::size_t light) {
  return node<trace::LayerLuminance>("luminance", lightName(set, light), m_keys.of(set).luminance[light], Keep::Disk,
                                     [&](const JobContext& job) { return makeLuminance(set, light, job); });
}

Result<std::shared_ptr<const trace::LayerLuminance>> Session::sunLuminance(LayerSet set) {
  return node<trace::LayerLuminance>("luminance", sunName(set), m_keys.of(set).sunLuminance, Keep::WhileHeld,
                                     [&](const JobContext& job) { return makeLuminance(set, m_lights.size(), job); });
}

Result<std::vector<tiles::SeamColumn>> Session::seamColumns() {
  SWARD_ASSIGN(const auto fitted, seamFit());
  SWARD_ASSIGN(const auto found, hits(LayerSet::Slices));
  SWARD_ASSIGN(const auto shaded, surface(LayerSet::Slices));
  const trace::LayerVisibility unused;
  return bake::seamColumns({*found, *shaded, unused, *fitted});
}

Result<std::shared_ptr<const tiles::TileSet>> Session::tileSet() {
  return node<tiles::TileSet>("tiles", "", m_keys.tiles, Keep::MemoryAndDisk,
                              [&](const JobContext& job) -> Result<tiles::TileSet> {
                                SWARD_ASSIGN(const auto columns, seamColumns());
                                const int resolution = m_project.sampling.sliceResolution;
                                const int pitch = resolution / m_project.sampling.blades;
                                std::vector<glm::ivec2> diamonds = m_settings.layout;
                                for (glm::ivec2& diamond : diamonds) diamond *= pitch;
                                return tiles::makeTileSet(columns, resolution, pitch, m_project.tiles, job, diamonds);
                              });
}

Result<std::shared_ptr<const lpt::LayerStack>> Session::stack(LayerSet set) {
  return node<lpt::LayerStack>("stack", trace::layerSetName(set), m_keys.of(set).stack, Keep::Memory,
                               [&](const JobContext& job) -> Result<lpt::LayerStack> {
                                 const bool tiled = set == LayerSet::Slices || set == LayerSet::Ground;
                                 SWARD_ASSIGN(const auto found, hits(set));
                                 SWARD_ASSIGN(const auto seen, visibility(set));
                                 SWARD_ASSIGN(const auto fitted, fit(set));
                                 SWARD_ASSIGN(const auto shaded, surface(set));
                                 const SetLayers layers{*found, *shaded, *seen, *fitted};
                                 lpt::LayerStackInput input;
                                 if (tiled) {
                                   SWARD_ASSIGN(const auto cut, tileSet());
                                   input = tileStack(layers, *cut, job);
                                 } else {
                                   input = patchStack(layers, job);
                                 }
                                 if (m_job.cancelled()) return Error::cancelled();
                                 return lpt::quantise(input, stackOptionsOf(m_project, set), !tiled, job);
                               });
}

Result<std::shared_ptr<const tiles::TileMap>> Session::map() {
  return node<tiles::TileMap>("map", "", m_keys.map, Keep::Memory, [&](const JobContext&) -> Result<tiles::TileMap> {
    SWARD_ASSIGN(const auto cut, tileSet());
    const tiles::TileOptions& t = m_project.tiles;
    return tiles::makeTileMap(*cut, t.mapWidth, t.mapHeight, t.map, t.seed);
  });
}

Result<GroundBake> Session::makeGround(const JobContext&) {
  GroundBake ground;
  ground.patchSideM = m_project.patch.sideM;
  ground.bladesPerPatch = m_project.sampling.blades;
  for (const LayerSet set : trace::kAllLayerSets) {
    SWARD_ASSIGN(const auto made, stack(set));
    const auto index = static_cast<std::size_t>(set);
    if (set == LayerSet::Slices) {
      ground.slices = *made;
    } else if (set == LayerSet::Ground) {
      ground.soil = *made;
    } else {
      ground.blades[index - static_cast<std::size_t>(LayerSet::BladesPosX)] = *made;
    }
  }
  SWARD_ASSIGN(const auto cut, tileSet());
  SWARD_ASSIGN(const auto grown, patch());
  ground.heightM = grown->heightM;
  ground.tiles = *cut;
  ground.bladeOwners = tiles::bladeOwners(*cut, m_project.sampling.blades);
  SWARD_ASSIGN(const auto cells, map());
  ground.map = *cells;
  return ground;
}

Result<std::shared_ptr<const GroundBake>> Session::ground() {
  return node<GroundBake>("ground", "", m_keys.ground, Keep::MemoryAndDisk,
                          [&](const JobContext& job) { return makeGround(job); });
}

Result<Inspection> Session::makeInspection(const JobContext& job) {
  Inspection made;
  std::vector<Shared<lpt::Fit>> held;
  std::vector<const lpt::Fit*> fits;
  for (const LayerSet set : trace::kAllLayerSets) {
    if (set == LayerSet::Ground) continue;  // a fit of another kind
    SWARD_ASSIGN(held.emplace_back(), fit(set));
    fits.push_back(held.back().get());
  }
  made.conditions = conditionRange(fits);
  for (const LayerSet set : trace::kAllLayerSets) {
    SWARD_ASSIGN(const auto found, hits(set));
    SWARD_ASSIGN(const auto seen, visibility(set));
    SWARD_ASSIGN(const auto fitted, fit(set));
    const InspectedLayers layers{*found, *seen, *fitted};
    if (set == LayerSet::Slices || set == LayerSet::Ground) {
      SWARD_ASSIGN(const auto cut, tileSet());
      (set == LayerSet::Slices ? made.slices : made.soil) = inspectTiles(layers, made.conditions, *cut, job);
    } else {
      made.blades[static_cast<std::size_t>(set) - static_cast<std::size_t>(LayerSet::BladesPosX)] =
          inspectPatch(layers, made.conditions, job);
    }
  }
  return made;
}

Result<std::shared_ptr<const Inspection>> Session::inspection() {
  constexpr int kVersion = 1;
  base::Hasher key;
  key.add("inspection").add(kVersion).add(m_keys.tiles);
  for (const SetKeys& set : m_keys.sets) key.add(set.fit).add(set.visibility);
  planNode("inspection", "", 1.0);
  return node<Inspection>("inspection", "", key.finish(), Keep::Memory,
                          [&](const JobContext& job) { return makeInspection(job); });
}

BakeReport Session::takeReport() {
  if (m_scene) {
    const trace::RayCounts rays = m_scene->rayCounts();
    m_report.raysNearest = rays.nearest;
    m_report.raysOcclusion = rays.occlusion;
  }
  m_report.seconds = std::chrono::duration<double>(Clock::now() - m_start).count();
  return std::move(m_report);
}

}  // namespace sward::bake
