#include "report/speed_edit.h"

#include "bake/bake.h"
#include "bake/withering.h"
#include "render/frame_plan.h"
#include "render/renderer.h"
#include "scene/camera.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

namespace sward::report {
namespace {

constexpr int kWidth = 1280, kHeight = 800;
constexpr double kCoarseLimitMs = 150.0, kHalfLimitMs = 3000.0;
constexpr std::uint64_t kMemoryBytes = std::uint64_t{1} << 30;  ///< as the editor's

using Clock = std::chrono::steady_clock;
double msSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

enum class Edit { Geometry, Colour };

/// Another value each time, so that no cache knows it.
void edit(project::Plant& plant, Edit what, int step) {
  const double scale = 1.0 + 0.01 * step;
  const bool geometry = what == Edit::Geometry;
  switch (plant.kind) {
    case project::PlantKind::Grass:
      geometry ? plant.grass.heightM *= scale : plant.grass.tipColour.x *= scale;
      return;
    case project::PlantKind::Flower:
      geometry ? plant.flower.heightM *= scale : plant.flower.petalColour.x *= scale;
      return;
    case project::PlantKind::Clover:
      geometry ? plant.clover.heightM *= scale : plant.clover.leafColour.x *= scale;
      return;
    case project::PlantKind::Gltf:
      break;
  }
  if (geometry) {
    plant.gltf.heightM = plant.gltf.heightM.value_or(0.3) * scale;
  } else {
    if (!plant.gltf.material) plant.gltf.material.emplace();
    plant.gltf.material->optics.translucency = 0.5 / scale;
  }
}

/// The editor's way from values to a picture.
class Preview {
 public:
  static Result<Preview> create(gpu::Context& context, const project::Project& project, const JobContext& job) {
    Preview preview(job);
    SWARD_ASSIGN(preview.m_renderer, render::Renderer::create(context));
    SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(project));
    preview.m_renderer->setDaylight(daylight, project.sky.hazeKm);
    const scene::View view = project.views.empty() ? scene::View{} : project.views.front();
    SWARD_ASSIGN(preview.m_frame, render::planFrame(project, view, daylight));
    preview.m_frame.width = kWidth / 2;
    preview.m_frame.height = kHeight / 2;
    preview.m_frame.options.samples = 1;
    return preview;
  }

  struct Measured {
    double bakeMs = 0.0, drawMs = 0.0;
    bake::BakeReport report;
    std::shared_ptr<const bake::GroundBake> ground;
    double totalMs() const { return bakeMs + drawMs; }
  };
  Result<Measured> show(const project::Project& project, bake::Quality quality) {
    Measured measured;
    const auto start = Clock::now();
    SWARD_ASSIGN(const auto ground, m_baker.ground({project, quality, m_layout}, m_job, &measured.report));
    measured.bakeMs = msSince(start);
    if (m_layout.empty()) m_layout = bake::layoutOf(*ground);
    const auto baked = Clock::now();
    SWARD_TRY(m_renderer->setGround(ground));
    SWARD_TRY(m_renderer->drawOnly(m_frame));
    measured.drawMs = msSince(baked);
    measured.ground = ground;
    return measured;
  }
  /// The picture that was shown last, whose ground is lit already.
  Result<double> drawAgain() {
    const auto start = Clock::now();
    SWARD_TRY(m_renderer->drawOnly(m_frame));
    return msSince(start);
  }
  /// Full grounds choose their tiles anew, as a render does.
  void forgetLayout() { m_layout.clear(); }

 private:
  explicit Preview(const JobContext& job) : m_job{job.stop, {}, job.threads}, m_baker({}, {kMemoryBytes, true}) {}

  JobContext m_job;
  bake::Baker m_baker;
  std::unique_ptr<render::Renderer> m_renderer;
  render::Frame m_frame;
  std::vector<glm::ivec2> m_layout;
};

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.1f", value);
  return text;
}

TimeMs spreadOf(std::vector<double> ms) {
  std::sort(ms.begin(), ms.end());
  return {ms[ms.size() / 2], ms.front(), ms.back(), static_cast<int>(ms.size())};
}

struct Series {
  Edit what;
  bake::Quality quality;
  int runs;
};

Result<Row> measure(Preview& preview, const SpeedInput& input, const Series& series) {
  std::vector<double> total, bake, draw;
  std::uint64_t rays = 0;
  for (int run = 0; run < series.runs; ++run) {
    project::Project edited = input.project;
    edit(edited.patch.plants.front(), series.what, run + 1);
    SWARD_ASSIGN(const Preview::Measured measured, preview.show(edited, series.quality));
    total.push_back(measured.totalMs());
    bake.push_back(measured.bakeMs);
    draw.push_back(measured.drawMs);
    rays = measured.report.raysNearest + measured.report.raysOcclusion;
  }
  Row row;
  row.method = "edit_preview";
  row.numbersAndNames = {{"edit", series.what == Edit::Geometry ? "\"geometry\"" : "\"colour\""},
                         {"quality", "\"" + std::string(bake::qualityName(series.quality)) + "\""},
                         {"width", std::to_string(kWidth)},
                         {"height", std::to_string(kHeight)},
                         {"rays", std::to_string(rays)},
                         {"bake_ms", rounded(spreadOf(bake).median)},
                         {"upload_and_draw_ms", rounded(spreadOf(draw).median)}};
  row.timeMs = spreadOf(total);
  row.notes = "baked, uploaded, relit and drawn at half resolution with one sample, as while a slider moves";
  return row;
}

void against(Row& row, double limitMs, const std::string& what) {
  row.ratio = limitMs / row.timeMs->median;
  row.against = what;
}

}  // namespace

Result<std::vector<Row>> editPreviewRows(const SpeedInput& input, const JobContext& job) {
  std::vector<Row> rows;
  if (input.project.patch.plants.empty()) return rows;
  SWARD_ASSIGN(Preview preview, Preview::create(input.context, input.project, job));
  const int runs = input.quick ? 3 : 9;
  double coldMs = 0.0;
  if (!input.quick) {
    SWARD_ASSIGN(const Preview::Measured cold, preview.show(input.project, bake::Quality::Full));
    coldMs = cold.bakeMs;
  }
  // The unedited ground first, so that colours find what was traced, as in the editor.
  for (const bake::Quality quality : {bake::Quality::Coarse, bake::Quality::Half}) {
    SWARD_TRY(preview.show(input.project, quality));
    SWARD_ASSIGN(Row colour, measure(preview, input, {Edit::Colour, quality, runs}));
    against(colour, kCoarseLimitMs, "limit of 150 ms, over the time");
    rows.push_back(std::move(colour));
    const bool coarse = quality == bake::Quality::Coarse;
    SWARD_ASSIGN(Row shape, measure(preview, input, {Edit::Geometry, quality, coarse ? runs : 1}));
    against(shape, coarse ? kCoarseLimitMs : kHalfLimitMs,
            coarse ? "limit of 150 ms, over the time" : "limit of 3 s, over the time");
    rows.push_back(std::move(shape));
  }
  if (!input.quick) {
    preview.forgetLayout();
    SWARD_ASSIGN(Row full, measure(preview, input, {Edit::Geometry, bake::Quality::Full, 1}));
    against(full, coldMs, "cold bake of the unedited project in memory, over the time");
    rows.push_back(std::move(full));
  }
  return rows;
}

namespace {

constexpr double kCurveCoarseLimitMs = 100.0, kCurveFullLimitMs = 3000.0;
constexpr double kCurveBlades = 100.0;  ///< on the patch

/// The project's sky and first view over a square metre of about kCurveBlades upright blades, in the middle of an
/// autumn whose curves are the author's own.
project::Project sparseAutumn(const project::Project& project) {
  project::Project autumn = project;
  project::Plant blade;
  blade.kind = project::PlantKind::Grass;
  blade.densityPerM2 = kCurveBlades;
  blade.clumping = 0.0;
  blade.grass.bladesPerPlant = 1;
  autumn.patch.sideM = 1.0;
  autumn.patch.plants = {blade};
  autumn.render.method = render::GroundMethod::Texels;
  autumn.wither.texel = {};
  autumn.wither.mingle.clear();
  autumn.wither.weathering = 0.5;
  return autumn;
}

base::Curve curveOf(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();  // x increases and all is finite
}

/// What letting go of a point does: another value each time, so that no cache knows it.
void movePoint(project::Project& project, int step) {
  const double y = 0.4 + 0.01 * step;
  project.wither.ageing.autumn = wither::Autumn::Custom;
  project.wither.ageing.water = curveOf({{0.0, 1.0}, {0.5, y}, {1.0, 0.05}});
  project.wither.ageing.chlorophyll = curveOf({{0.0, 1.0}, {0.45, y}, {1.0, 0.02}});
}

Result<Row> measureCurve(Preview& preview, const project::Project& project, bake::Quality quality, int runs) {
  // What stands at rest is known to the editor before a curve is touched.
  project::Project edited = project;
  movePoint(edited, 0);
  SWARD_TRY(preview.show(edited, quality));
  std::vector<double> total, bake, light, draw;
  wither::TexelGrid grid;
  std::size_t voxels = 0, points = 0;
  for (int run = 1; run <= runs; ++run) {
    movePoint(edited, run);
    SWARD_ASSIGN(const Preview::Measured measured, preview.show(edited, quality));
    SWARD_ASSIGN(const double drawnMs, preview.drawAgain());
    total.push_back(measured.totalMs());
    bake.push_back(measured.bakeMs);
    draw.push_back(std::min(drawnMs, measured.drawMs));
    light.push_back(measured.drawMs - draw.back());
    grid = measured.ground->texels->grid();
    voxels = measured.ground->texels->levels.front().texel->size();
    points = measured.ground->texels->points;
  }
  const bool coarse = quality == bake::Quality::Coarse;
  Row row;
  row.method = "curve_preview";
  row.timeMs = spreadOf(total);
  row.ratio = (coarse ? kCurveCoarseLimitMs : kCurveFullLimitMs) / row.timeMs->median;
  row.against = coarse ? "limit of 100 ms, over the time" : "limit of 3 s, over the time";
  row.numbersAndNames = {{"quality", "\"" + std::string(bake::qualityName(quality)) + "\""},
                         {"project", "\"" + project.name + "\""},
                         {"width", std::to_string(kWidth)},
                         {"height", std::to_string(kHeight)},
                         {"columns", std::to_string(grid.columns)},
                         {"layers", std::to_string(grid.layers)},
                         {"points", std::to_string(points)},
                         {"voxels", std::to_string(voxels)},
                         {"bake_ms", rounded(spreadOf(bake).median)},
                         {"light_and_upload_ms", rounded(spreadOf(light).median)},
                         {"draw_ms", rounded(spreadOf(draw).median)}};
  row.notes =
      "a moved point of the curves of water and chlorophyll: points posed and splatted, levels and skylight made, lit, "
      "uploaded, and drawn at half resolution with one sample, as while an author edits";
  return row;
}

}  // namespace

Result<std::vector<Row>> curvePreviewRows(const SpeedInput& input, const JobContext& job) {
  std::vector<project::Project> projects{sparseAutumn(input.project)};
  projects.front().name = "hundred blades";
  if (bake::drawnAsTexels(input.project)) projects.push_back(input.project);
  std::vector<Row> rows;
  for (const project::Project& project : projects) {
    SWARD_ASSIGN(Preview preview, Preview::create(input.context, project, job));
    for (const bake::Quality quality : {bake::Quality::Coarse, bake::Quality::Full}) {
      SWARD_ASSIGN(Row row, measureCurve(preview, project, quality, input.quick ? 3 : 7));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace sward::report
