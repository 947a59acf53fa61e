#include "report/speed_render.h"

#include "gpu/objects.h"
#include "gpu/program.h"
#include "render/renderer.h"
#include "render/shader_files.h"
#include "report/speed_views.h"
#include "report/text.h"
#include "scene/camera.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace sward::report {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kMarchLimitMs = 50.0, kRelightLimitMs = 20.0;  ///< targets of the first step
constexpr int kRuns = 9, kQuickRuns = 3;

std::optional<std::string_view> embedded(std::string_view name) {
  for (const render::ShaderFile& file : render::embeddedShaders())
    if (file.name == name) return file.text;
  return std::nullopt;
}

/// Bare loops over texels, drawn and dispatched as the renderer does.
class Yardstick {
 public:
  static Result<Yardstick> create(std::size_t texels) {
    Yardstick out;
    const std::vector<std::uint32_t> words(texels, 0x40302010u);
    out.m_texels = gpu::Buffer(std::as_bytes(std::span(words)));
    out.m_copy = gpu::Buffer(texels * 4);
    out.m_texelsView = gpu::Texture::ofBuffer(GL_R32UI, out.m_texels);
    const std::uint32_t origin = 0;
    out.m_block = gpu::Buffer(std::as_bytes(std::span(&origin, 1)));
    out.m_blockView = gpu::Texture::ofBuffer(GL_R32UI, out.m_block);
    out.m_target = gpu::Texture::make2d(GL_RGBA32F, kWidth, kHeight);
    out.m_framebuffer = gpu::Framebuffer(out.m_target);
    out.m_vertices = gpu::VertexArray::make();
    out.m_count = static_cast<int>(texels);
    SWARD_ASSIGN(out.m_fetches, gpu::Program::build(embedded, {{{GL_VERTEX_SHADER, "ground/block.vert"},
                                                                {GL_FRAGMENT_SHADER, "bench/fetches.frag"}},
                                                               {},
                                                               {"t_texels", "u_fetches", "u_side"}}));
    SWARD_ASSIGN(out.m_copier,
                 gpu::Program::build(embedded, {{{GL_COMPUTE_SHADER, "bench/copy.comp"}}, {}, {"u_count"}}));
    return out;
  }

  /// One frame of `fetches` nearest fetches a pixel, finished.
  void fetch(int fetches) {
    m_framebuffer.bind();
    gpu::gl().Viewport(0, 0, kWidth, kHeight);
    m_vertices.bind();
    m_fetches.use();
    m_texelsView.bind(0);
    m_blockView.bind(1);
    m_fetches.set("t_texels", 0);
    m_fetches.set("t_blocks", 1);
    m_fetches.set("u_firstBlock", 0);
    m_fetches.set("u_targetSize", glm::ivec2(kWidth, kHeight));
    m_fetches.set("u_blockSize", std::max(kWidth, kHeight));
    m_fetches.set("u_fetches", fetches);
    m_fetches.set("u_side", std::max(static_cast<int>(std::sqrt(m_count / std::max(fetches, 1))), 1));
    gpu::gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, 1);
    gpu::gl().Finish();
  }

  /// Copies all texels, finished.
  void copy() {
    m_copier.use();
    m_texelsView.bind(0);
    m_copier.set("t_texels", 0);
    m_copier.set("u_count", m_count);
    m_copy.bindStorage(0);
    constexpr unsigned kRow = 1024;
    gpu::gl().DispatchCompute(kRow, (static_cast<unsigned>(m_count) + 64 * kRow - 1) / (64 * kRow), 1);
    gpu::gl().MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    gpu::gl().Finish();
  }

 private:
  Yardstick() = default;
  gpu::Buffer m_texels, m_copy, m_block;
  gpu::Texture m_texelsView, m_blockView, m_target;
  gpu::Framebuffer m_framebuffer;
  gpu::VertexArray m_vertices;
  gpu::Program m_fetches, m_copier;
  int m_count = 0;
};

Result<render::Frame> frameOf(const SpeedView& view, double exposure) {
  render::Frame frame;
  SWARD_ASSIGN(frame.camera, cameraOf(view));
  frame.width = kWidth;
  frame.height = kHeight;
  frame.exposure = exposure;
  return frame;
}

Row timedRow(const std::string& method, const TimeMs& time, const TimeMs& other, const std::string& against) {
  Row row;
  row.method = method;
  row.timeMs = time;
  row.rate = 1000.0 / time.median;
  row.rateUnit = "frames";
  row.ratio = other.median / time.median;
  row.against = against;
  return row;
}

std::string limitNote(double medianMs, double limitMs) {
  return "target " + numberText(limitMs) + " ms: " + (medianMs <= limitMs ? "met" : "missed");
}

/// What all rows need.
struct Bench {
  std::unique_ptr<render::Renderer> renderer;
  std::shared_ptr<const bake::GroundBake> ground;
  scene::Daylight daylight;
  Yardstick yardstick;
  int runs;
  std::string device;
};

Result<Row> relightRow(Bench& bench) {
  Result<void> outcome;
  const auto [relit, copied] = timePairs(
      bench.runs,
      [&] {
        if (outcome.ok()) outcome = bench.renderer->relight(bench.daylight, true);
      },
      [&] { bench.yardstick.copy(); });
  SWARD_TRY(std::move(outcome));
  const lpt::LayerStack& slices = bench.ground->slices;
  Row row = timedRow("relight_tiles", relit, copied, "copying as many texels, a word each, by a bare compute shader");
  row.numbersAndNames = {
      {"tiles", std::to_string(slices.images)},  {"resolution", std::to_string(bench.ground->tiles.resolution)},
      {"layers", std::to_string(slices.layers)}, {"channels", std::to_string(slices.channels)},
      {"bits", std::to_string(slices.bits)},     {"device", '"' + bench.device + '"'}};
  row.bytes = slices.lightingBytes() + bench.ground->soil.lightingBytes();
  row.notes = "slices, soil, all mips and means; " + limitNote(relit.median, kRelightLimitMs);
  return row;
}

std::map<std::string, std::string> frameNumbers(const Bench& bench, const SpeedView& view) {
  return {{"width", std::to_string(kWidth)},
          {"height", std::to_string(kHeight)},
          {"samples", "1"},
          {"layers", std::to_string(bench.ground->slices.layers)},
          {"slant_deg", numberText(view.slantDeg)},
          {"distance_m", numberText(view.distanceM)},
          {"device", '"' + bench.device + '"'}};
}

Result<Row> marchRow(Bench& bench, const SpeedView& view) {
  SWARD_ASSIGN(const render::Frame frame, frameOf(view, bench.daylight.autoExposure()));
  const int layers = bench.ground->slices.layers;
  Result<void> outcome;
  const auto [march, fetches] = timePairs(
      bench.runs,
      [&] {
        if (outcome.ok()) outcome = bench.renderer->drawOnly(frame);
      },
      [&] { bench.yardstick.fetch(layers); });
  SWARD_TRY(std::move(outcome));
  Row row = timedRow(view.name, march, fetches,
                     "a bare loop of " + std::to_string(layers) + " nearest fetches a pixel, neither lit nor blended");
  row.numbersAndNames = frameNumbers(bench, view);
  row.notes = limitNote(march.median, kMarchLimitMs);
  return row;
}

Result<Row> blendedRow(Bench& bench, const SpeedView& view) {
  SWARD_ASSIGN(const render::Frame march, frameOf(view, bench.daylight.autoExposure()));
  render::Frame blended = march;
  blended.options.method = render::GroundMethod::BlendedNormalised;
  Result<void> outcome;
  const auto draw = [&](const render::Frame& frame) {
    if (outcome.ok()) outcome = bench.renderer->drawOnly(frame);
  };
  const auto [blendedTime, marchTime] = timePairs(
      bench.runs, [&] { draw(blended); }, [&] { draw(march); });
  SWARD_TRY(std::move(outcome));
  Row row = timedRow("blended_slices", blendedTime, marchTime, "the march of the same view, with the same filtering");
  row.numbersAndNames = frameNumbers(bench, view);
  row.numbersAndNames["march_ms"] = numberText(marchTime.median);
  row.notes = "all slices composited, no early end";
  return row;
}

}  // namespace

Result<std::vector<Row>> renderRows(gpu::Context& context, std::shared_ptr<const bake::GroundBake> ground, bool quick) {
  if (!ground) return Error::failed("there is no ground to time", "speed");
  SWARD_ASSIGN(auto renderer, render::Renderer::create(context));
  SWARD_TRY(renderer->setGround(ground));
  const scene::SunOptions sun;
  const scene::SkyOptions sky;
  const scene::Daylight daylight(scene::directionFromAngles(sun.angles), sun, sky);
  renderer->setDaylight(daylight, sky.hazeKm);
  const auto resolution = static_cast<std::size_t>(ground->tiles.resolution);
  const std::size_t relitTexels =
      ground->tiles.tiles.size() * static_cast<std::size_t>(ground->slices.layers + 1) * resolution * resolution;
  SWARD_ASSIGN(Yardstick yardstick, Yardstick::create(relitTexels));
  Bench bench{std::move(renderer),    ground, daylight, std::move(yardstick), quick ? kQuickRuns : kRuns,
              context.info().renderer};
  // So far away that the picture is as wide as the tiles.
  const double farM = kTilesInView * ground->tileSideM() * kSpeedFocalLengthMm / scene::kSensorWidthMm;
  SpeedView grazing = grazingView(ground->tileSideM());
  grazing.name = "march_grazing";
  std::vector<Row> rows;
  SWARD_ASSIGN(Row relit, relightRow(bench));
  rows.push_back(std::move(relit));
  for (const SpeedView& view : {SpeedView{"march_down", 90.0, farM}, SpeedView{"march_45", 45.0, farM}, grazing,
                                SpeedView{"march_down_near", 90.0, kNearM}, SpeedView{"march_45_near", 45.0, kNearM}}) {
    SWARD_ASSIGN(Row row, marchRow(bench, view));
    rows.push_back(std::move(row));
  }
  SWARD_ASSIGN(Row blended, blendedRow(bench, {"blended_slices", 90.0, kNearM}));
  rows.push_back(std::move(blended));
  SWARD_TRY(context.checkErrors("timing"));
  return rows;
}

}  // namespace sward::report
