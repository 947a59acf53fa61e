#include "report/section_texel_render.h"

#include "bake/bake.h"
#include "bake/withering.h"
#include "render/frame_plan.h"
#include "render/renderer.h"
#include "report/picture_row.h"
#include "report/speed_views.h"
#include "report/texel_causes.h"
#include "report/texel_suns.h"
#include "report/texel_truth.h"
#include "report/text.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace sward::report {
namespace {

TexelRenderSizes quickSizes() {
  TexelRenderSizes sizes;
  sizes.width = 160;
  sizes.height = 90;
  sizes.samples = 8;
  sizes.causeSamples = 2;
  sizes.runs = 3;
  sizes.columns = {64, 32};
  sizes.weatherings = {0.0};
  sizes.views = {"45"};
  sizes.causes = false;
  return sizes;
}

/// One way to draw, ready to: a level of texels, or the layers.
struct Drawer {
  std::string method, levels;  ///< levels: columns of the finest, or "layers"
  std::unique_ptr<render::Renderer> renderer;
  std::shared_ptr<const bake::GroundBake> ground;
  double relightMs = 0.0;
};

/// All that one weathering degree is measured with.
struct Degree {
  const SectionInput& input;
  const TexelRenderSizes& sizes;
  project::Project texels, layers;  ///< the project, drawn so, at the degree
  scene::Daylight daylight;
  std::shared_ptr<const bake::GroundBake> texelGround, layerGround;
  GroundTruth texelTruth, layerTruth;
};

std::string degreeName(double weathering) {
  return "w" + std::to_string(std::lround(100.0 * weathering));
}

Result<render::Frame> frameOf(const Degree& degree, const SpeedView& view) {
  SWARD_ASSIGN(render::Frame frame, render::planFrame(degree.texels, viewOf(view), degree.daylight));
  frame.width = degree.sizes.width;
  frame.height = degree.sizes.height;
  // As in section grassland.
  frame.options.macroVariation = 0.0;
  frame.options.gridBendM = 0.0;
  return frame;
}

render::Frame drawnBy(const Drawer& drawer, render::Frame frame) {
  frame.options.method = drawer.ground->texels ? render::GroundMethod::Texels : render::GroundMethod::March;
  return frame;
}

Result<Degree> makeDegree(const SectionInput& input, const TexelRenderSizes& sizes, double weathering,
                          bake::Baker& baker, const JobContext& job) {
  project::Project texels = input.project;
  texels.wither.weathering = weathering;
  texels.wither.texel.resolution = sizes.columns.front();
  project::Project layers = texels;
  texels.render.method = render::GroundMethod::Texels;
  layers.render.method = render::GroundMethod::March;
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(texels));
  SWARD_ASSIGN(auto texelGround, baker.ground(texels, job));
  SWARD_ASSIGN(auto layerGround, baker.ground(layers, job));
  SWARD_ASSIGN(scene::Patch blades, witheredBlades(texels));
  SWARD_ASSIGN(GroundTruth texelTruth, GroundTruth::create(texels, *texelGround, std::move(blades), daylight, job));
  SWARD_ASSIGN(GroundTruth layerTruth, GroundTruth::create(layers, *layerGround, daylight, job));
  return Degree{input,
                sizes,
                std::move(texels),
                std::move(layers),
                daylight,
                std::move(texelGround),
                std::move(layerGround),
                std::move(texelTruth),
                std::move(layerTruth)};
}

/// Uploads a ground and lights it, which is timed.
Result<Drawer> makeDrawer(const Degree& degree, const std::string& method, const std::string& levels,
                          std::shared_ptr<const bake::GroundBake> ground, const render::Frame& frame,
                          const JobContext& job) {
  Drawer drawer{method, levels, nullptr, std::move(ground), 0.0};
  SWARD_ASSIGN(drawer.renderer, render::Renderer::create(degree.input.context));
  drawer.renderer->setStop(job.stop);
  SWARD_TRY(drawer.renderer->setGround(drawer.ground));
  drawer.renderer->setDaylight(degree.daylight, degree.input.project.sky.hazeKm);
  SWARD_TRY(drawer.renderer->finish());
  const auto start = std::chrono::steady_clock::now();
  if (drawer.ground->texels) {
    render::Drawing drawing;
    SWARD_TRY(drawer.renderer->begin(drawing, drawnBy(drawer, frame)));
    SWARD_TRY(drawer.renderer->finish());
  } else {
    SWARD_TRY(drawer.renderer->relight(degree.daylight, false));
  }
  drawer.relightMs = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return drawer;
}

Result<std::vector<Drawer>> makeDrawers(const Degree& degree, const JobContext& job) {
  SWARD_ASSIGN(const render::Frame frame, frameOf(degree, {"45", 45.0, kNearM}));
  std::vector<Drawer> drawers;
  SWARD_ASSIGN(Drawer layers, makeDrawer(degree, "march", quotedText("layers"), degree.layerGround, frame, job));
  drawers.push_back(std::move(layers));
  for (const int columns : degree.sizes.columns) {
    auto ground = coarserGround(degree.texelGround, columns);
    if (!ground) continue;
    SWARD_ASSIGN(Drawer level, makeDrawer(degree, "texels", std::to_string(columns), std::move(ground), frame, job));
    drawers.push_back(std::move(level));
  }
  return drawers;
}

double meanOf(const image::Image& image) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += double{value};
  return sum / static_cast<double>(std::max<std::size_t>(image.pixels.size(), 1));
}

/// Which picture a row is of.
void addPlace(const Degree& degree, const SpeedView& view, const std::string& levels, const render::Frame& frame,
              Row& row) {
  row.numbersAndNames["view"] = quotedText(view.name);
  row.numbersAndNames["weathering"] = numberText(degree.texels.wither.weathering);
  row.numbersAndNames["levels"] = levels;
  row.numbersAndNames["width"] = std::to_string(frame.width);
  row.numbersAndNames["height"] = std::to_string(frame.height);
}

void addNumbers(const Degree& degree, const SpeedView& view, const Drawer& drawer, const PictureReference& reference,
                Row& row) {
  const double mean = meanOf(reference.picture.linear);
  row.numbersAndNames.merge(
      std::map<std::string, std::string>{{"view", quotedText(view.name)},
                                         {"weathering", numberText(degree.texels.wither.weathering)},
                                         {"levels", drawer.levels},
                                         {"slant_deg", numberText(view.slantDeg)},
                                         {"width", std::to_string(degree.sizes.width)},
                                         {"height", std::to_string(degree.sizes.height)},
                                         {"samples", std::to_string(degree.texels.render.samples)},
                                         {"reference_samples", std::to_string(degree.sizes.samples)},
                                         {"relight_ms", numberText(drawer.relightMs)},
                                         {"reference_mean", numberText(mean)},
                                         {"relative_bias", numberText(mean > 0.0 ? row.error.at("bias") / mean : 0.0)},
                                         {"device", quotedText(degree.input.context.info().renderer)}});
  if (drawer.ground->texels) {
    const TexelBytes bytes = bytesOf(*drawer.ground->texels);
    row.bytes = bytes.sky;
    row.bytesTotal = bytes.total;
    row.numbersAndNames["voxels"] = std::to_string(drawer.ground->texels->levels.front().texel->size());
    return;
  }
  std::uint64_t light = 0, total = 0;
  const auto add = [&](const lpt::LayerStack& stack) {
    light += stack.lightingBytes();
    total += stack.totalBytes();
  };
  add(drawer.ground->slices);
  add(drawer.ground->soil);
  for (const lpt::LayerStack& stack : drawer.ground->blades) add(stack);
  row.bytes = light;
  row.bytesTotal = total;
}

/// Draws, compares and, but for the layers', times one drawer in turn with the layers.
Result<Row> drawnRow(const Degree& degree, const SpeedView& view, const render::Frame& frame, const Drawer& drawer,
                     const Drawer& layers, const PictureReference& reference, Strip& strip, const JobContext& job) {
  const render::Frame drawn = drawnBy(drawer, frame);
  SWARD_ASSIGN(image::Image linear, drawer.renderer->drawLinear(drawn));
  const std::string level = drawer.ground->texels ? "_" + drawer.levels : "";
  const std::string name =
      "texel_render_" + degreeName(degree.texels.wither.weathering) + "_" + view.name + "_" + drawer.method + level;
  SWARD_ASSIGN(Row row, pictureRow({drawer.method, name, std::move(linear)}, reference, frame.options.viewTransform,
                                   strip, job));
  if (!level.empty()) {
    // Both pictures of the strip say which level they are.
    for (std::size_t i = strip.pictures.size() - 2; i < strip.pictures.size(); ++i) {
      std::string& caption = strip.pictures[i].caption;
      caption.insert(drawer.method.size(), " of " + drawer.levels + " columns");
    }
  }
  addNumbers(degree, view, drawer, reference, row);
  Result<void> outcome;
  const auto draw = [&](const Drawer& by) {
    if (outcome.ok()) outcome = by.renderer->drawOnly(drawnBy(by, frame));
  };
  const auto [time, other] = timePairs(
      degree.sizes.runs, [&] { draw(drawer); }, [&] { draw(layers); });
  SWARD_TRY(std::move(outcome));
  row.timeMs = time;
  if (&drawer != &layers) {
    row.ratio = other.median / time.median;
    row.numbersAndNames["march_ms"] = numberText(other.median);
    row.against = "the march of the layers, same view and degree, in turn";
  }
  row.notes = drawer.ground->texels ? "voxels marched front to back; levels of at most so many columns"
                                    : "layers of the same project at the same degree";
  return row;
}

Result<void> addView(const Degree& degree, const SpeedView& view, const std::vector<Drawer>& drawers, Section& section,
                     const JobContext& job) {
  SWARD_ASSIGN(const render::Frame frame, frameOf(degree, view));
  const std::string start = "texel_render_" + degreeName(degree.texels.wither.weathering) + "_" + view.name;
  SWARD_ASSIGN(const PictureReference blades,
               pictureReference(degree.texelTruth, frame, start + "_reference", degree.sizes.samples, job));
  SWARD_ASSIGN(const PictureReference layers,
               pictureReference(degree.layerTruth, frame, start + "_layers_reference", degree.sizes.samples, job));
  Strip strip{"View " + view.name + " at weathering " + numberText(degree.texels.wither.weathering), {}};
  strip.pictures.push_back(pictureOf(blades, "reference of texels: each blade has withered in its own way"));
  for (std::size_t i = 1; i <= drawers.size(); ++i) {
    const Drawer& drawer = drawers[i % drawers.size()];
    const bool texels = drawer.ground->texels != nullptr;
    if (!texels) strip.pictures.push_back(pictureOf(layers, "reference of the layers: models wither, and repeat"));
    SWARD_ASSIGN(Row row, drawnRow(degree, view, frame, drawer, drawers.front(), texels ? blades : layers, strip, job));
    section.rows.push_back(std::move(row));
  }
  section.strips.push_back(std::move(strip));
  return {};
}

Result<void> addCauses(const Degree& degree, const std::vector<SpeedView>& views, const Drawer& finest,
                       Section& section, const JobContext& job) {
  std::vector<render::Frame> frames;
  for (const SpeedView& view : views) {
    SWARD_ASSIGN(render::Frame frame, frameOf(degree, view));
    frame.width /= 2;
    frame.height /= 2;
    frames.push_back(drawnBy(finest, frame));
  }
  SWARD_ASSIGN(const TexelCauseGrounds grounds, texelCauseGrounds(degree.texels, finest.ground, job));
  const TexelCauseInput input{*finest.renderer, degree.texelTruth, grounds, frames, degree.sizes.causeSamples};
  SWARD_ASSIGN(std::vector<std::vector<Row>> all, texelCauseRows(input, job));
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (Row& row : all[i]) {
      addPlace(degree, views[i], finest.levels, frames[i], row);
      section.rows.push_back(std::move(row));
    }
  }
  return {};
}

/// The sun moved round the eye, for texels and layers.
Result<void> addSuns(Degree& degree, const Drawer& layers, const Drawer& finest, Section& section,
                     const JobContext& job) {
  const SpeedView view{"45", 45.0, kNearM};
  SWARD_ASSIGN(render::Frame frame, frameOf(degree, view));
  frame.width /= 2;
  frame.height /= 2;
  const SunInput input{degree.texels, degree.daylight, degree.sizes.samples};
  Plot plot;
  plot.name = "texel_render_sun";
  plot.title = "Texels and layers: where the sun stands";
  plot.xLabel = "angle between eye and sun, from the ground, degrees";
  plot.yLabel = "bias over the reference's mean";
  plot.caption =
      "0 degrees: the sun in the eye's back, on leaves that hide their own shadows; beyond 90 light comes through "
      "them. "
      "A level line at 0 is right.";
  for (const Drawer* drawer : {&finest, &layers}) {
    GroundTruth& truth = drawer == &layers ? degree.layerTruth : degree.texelTruth;
    SWARD_ASSIGN(std::vector<Row> rows,
                 sunRows(input, {drawer->method, *drawer->renderer, truth, drawnBy(*drawer, frame)}, job));
    Plot::Series series{drawer->method, {}, true};
    for (Row& row : rows) {
      series.points.push_back(
          {std::stod(row.numbersAndNames.at("phase_deg")), std::stod(row.numbersAndNames.at("relative_bias")), ""});
      addPlace(degree, view, drawer->levels, frame, row);
      section.rows.push_back(std::move(row));
    }
    plot.series.push_back(std::move(series));
  }
  section.plots.push_back(std::move(plot));
  return {};
}

/// Time against error, a series a way to draw, a point a view and degree.
Plot paretoOf(const std::vector<Row>& rows) {
  Plot plot;
  plot.name = "texel_render_time_error";
  plot.title = "Texels and layers: time of a frame against its error";
  plot.xLabel = "time of a frame (ms)";
  plot.yLabel = "RMSE, linear, noise taken off";
  plot.caption = "One point a view angle and weathering degree, each against its own reference; lower left is better.";
  plot.logX = plot.pareto = true;
  for (const Row& row : rows) {
    if (!row.timeMs) continue;
    const std::string& levels = row.numbersAndNames.at("levels");
    const std::string name = row.method == "march" ? row.method : row.method + " " + levels;
    auto series = std::find_if(plot.series.begin(), plot.series.end(), [&](const auto& s) { return s.name == name; });
    if (series == plot.series.end()) series = plot.series.insert(series, {name, {}, false});
    const std::string& view = row.numbersAndNames.at("view");
    series->points.push_back({row.timeMs->median, std::stod(row.numbersAndNames.at("rmse_without_noise")),
                              view.substr(1, view.size() - 2) + " at " + row.numbersAndNames.at("weathering")});
  }
  return plot;
}

constexpr const char* kSummary =
    "Texels that age, drawn as voxels, against the blades that they stand for: every blade withered as a mesh of its "
    "own and ray-traced, on level ground under the same sun, sky and haze. Beside them the layers of the same project "
    "at the same weathering degree; their bake withers a few models of each plant, so they have a reference of their "
    "own. Errors as in section grassland. Levels: columns of the finest voxels that are drawn; farther away coarser "
    "ones are.\n\n"
    "Rows cause_... say what single steps cost, at half the size: light as texels get it (a point for the sun, an even "
    "sky), light between leaves, which no drawn picture has, points instead of the blades' own voxels, the highlight "
    "that the reference's dull leaves lack. voxels is the picture against the reference in the texels' own light. They "
    "do not add up, since errors of different steps also cancel.";

std::vector<SpeedView> viewsOf(const std::vector<std::string>& names, double sideM) {
  std::vector<SpeedView> views{{"down", 90.0, kNearM}, {"45", 45.0, kNearM}, grazingView(sideM)};
  std::erase_if(views,
                [&](const SpeedView& view) { return std::find(names.begin(), names.end(), view.name) == names.end(); });
  return views;
}

}  // namespace

Result<Section> texelRenderSection(const SectionInput& input, const JobContext& job) {
  const project::Project project = groundProject(input.project, input.quick);
  const SectionInput drawn{project, input.context, input.cacheFolder, input.quick};
  return measureTexelRender(drawn, input.quick ? quickSizes() : TexelRenderSizes{}, job);
}

Result<Section> measureTexelRender(const SectionInput& input, const TexelRenderSizes& sizes, const JobContext& job) {
  const JobContext quiet{job.stop, {}, job.threads};
  SWARD_ASSIGN(bake::DiskCache cache, bake::DiskCache::open(input.cacheFolder));
  bake::Baker baker(std::move(cache));
  Section section;
  section.name = "texel_render";
  section.title = "Texels, drawn";
  section.summary = kSummary;
  const std::vector<double> degrees =
      bake::withers(input.project) ? std::vector<double>{input.project.wither.weathering} : sizes.weatherings;
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const auto step = [&](const std::string& name, double part) {
      const double done = (static_cast<double>(i) + part) / static_cast<double>(degrees.size());
      if (job.onProgress) job.onProgress("weathering " + numberText(degrees[i]) + ", " + name, done);
    };
    step("bake", 0.0);
    SWARD_ASSIGN(Degree degree, makeDegree(input, sizes, degrees[i], baker, quiet));
    step("light", 0.3);
    SWARD_ASSIGN(const std::vector<Drawer> drawers, makeDrawers(degree, quiet));
    const bool last = i + 1 == degrees.size();
    const std::vector<SpeedView> views =
        viewsOf(last ? sizes.views : sizes.otherViews, degree.layerGround->tileSideM());
    double done = 0.4;
    for (const SpeedView& view : views) {
      step("view " + view.name, done);
      SWARD_TRY(addView(degree, view, drawers, section, quiet));
      done += 0.3 / static_cast<double>(views.size());
    }
    if (!sizes.causes || !last || drawers.size() < 2) continue;
    step("sun", done);
    SWARD_TRY(addSuns(degree, drawers.front(), drawers[1], section, quiet));
    step("causes", done + 0.1);
    SWARD_TRY(addCauses(degree, views, drawers[1], section, quiet));
  }
  if (job.cancelled()) return Error::cancelled();
  section.plots.push_back(paretoOf(section.rows));
  return section;
}

}  // namespace sward::report
