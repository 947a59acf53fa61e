#include "live/reference_tracer.h"

#include "bake/ground_plan.h"
#include "bake/keys.h"
#include "bake/plants.h"
#include "bake/soil.h"
#include "render/display.h"
#include "render/frame_plan.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sward::editor {
namespace {

/// Of the plants' geometry and colours: all that a tree holds.
Result<base::Hash128> treeKey(const project::Project& project, bake::AssetHashes& assets) {
  // Neither the lights nor a sun are part of what is asked here; some fits want one.
  bake::GroundSettings settings;
  settings.sun = glm::dvec3(0.0, 0.0, 1.0);
  SWARD_ASSIGN(const bake::GroundKeys keys, bake::groundKeys(project, {}, settings, assets));
  base::Hasher hasher;
  hasher.add(keys.patch);
  for (const base::Hash128& plant : keys.plants) hasher.add(plant);
  return hasher.finish();
}

}  // namespace

bool sameReference(const ReferenceRequest& a, const ReferenceRequest& b) {
  const auto look = [](const ReferenceRequest& r) {
    return std::pair(r.project->render.viewTransform, r.project->render.gridBendM);
  };
  // A ground says what it was baked from.
  return a.ground == b.ground && a.view == b.view && a.width == b.width && a.height == b.height && look(a) == look(b) &&
         a.project->sun == b.project->sun && a.project->sky == b.project->sky;
}

void ReferenceTracer::clear() {
  m_reference.reset();
  m_request.reset();
  m_tree.reset();
}

bool ReferenceTracer::complete(const ReferenceRequest& request) const {
  if (!m_reference || !m_request || !sameReference(*m_request, request)) return false;
  if (m_half) return request.moving && m_reference->samples() > 0;
  return m_reference->samples() >= m_samples;
}

Result<void> ReferenceTracer::growTree(const ReferenceRequest& request, const JobContext& job) {
  SWARD_ASSIGN(const base::Hash128 key, treeKey(*request.planted, m_assets));
  if (m_tree && key == m_treeKey) return {};
  m_tree.reset();  // two at once would need twice the memory
  SWARD_ASSIGN(scene::Patch patch, bake::growPatch(*request.planted));
  SWARD_ASSIGN(m_tree, trace::PatchScene::create(std::make_shared<const scene::Patch>(std::move(patch)), job));
  m_treeKey = key;
  ++m_trees;
  return {};
}

Result<void> ReferenceTracer::begin(bool half) {
  m_reference.reset();
  const project::Project& project = *m_request->project;
  SWARD_ASSIGN(scene::Daylight daylight, render::daylightOf(project));
  SWARD_ASSIGN(const render::Frame frame, render::planFrame(project, m_request->view, daylight));
  SWARD_ASSIGN(std::vector<glm::vec3> soil, bake::soilColours(*m_request->planted, m_plan.patchTexels));
  trace::ReferenceOptions options;
  options.width = half ? (m_request->width + 1) / 2 : m_request->width;
  options.height = half ? (m_request->height + 1) / 2 : m_request->height;
  options.gridBendM = frame.options.gridBendM;
  options.exposure = frame.exposure;
  SWARD_ASSIGN(m_reference, trace::Reference::create({m_tree.get(), &m_plan, std::move(soil), std::move(daylight),
                                                      project.sky.hazeKm, std::nullopt},
                                                     frame.camera, options));
  m_half = half;
  m_transform = frame.options.viewTransform;
  return {};
}

Result<std::shared_ptr<const ReferencePicture>> ReferenceTracer::addBatch(const ReferenceRequest& request,
                                                                          const JobContext& job) {
  if (!m_request || !sameReference(*m_request, request)) {
    m_reference.reset();
    m_request.reset();
    SWARD_TRY(growTree(request, job));
    m_plan = bake::groundPlan(*request.ground);
    m_request = request;
  }
  if (!m_reference) {
    SWARD_TRY(begin(true));
  } else if (m_half && m_reference->samples() > 0 && !request.moving) {
    SWARD_TRY(begin(false));
  }
  const int most = m_half ? ReferenceService::kBatch : m_samples;
  SWARD_TRY(m_reference->addSamples(std::min(ReferenceService::kBatch, most - m_reference->samples()), job));
  return picture();
}

std::shared_ptr<const ReferencePicture> ReferenceTracer::picture() const {
  const image::Image mean = m_reference->mean();
  return std::make_shared<const ReferencePicture>(
      ReferencePicture{image::toBytes(render::toDisplay(mean, m_transform)), m_half, m_reference->samples(),
                       render::displayNoise(mean, m_reference->variance(), m_transform)});
}

}  // namespace sward::editor
