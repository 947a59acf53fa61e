#include "report/section_grassland.h"

#include "bake/bake.h"
#include "render/frame_plan.h"
#include "render/renderer.h"
#include "report/grassland_causes.h"
#include "report/ground_truth.h"
#include "report/picture_row.h"
#include "report/speed_views.h"
#include "report/text.h"

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr GrasslandSizes kQuick{240, 136, 16, 4, 3};

struct Drawn {
  const char* name;
  render::GroundMethod method;
  const char* notes;
};
constexpr std::array kDrawn{
    Drawn{"march", render::GroundMethod::March, "front to back in one pass, ends where a ray is opaque"},
    Drawn{"blended", render::GroundMethod::BlendedNormalised, "all planes blended, weights that sum to 1"},
    Drawn{"blended_paper", render::GroundMethod::BlendedPaper, "all planes blended, the paper's weights"}};

/// What all views share.
struct Bench {
  const SectionInput& input;
  GrasslandSizes sizes;
  std::shared_ptr<const bake::GroundBake> ground;
  scene::Daylight daylight;
  std::unique_ptr<render::Renderer> renderer;
  GroundTruth truth;
};

Result<render::Frame> frameOf(const Bench& bench, const SpeedView& view) {
  SWARD_ASSIGN(render::Frame frame, render::planFrame(bench.input.project, viewOf(view), bench.daylight));
  frame.width = bench.sizes.width;
  frame.height = bench.sizes.height;
  // A choice of taste and a device against repetition, no errors; blades are bent otherwise than slices.
  frame.options.macroVariation = 0.0;
  frame.options.gridBendM = 0.0;
  return frame;
}

/// Of a frame by each method; each is timed in turn with the march.
Result<std::array<TimeMs, kDrawn.size()>> timeMethods(Bench& bench, const render::Frame& frame) {
  std::array<TimeMs, kDrawn.size()> times;
  Result<void> outcome;
  const auto draw = [&](render::GroundMethod method) {
    render::Frame one = frame;
    one.options.method = method;
    if (outcome.ok()) outcome = bench.renderer->drawOnly(one);
  };
  for (std::size_t i = 1; i < kDrawn.size(); ++i) {
    std::tie(times[0], times[i]) = timePairs(
        bench.sizes.runs, [&] { draw(kDrawn[0].method); }, [&] { draw(kDrawn[i].method); });
  }
  SWARD_TRY(std::move(outcome));
  return times;
}

std::map<std::string, std::string> parametersOf(const Bench& bench, const SpeedView& view, const render::Frame& frame) {
  return {{"view", quotedText(view.name)},
          {"slant_deg", numberText(view.slantDeg)},
          {"distance_m", numberText(view.distanceM)},
          {"width", std::to_string(frame.width)},
          {"height", std::to_string(frame.height)},
          {"samples", std::to_string(frame.options.samples)},
          {"layers", std::to_string(bench.ground->slices.layers)},
          {"device", quotedText(bench.input.context.info().renderer)}};
}

/// Draws and compares one method; adds its picture and difference to the strip.
Result<Row> methodRow(Bench& bench, const SpeedView& view, const render::Frame& planned, const Drawn& drawn,
                      const PictureReference& reference, Strip& strip, const JobContext& job) {
  render::Frame frame = planned;
  frame.options.method = drawn.method;
  SWARD_ASSIGN(image::Image linear, bench.renderer->drawLinear(frame));
  SWARD_ASSIGN(Row row, pictureRow({drawn.name, "grassland_" + view.name + "_" + drawn.name, std::move(linear)},
                                   reference, frame.options.viewTransform, strip, job));
  row.numbersAndNames.merge(parametersOf(bench, view, frame));
  row.notes = drawn.notes;
  return row;
}

Result<std::vector<Row>> viewRows(Bench& bench, const SpeedView& view, Section& section, const JobContext& job) {
  SWARD_ASSIGN(const render::Frame frame, frameOf(bench, view));
  SWARD_ASSIGN(const PictureReference reference,
               pictureReference(bench.truth, frame, "grassland_" + view.name + "_reference", bench.sizes.samples, job));
  Strip strip{"View " + view.name, {}};
  strip.pictures.push_back(pictureOf(reference, "reference"));
  SWARD_ASSIGN(const auto times, timeMethods(bench, frame));
  std::vector<Row> rows;
  for (std::size_t i = 0; i < kDrawn.size(); ++i) {
    SWARD_ASSIGN(Row row, methodRow(bench, view, frame, kDrawn[i], reference, strip, job));
    row.timeMs = times[i];
    row.ratio = times[i == 0 ? 1 : 0].median / times[i].median;
    row.against = i == 0 ? "blended planes of the same view" : "the march of the same view";
    rows.push_back(std::move(row));
  }
  section.strips.push_back(std::move(strip));
  return rows;
}

/// Time against error, a series a method, a point a view.
Plot paretoOf(const std::vector<Row>& rows) {
  Plot plot;
  plot.name = "grassland_time_error";
  plot.title = "Time of a frame against its error";
  plot.xLabel = "time of a frame (ms)";
  plot.yLabel = "RMSE, linear, noise taken off";
  plot.caption = "One point a view angle; lower left is better.";
  plot.logX = plot.pareto = true;
  for (const Drawn& drawn : kDrawn) {
    Plot::Series series{drawn.name, {}, false};
    for (const Row& row : rows) {
      if (row.method != drawn.name || !row.timeMs) continue;
      const std::string view = row.numbersAndNames.at("view");
      series.points.push_back({row.timeMs->median, std::stod(row.numbersAndNames.at("rmse_without_noise")),
                               view.substr(1, view.size() - 2)});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Result<Bench> makeBench(const SectionInput& input, const GrasslandSizes& sizes, bake::Baker& baker,
                        const JobContext& job) {
  SWARD_ASSIGN(auto ground, baker.ground(input.project, job));
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(input.project));
  SWARD_ASSIGN(auto renderer, render::Renderer::create(input.context));
  SWARD_TRY(renderer->setGround(ground));
  renderer->setDaylight(daylight, input.project.sky.hazeKm);
  SWARD_ASSIGN(GroundTruth truth, GroundTruth::create(input.project, *ground, daylight, job));
  return Bench{input, sizes, std::move(ground), daylight, std::move(renderer), std::move(truth)};
}

constexpr const char* kSummary =
    "The drawn meadow against the truth: its own plants, ray-traced where the tiles lay them, lit by sun and sky. "
    "RMSE, bias and the largest difference are of linear radiance times exposure; PSNR, SSIM and FLIP are of what the "
    "screen shows. All pictures are filtered alike.\n\n"
    "Rows cause_... say what single steps cost, at half the size: each is the difference that one step alone makes. "
    "They do not add up to the whole, since errors of different steps also cancel.";

}  // namespace

Result<Section> grasslandSection(const SectionInput& input, const JobContext& job) {
  const project::Project project = groundProject(input.project, input.quick);
  const SectionInput drawn{project, input.context, input.cacheFolder, input.quick};
  return measureGrassland(drawn, input.quick ? kQuick : GrasslandSizes{}, job);
}

Result<Section> measureGrassland(const SectionInput& input, const GrasslandSizes& sizes, const JobContext& job) {
  const JobContext quiet{job.stop, {}, job.threads};
  const auto step = [&](const std::string& name, double fraction) {
    if (job.onProgress) job.onProgress(name, fraction);
  };
  step("bake", 0.0);
  SWARD_ASSIGN(bake::DiskCache cache, bake::DiskCache::open(input.cacheFolder));
  bake::Baker baker(std::move(cache));
  SWARD_ASSIGN(Bench bench, makeBench(input, sizes, baker, quiet));
  Section section;
  section.name = "grassland";
  section.title = "Grassland";
  section.summary = kSummary;
  const std::array views{SpeedView{"down", 90.0, kNearM}, SpeedView{"45", 45.0, kNearM},
                         grazingView(bench.ground->tileSideM())};
  double done = 0.05;
  for (const SpeedView& view : views) {
    step("view " + view.name, done);
    SWARD_ASSIGN(std::vector<Row> rows, viewRows(bench, view, section, quiet));
    for (Row& row : rows) section.rows.push_back(std::move(row));
    done += 0.2;
  }
  section.plots.push_back(paretoOf(section.rows));
  step("causes: bakes", done);
  SWARD_ASSIGN(CauseGrounds grounds, bakeCauseGrounds(input.project, bench.ground, baker, quiet));
  for (const SpeedView& view : views) {
    step("causes: view " + view.name, done += 0.1);
    SWARD_ASSIGN(render::Frame frame, frameOf(bench, view));
    frame.width /= 2;
    frame.height /= 2;
    const CauseInput causes{*bench.renderer, bench.truth, grounds, frame, bench.sizes.causeSamples};
    SWARD_ASSIGN(std::vector<Row> rows, causeRows(causes, quiet));
    for (Row& row : rows) {
      for (auto& [name, value] : parametersOf(bench, view, frame)) row.numbersAndNames.emplace(name, value);
      section.rows.push_back(std::move(row));
    }
  }
  if (job.cancelled()) return Error::cancelled();
  section.summary += "\n\nThe reference traced " + numberText(static_cast<double>(bench.truth.rays()) * 1e-6) +
                     " million rays in " + numberText(std::round(bench.truth.seconds() * 10.0) / 10.0) + " s.";
  return section;
}

}  // namespace sward::report
