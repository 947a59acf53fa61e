#include "report/speed.h"

#include "bake/bake.h"
#include "bake/plants.h"
#include "render/frame_plan.h"
#include "render/renderer.h"
#include "report/section.h"
#include "report/speed_edit.h"
#include "report/speed_fit.h"
#include "report/speed_render.h"
#include "report/speed_sampling.h"
#include "report/speed_wither.h"
#include "report/storage.h"
#include "scene/camera.h"
#include "trace/patch_scene.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>

#include <unistd.h>

namespace sward::report {
namespace {

namespace fs = std::filesystem;
using GroundPtr = std::shared_ptr<const bake::GroundBake>;

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kColdLimitMs = 30000.0;  ///< of the first step's targets
constexpr double kWarmLimitMs = 2000.0;

/// A folder that is removed with everything in it.
class ScratchFolder {
 public:
  ScratchFolder() : m_path(fs::temp_directory_path() / ("sward-report-" + std::to_string(::getpid()))) {}
  ~ScratchFolder() {
    std::error_code code;
    fs::remove_all(m_path, code);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return m_path; }

 private:
  fs::path m_path;
};

/// Forgets the peak of the resident memory (proc(5): clear_refs, 5), where the system lets us.
bool resetPeakMemory() {
  std::ofstream out("/proc/self/clear_refs");
  out << "5" << std::flush;
  return out.good();
}

std::optional<std::uint64_t> peakMemoryBytes() {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::strtoull(line.c_str() + 6, nullptr, 10) * 1024;
  }
  return std::nullopt;
}

Result<void> drawOnce(const SpeedInput& input, const GroundPtr& ground) {
  const project::Project& project = input.project;
  const scene::View view = project.views.empty() ? scene::View{} : project.views.front();
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(project));
  SWARD_ASSIGN(render::Frame frame, render::planFrame(project, view, daylight));
  frame.width = kWidth;
  frame.height = kHeight;
  SWARD_ASSIGN(const auto renderer, render::Renderer::create(input.context));
  SWARD_TRY(renderer->setGround(ground));
  renderer->setDaylight(daylight, project.sky.hazeKm);
  SWARD_ASSIGN(const image::Image picture, renderer->drawDisplay(frame));
  return picture.empty() ? Result<void>(Error::failed("the picture is empty")) : Result<void>();
}

/// From the cache folder to a picture, as `sward render` does it.
Result<void> renderFrom(const SpeedInput& input, const fs::path& cacheFolder, const JobContext& job) {
  SWARD_ASSIGN(bake::DiskCache cache, bake::DiskCache::open(cacheFolder));
  bake::Baker baker(std::move(cache));
  SWARD_ASSIGN(const GroundPtr ground, baker.ground(input.project, job));
  return drawOnce(input, ground);
}

Row renderRow(const SpeedInput& input, const std::string& method, const TimeMs& time, double limitMs) {
  Row row;
  row.method = method;
  row.numbersAndNames = {{"width", std::to_string(kWidth)},
                         {"height", std::to_string(kHeight)},
                         {"samples", std::to_string(input.project.render.samples)}};
  row.timeMs = time;
  row.ratio = limitMs / time.median;
  row.against = "limit of " + std::to_string(static_cast<int>(limitMs / 1000.0)) + " s, over the time";
  return row;
}

Result<Row> coldRow(const SpeedInput& input, const JobContext& job) {
  const ScratchFolder scratch;
  const bool reset = resetPeakMemory();
  const auto start = std::chrono::steady_clock::now();
  SWARD_TRY(renderFrom(input, scratch.path(), job));
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  Row row = renderRow(input, "render_cold", {ms, ms, ms, 1}, kColdLimitMs);
  row.notes = "everything baked, once, into an empty cache, then drawn";
  const auto peak = peakMemoryBytes();
  if (reset && peak) row.numbersAndNames["peak_resident_bytes"] = std::to_string(*peak);
  return row;
}

Result<Row> warmRow(const SpeedInput& input, const JobContext& job) {
  Result<void> outcome;
  const TimeMs time = timeRuns(input.quick ? 1 : 5, [&] {
    if (outcome.ok()) outcome = renderFrom(input, input.cacheFolder, job);
  });
  SWARD_TRY(std::move(outcome));
  Row row = renderRow(input, "render_warm", time, kWarmLimitMs);
  row.notes = "cache read, uploaded, relit and drawn; starting the process and the context is left out";
  return row;
}

Result<Row> samplingRow(const SpeedInput& input, const JobContext& job) {
  SWARD_ASSIGN(scene::Patch grown, bake::growPatch(input.project));
  SWARD_ASSIGN(const auto traced, trace::PatchScene::create(std::make_shared<const scene::Patch>(std::move(grown))));
  return layerSamplingRow(*traced, input.project.sampling, job);
}

Result<std::vector<Row>> drawingRows(const SpeedInput& input, const JobContext& job) {
  SWARD_ASSIGN(bake::DiskCache cache, bake::DiskCache::open(input.cacheFolder));
  bake::Baker baker(std::move(cache));
  SWARD_ASSIGN(const GroundPtr ground, baker.ground(input.project, job));
  return renderRows(input.context, ground, input.quick);
}

Result<std::vector<Row>> single(Result<Row> row) {
  if (!row.ok()) return std::move(row).error();
  return std::vector<Row>{std::move(row).value()};
}

}  // namespace

Result<std::vector<Row>> speedRows(const SpeedInput& input, const JobContext& job) {
  using Step = std::function<Result<std::vector<Row>>(const JobContext&)>;
  const project::Project ground = groundProject(input.project, input.quick);
  const SpeedInput drawn{ground, input.context, input.cacheFolder, input.quick};
  std::vector<std::pair<std::string, Step>> steps;
  // The cold render comes first, so that its peak of memory is its own.
  if (!input.quick) {
    steps.emplace_back("render_cold", [&](const JobContext& j) { return single(coldRow(input, j)); });
  }
  steps.emplace_back("layer_sampling", [&](const JobContext& j) { return single(samplingRow(input, j)); });
  steps.emplace_back("lpt_fit", [&](const JobContext& j) { return single(Result<Row>(lptFitRow(j, input.quick))); });
  steps.emplace_back("drawing", [&](const JobContext& j) { return drawingRows(drawn, j); });
  steps.emplace_back("render_warm", [&](const JobContext& j) { return single(warmRow(drawn, j)); });
  steps.emplace_back("edit_preview", [&](const JobContext& j) { return editPreviewRows(input, j); });
  steps.emplace_back("curve_preview", [&](const JobContext& j) { return curvePreviewRows(input, j); });
  steps.emplace_back("storage", [&](const JobContext& j) { return Result<std::vector<Row>>(storageRows(j)); });
  steps.emplace_back("wither", [&](const JobContext& j) {
    WitherSpeedSize size;
    if (input.quick) size.runs = 3;
    return witherSpeedRows(size, j);
  });
  std::vector<Row> rows;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (job.cancelled()) return Error::cancelled();
    const auto report = [&, i](const std::string& stage, double fraction) {
      job.onProgress(steps[i].first + (stage.empty() ? "" : ", " + stage),
                     (static_cast<double>(i) + fraction) / static_cast<double>(steps.size()));
    };
    JobContext step{job.stop, {}, job.threads};
    if (job.onProgress) {
      report("", 0.0);
      step.onProgress = report;
    }
    SWARD_ASSIGN(std::vector<Row> measured, steps[i].second(step));
    for (Row& row : measured) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace sward::report
