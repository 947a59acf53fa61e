#include "report/choice_trial.h"

#include "bake/bake.h"
#include "bake/ground_plan.h"
#include "bake/plants.h"
#include "bake/soil.h"
#include "render/display.h"
#include "render/frame_plan.h"
#include "render/renderer.h"
#include "report/row.h"
#include "trace/reference.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string_view>

namespace sward::report {
namespace {

constexpr int kTimedFrames = 3;

/// What the views of one candidate share.
struct Bench {
  const project::Project& project;  ///< with the candidate applied
  const TrialSize& size;
  std::shared_ptr<const bake::GroundBake> ground;
  scene::Daylight daylight;
  render::Renderer& renderer;
  const trace::PatchScene& patch;
  trace::GroundPlan plan;
};

/// Of what a reference of the view shows: the tiles and where they lie, which soil, and from where.
base::Hash128 truthKey(const trace::GroundPlan& plan, const scene::View& view) {
  base::Hasher hasher;
  hasher.add(std::string_view(view.name)).add(plan.patchTexels).add(plan.tileTexels);
  for (const auto& tile : plan.offsets) {
    for (const glm::ivec2& offset : tile) hasher.add(offset.x).add(offset.y);
  }
  hasher.bytes(std::as_bytes(std::span(plan.owner))).bytes(std::as_bytes(std::span(plan.map)));
  return hasher.finish();
}

Result<ReferenceStore::Truth> traceView(const Bench& bench, const render::Frame& frame, const JobContext& job) {
  trace::ReferenceOptions options;
  options.width = frame.width;
  options.height = frame.height;
  options.exposure = frame.exposure;
  SWARD_ASSIGN(std::vector<glm::vec3> soil, bake::soilColours(bench.project, bench.plan.patchTexels));
  SWARD_ASSIGN(const auto reference,
               trace::Reference::create(
                   {&bench.patch, &bench.plan, std::move(soil), bench.daylight, bench.project.sky.hazeKm, {}},
                   frame.camera, options));
  SWARD_TRY(reference->addSamples(bench.size.samples, job));
  const image::Image truth = reference->mean();
  const render::ViewTransform transform = frame.options.viewTransform;
  return ReferenceStore::Truth{render::toDisplay(truth, transform),
                               render::displayNoise(truth, reference->variance(), transform)};
}

Result<ViewError> compareView(const Bench& bench, const scene::View& view, ReferenceStore& references,
                              const JobContext& job) {
  SWARD_ASSIGN(render::Frame frame, render::planFrame(bench.project, view, bench.daylight));
  frame.width = bench.size.width;
  frame.height = bench.size.height;
  // Choices of taste, no errors; the bend moves slices, not blades, off the reference's places.
  frame.options.macroVariation = frame.options.gridBendM = 0.0;
  SWARD_ASSIGN(const image::Image drawn, bench.renderer.drawDisplay(frame));
  const base::Hash128 key = truthKey(bench.plan, view);
  const ReferenceStore::Truth* truth = references.find(key);
  if (truth == nullptr) {
    SWARD_ASSIGN(ReferenceStore::Truth traced, traceView(bench, frame, job));
    truth = &references.add(key, std::move(traced));
  }
  ViewError error;
  error.name = view.name;
  error.noise = truth->noise;
  SWARD_ASSIGN(error.figures, image::compareDisplayImages({truth->display, drawn}, {}, job));
  return error;
}

/// Milliseconds of a frame, the mean of the views.
Result<double> drawTime(const Bench& bench, const std::vector<scene::View>& views) {
  double sum = 0.0;
  for (const scene::View& view : views) {
    SWARD_ASSIGN(render::Frame frame, render::planFrame(bench.project, view, bench.daylight));
    frame.width = bench.size.width;
    frame.height = bench.size.height;
    Result<void> outcome;
    sum += timeRuns(kTimedFrames, [&] {
             if (outcome.ok()) outcome = bench.renderer.drawOnly(frame);
           }).median;
    SWARD_TRY(std::move(outcome));
  }
  return sum / static_cast<double>(views.size());
}

}  // namespace

double ViewError::value(ErrorBound metric) const {
  const double rmse = std::sqrt(std::max(figures.rmse * figures.rmse - noise * noise, 0.0));
  switch (metric) {
    case ErrorBound::Psnr:
      // Equal pictures: as good as any bound that can be stated.
      return rmse > 0.0 ? -20.0 * std::log10(rmse) : 1000.0;
    case ErrorBound::Ssim:
      return figures.ssim;
    case ErrorBound::Flip:
      return figures.flip;
    default:
      return rmse;
  }
}

Result<TrialMeasurement> measureTrial(const ChoiceInput& input, const Candidate& candidate, bool floor,
                                      ReferenceStore& references, const JobContext& job) {
  project::Project project = input.project;
  applyCandidate(candidate, project);
  if (floor) project.fit.basis = lpt::Basis::Sampled;
  const JobContext quiet{job.stop, {}, job.threads};
  bake::Baker baker;
  SWARD_ASSIGN(auto ground, baker.ground(project, quiet));
  SWARD_ASSIGN(scene::Patch grown, bake::growPatch(project));
  SWARD_ASSIGN(const auto patch,
               trace::PatchScene::create(std::make_shared<const scene::Patch>(std::move(grown)), quiet));
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(project));
  SWARD_ASSIGN(const auto renderer, render::Renderer::create(input.context));
  SWARD_TRY(renderer->setGround(ground));
  renderer->setDaylight(daylight, project.sky.hazeKm);
  const Bench bench{project, input.size, ground, daylight, *renderer, *patch, bake::groundPlan(*ground)};
  TrialMeasurement measured;
  for (const scene::View& view : input.views) {
    SWARD_ASSIGN(measured.views.emplace_back(), compareView(bench, view, references, quiet));
  }
  SWARD_ASSIGN(measured.drawMs, drawTime(bench, input.views));
  Result<void> outcome;
  measured.relightMs = timeRuns(kTimedFrames, [&] {
                         if (outcome.ok()) outcome = renderer->relight(daylight, false);
                       }).median;
  SWARD_TRY(std::move(outcome));
  return measured;
}

}  // namespace sward::report
