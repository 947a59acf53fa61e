#include "render/renderer.h"

#include "gpu/objects.h"
#include "render/ground_pass.h"
#include "render/macro_map.h"
#include "render/pass_view.h"
#include "render/programs.h"
#include "render/relit_ground.h"
#include "render/sky_map.h"
#include "render/texel_pass.h"
#include "render/texel_set.h"
#include "render/terrain_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace sward::render {
namespace {

constexpr int kMaxSide = 16384;  ///< of a picture: what every OpenGL 4.5 driver can draw into
constexpr double kMetresPerKilometre = 1000.0;

lpt::Illumination illuminationOf(const scene::Daylight& daylight) {
  return {daylight.sunDirection(), daylight.sunIrradiance(), daylight.meanSkyRadiance()};
}

Result<void> checkFrame(const Frame& frame) {
  if (frame.width < 1 || frame.height < 1 || frame.width > kMaxSide || frame.height > kMaxSide)
    return Error::badInput("a picture of " + std::to_string(frame.width) + " x " + std::to_string(frame.height) +
                               " pixels cannot be drawn",
                           "size", "Each side may be 1 to " + std::to_string(kMaxSide) + ".");
  if (frame.options.samples < 1) return Error::badInput("there are no samples", "samples", "Give 1 or more.");
  const scene::Camera& camera = frame.camera;
  const double sum = camera.position.x + camera.position.y + camera.position.z + camera.forward.x + camera.forward.y +
                     camera.forward.z + camera.tanHalfWidth + frame.exposure;
  if (!std::isfinite(sum) || !(camera.tanHalfWidth > 0.0))
    return Error::badInput("the camera or the exposure is not a number", "view", "Mend the view's values.");
  return {};
}

}  // namespace

struct Drawing::Impl {
  Frame frame;
  BlockPlan plan;
  TerrainMesh mesh;  ///< where there is a terrain
  gpu::Texture target;
  gpu::Framebuffer framebuffer;
  Legend legend;  ///< of the frame's mode
  int drawn = 0;
  std::uint64_t revision = 0;  ///< of the renderer's ground and light when it was begun

  /// From the sum of weighted samples to their mean: exactly 1 once all are drawn.
  float gain() const { return static_cast<float>(frame.options.samples) / static_cast<float>(std::max(drawn, 1)); }

  /// RGBA, rows from the bottom, as the driver holds it: any other order makes drivers convert pixel by pixel. The
  /// result lives in `pixels`.
  std::span<const float> read(std::vector<float>& pixels) const {
    const std::size_t count = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height) * 4;
    if (pixels.size() < count) pixels.resize(count);
    gpu::gl().PixelStorei(GL_PACK_ALIGNMENT, 4);
    gpu::gl().GetTextureImage(target.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(count * sizeof(float)),
                              pixels.data());
    return std::span(pixels).first(count);
  }
};

Drawing::Drawing() : m_impl(std::make_unique<Impl>()) {}
Drawing::~Drawing() = default;
Drawing::Drawing(Drawing&&) noexcept = default;
Drawing& Drawing::operator=(Drawing&&) noexcept = default;

int Drawing::width() const {
  return m_impl->frame.width;
}
int Drawing::height() const {
  return m_impl->frame.height;
}
int Drawing::samples() const {
  return m_impl->drawn;
}
bool Drawing::complete() const {
  return m_impl->drawn >= m_impl->frame.options.samples;
}

struct Renderer::Impl {
  explicit Impl(gpu::Context& c) : context(c) {}

  gpu::Context& context;
  ProgramCache programs;
  GroundPass pass;
  gpu::Buffer mapWords, horizonValues;
  gpu::Texture map, sky, horizon;
  std::optional<MacroSettings> macro;  ///< what mapWords was made with
  Drawing whole;                       ///< of drawLinear and its like
  std::vector<float> pixels;           ///< what was read last: large, and asked for again and again
  std::shared_ptr<const bake::GroundBake> ground;
  std::optional<RelitGround> relit;
  TexelPass texelPass;
  std::optional<TexelSet> texels;
  bool texelsLit = false;
  std::stop_token stop;
  std::shared_ptr<const terrain::HeightField> field;
  std::optional<TerrainPass> terrain;  ///< of the field, where there is one
  std::optional<scene::Daylight> daylight;
  double hazeKm = 0.0;
  std::uint64_t revision = 1;  ///< of ground and light

  Result<void> ready(GroundMethod method = GroundMethod::March) {
    SWARD_TRY(context.makeCurrent());
    const bool drawsTexels = method == GroundMethod::Texels;
    if (drawsTexels && !texels) return Error::failed("no texels were given to the renderer", "render");
    if (!drawsTexels && !relit) return Error::failed("no ground was given to the renderer", "render");
    if (!daylight) return Error::failed("no daylight was given to the renderer", "render");
    return {};
  }

  Result<void> readable(const Drawing::Impl& drawing) {
    if (drawing.drawn < 1) return Error::failed("nothing is drawn yet", "render");
    return context.makeCurrent();
  }

  Result<void> makeTarget(Drawing::Impl& drawing) {
    const int width = drawing.frame.width, height = drawing.frame.height;
    if (drawing.target.width() == width && drawing.target.height() == height) return {};
    drawing.target = gpu::Texture::make2d(GL_RGBA32F, width, height);
    drawing.framebuffer = gpu::Framebuffer(drawing.target);
    SWARD_TRY(context.checkErrors("framebuffer"));
    if (!drawing.framebuffer.complete()) return Error::failed("the driver cannot draw into floats", "framebuffer");
    return {};
  }

  void makeMap(const RenderOptions& options) {
    const MacroSettings settings{options.macroVariation, options.macroScaleM};
    if (macro == settings) return;
    // A ground that is edited keeps its map, which takes longer to colour than a coarse ground to draw.
    const bool same = mapWords.size() > 0 && madeSettings == settings && madeSideM == ground->tileSideM() &&
                      madeMap.width == ground->map.width && madeMap.tiles == ground->map.tiles;
    macro = settings;
    if (same) return;
    madeSettings = settings;
    madeSideM = ground->tileSideM();
    madeMap = ground->map;
    const auto words = makeMacroMap(ground->map, ground->tileSideM(), settings);
    mapWords = gpu::Buffer(std::as_bytes(std::span(words)));
    map = gpu::Texture::ofBuffer(GL_R32UI, mapWords);
  }
  MacroSettings madeSettings;  ///< that mapWords holds, for
  tiles::TileMap madeMap;      ///< this map and
  double madeSideM = 0.0;      ///< tiles of this size

  PassInput input(const Drawing::Impl& drawing) {
    return {ground.get(),
            relit ? &*relit : nullptr,
            &map,
            &sky,
            &horizon,
            daylight->sunDirection(),
            daylight->sunIrradiance(),
            hazePerM(),
            daylight->meanSkyRadiance(),
            terrain ? &*terrain : nullptr,
            &drawing.mesh};
  }

  Result<void> setTexels(std::shared_ptr<const bake::GroundBake> bake) {
    SWARD_ASSIGN(TexelSet set, TexelSet::create(bake->texels));
    SWARD_TRY(context.checkErrors("uploading the texels"));
    texels = std::move(set);
    texelsLit = false;
    ground = std::move(bake);
    macro.reset();
    ++revision;
    return {};
  }

  Result<void> lightTexels() {
    if (texelsLit) return {};
    const wither::TexelLight light{daylight->sunDirection(), daylight->sunIrradiance(), daylight->meanSkyRadiance()};
    SWARD_TRY(texels->relight(light, {stop, {}, 0}));
    texelsLit = true;
    return context.checkErrors("lighting the texels");
  }

  static void clear(const Drawing::Impl& drawing) {
    constexpr float kBlack[4] = {};
    gpu::gl().ClearNamedFramebufferfv(drawing.framebuffer.name(), GL_COLOR, 0, kBlack);
  }

  Result<void> beginTexels(Drawing::Impl& drawing) {
    if (!drawing.frame.mode.plain()) {
      return Error::badInput("texels have no view modes", "render.method", "Draw the plain picture, or the layers.");
    }
    drawing.mesh = terrain ? terrain->plan(drawing.frame, shellM(), hazePerM()) : TerrainMesh();
    SWARD_TRY(lightTexels());
    makeMap(drawing.frame.options);
    clear(drawing);
    drawing.drawn = 0;
    drawing.revision = revision;
    return {};
  }

  double hazePerM() const { return hazeKm > 0.0 ? 1.0 / (hazeKm * kMetresPerKilometre) : 0.0; }
  double shellM() const { return std::max(ground->heightM, 1e-4); }

  Result<void> begin(Drawing::Impl& drawing, const Frame& frame) {
    SWARD_TRY(checkFrame(frame));
    SWARD_TRY(ready(frame.options.method));
    drawing.drawn = frame.options.samples;  // nothing more to draw, should the rest fail
    drawing.frame = frame;
    SWARD_TRY(makeTarget(drawing));
    if (frame.options.method == GroundMethod::Texels) return beginTexels(drawing);
    drawing.mesh = terrain ? terrain->plan(frame, shellM(), hazePerM()) : TerrainMesh();
    drawing.plan =
        terrain ? planTerrainBlocks(frame, relit->hasBlades()) : planBlocks(frame, *ground, relit->hasBlades());
    SWARD_TRY(relit->setMode(frame.mode, *ground));
    SWARD_TRY(relit->relight(programs, drawing.plan.sets));
    makeMap(frame.options);
    if (frame.options.samples > 1 || frame.columns || !frame.mode.plain()) clear(drawing);
    drawing.legend = legendOf(frame.mode, *ground);
    drawing.drawn = 0;
    drawing.revision = revision;
    return context.checkErrors("relighting");
  }

  Result<void> addSample(Drawing::Impl& drawing) {
    const int samples = drawing.frame.options.samples;
    if (drawing.drawn >= samples) return Error::failed("all samples are drawn", "render");
    if (drawing.revision != revision) return Error::failed("ground or light changed within a picture", "render");
    const bool drawsTexels = drawing.frame.options.method == GroundMethod::Texels;
    SWARD_TRY(ready(drawing.frame.options.method));
    const Columns columns = drawing.frame.drawn();
    if (!drawsTexels) {
      // Another picture may have been begun in between, in another mode.
      SWARD_TRY(relit->setMode(drawing.frame.mode, *ground));
      SWARD_TRY(relit->relight(programs, drawing.plan.sets));
    }
    if (terrain) {
      SWARD_TRY(terrain->drawEntries(programs, drawing.frame, drawing.mesh, shellM(),
                                     sampleOffset(drawing.frame, drawing.drawn)));
    }
    drawing.framebuffer.bind();
    if (samples > 1) {
      gpu::gl().BlendFunc(GL_ONE, GL_ONE);
      gpu::gl().Enable(GL_BLEND);
    }
    if (drawing.frame.columns) {
      gpu::gl().Scissor(columns.begin, 0, columns.end - columns.begin, drawing.frame.height);
      gpu::gl().Enable(GL_SCISSOR_TEST);
    }
    const double weight = 1.0 / samples;
    Result<void> drawn = drawsTexels
                             ? texelPass.draw(programs, *texels, input(drawing), drawing.frame, drawing.drawn, weight)
                             : pass.draw(programs, input(drawing), drawing.frame, drawing.plan, drawing.drawn, weight);
    gpu::gl().Disable(GL_BLEND);
    gpu::gl().Disable(GL_SCISSOR_TEST);
    SWARD_TRY(std::move(drawn));
    ++drawing.drawn;
    return context.checkErrors("drawing");
  }

  Result<void> drawAll(const Frame& frame) {
    SWARD_TRY(begin(*whole.m_impl, frame));
    while (!whole.complete()) SWARD_TRY(addSample(*whole.m_impl));
    return {};
  }
};

Renderer::Renderer() = default;

Renderer::~Renderer() {
  // Objects are deleted on their own context.
  if (m_impl) (void)m_impl->context.makeCurrent();
}

Result<std::unique_ptr<Renderer>> Renderer::create(gpu::Context& context) {
  SWARD_TRY(context.makeCurrent());
  std::unique_ptr<Renderer> renderer(new Renderer());
  renderer->m_impl = std::make_unique<Impl>(context);
  renderer->m_impl->pass = GroundPass::create();
  renderer->m_impl->texelPass = TexelPass::create();
  SWARD_TRY(context.checkErrors("renderer"));
  return renderer;
}

Result<void> Renderer::setGround(std::shared_ptr<const bake::GroundBake> ground) {
  Impl& impl = *m_impl;
  SWARD_TRY(impl.context.makeCurrent());
  if (!ground) return Error::failed("there is no ground", "render");
  impl.relit.reset();
  impl.texels.reset();
  if (ground->texels) return impl.setTexels(std::move(ground));
  SWARD_ASSIGN(RelitGround relit, RelitGround::create(*ground));
  impl.macro.reset();
  ++impl.revision;
  SWARD_TRY(impl.context.checkErrors("uploading the ground"));
  impl.ground = std::move(ground);
  impl.relit = std::move(relit);
  if (impl.daylight) impl.relit->setIllumination(illuminationOf(*impl.daylight));
  return {};
}

Result<void> Renderer::setTerrain(std::shared_ptr<const terrain::HeightField> field) {
  Impl& impl = *m_impl;
  SWARD_TRY(impl.context.makeCurrent());
  if (field == impl.field) return {};
  impl.terrain.reset();
  impl.field = field;
  ++impl.revision;
  if (!field) return {};
  SWARD_ASSIGN(impl.terrain, TerrainPass::create(std::move(field)));
  if (impl.daylight) impl.terrain->setSun(impl.daylight->sunDirection());
  return impl.context.checkErrors("uploading the terrain");
}

Result<void> Renderer::setInspection(const bake::Inspection& inspection) {
  Impl& impl = *m_impl;
  SWARD_TRY(impl.context.makeCurrent());
  if (!impl.relit) return Error::failed("no ground was given to the renderer", "render");
  SWARD_TRY(impl.relit->setInspection(inspection));
  ++impl.revision;
  return impl.context.checkErrors("uploading the inspection");
}

void Renderer::setDaylight(const scene::Daylight& daylight, double hazeKm) {
  Impl& impl = *m_impl;
  if (!impl.context.makeCurrent().ok()) return;
  impl.daylight = daylight;
  ++impl.revision;
  impl.hazeKm = hazeKm;
  impl.sky = makeSkyTexture(daylight);
  impl.horizonValues = makeHorizonBuffer(daylight);
  impl.horizon = gpu::Texture::ofBuffer(GL_RGBA32F, impl.horizonValues);
  impl.texelsLit = false;
  if (impl.relit) impl.relit->setIllumination(illuminationOf(daylight));
  if (impl.terrain) impl.terrain->setSun(daylight.sunDirection());
}

void Renderer::setStop(std::stop_token stop) {
  m_impl->stop = std::move(stop);
}

Result<void> Renderer::begin(Drawing& drawing, const Frame& frame) {
  return m_impl->begin(*drawing.m_impl, frame);
}

Result<void> Renderer::addSample(Drawing& drawing) {
  return m_impl->addSample(*drawing.m_impl);
}

Result<image::Image> Renderer::readLinear(const Drawing& drawing) {
  SWARD_TRY(m_impl->readable(*drawing.m_impl));
  const std::span<const float> rgba = drawing.m_impl->read(m_impl->pixels);
  const float gain = drawing.m_impl->gain();
  image::Image out(drawing.width(), drawing.height(), 3);
  const auto row = static_cast<std::size_t>(out.width);
  for (int y = 0; y < out.height; ++y) {
    const float* from = rgba.data() + static_cast<std::size_t>(out.height - 1 - y) * row * 4;
    float* to = out.pixels.data() + out.offset(0, y);
    for (std::size_t x = 0; x < row; ++x)
      for (std::size_t c = 0; c < 3; ++c) to[3 * x + c] = from[4 * x + c] * gain;
  }
  return out;
}

Result<image::Image> Renderer::readDisplay(const Drawing& drawing) {
  const Frame& frame = drawing.m_impl->frame;
  if (frame.mode.plain()) {
    SWARD_ASSIGN(const image::Image linear, readLinear(drawing));
    return toDisplay(linear, frame.options.viewTransform);
  }
  image::ByteImage bytes;
  SWARD_TRY(readBytes(drawing, bytes));
  image::Image out(bytes.width, bytes.height, 3);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = static_cast<float>(bytes.rgba[i / 3 * 4 + i % 3]) / 255.0f;
  return out;
}

Result<void> Renderer::readBytes(const Drawing& drawing, image::ByteImage& out) {
  SWARD_TRY(m_impl->readable(*drawing.m_impl));
  const Drawing::Impl& impl = *drawing.m_impl;
  const std::span<const float> rgba = impl.read(m_impl->pixels);
  if (out.width != impl.frame.width || out.height != impl.frame.height)
    out = {impl.frame.width, impl.frame.height, std::vector<std::uint8_t>(rgba.size())};
  const DisplayLook look{impl.frame.options.viewTransform, impl.frame.mode, impl.legend};
  toDisplayBytes(rgba, impl.gain(), look, impl.frame.drawn(), out);
  return {};
}

Result<void> Renderer::finish() {
  SWARD_TRY(m_impl->context.makeCurrent());
  gpu::gl().Finish();
  return m_impl->context.checkErrors("drawing");
}

Result<image::Image> Renderer::drawLinear(const Frame& frame) {
  SWARD_TRY(m_impl->drawAll(frame));
  return readLinear(m_impl->whole);
}

Result<image::Image> Renderer::drawDisplay(const Frame& frame) {
  SWARD_TRY(m_impl->drawAll(frame));
  return readDisplay(m_impl->whole);
}

Result<void> Renderer::drawOnly(const Frame& frame) {
  Frame single = frame;
  single.options.samples = 1;
  SWARD_TRY(m_impl->drawAll(single));
  gpu::gl().Finish();
  return {};
}

Result<void> Renderer::relight(const scene::Daylight& daylight, bool tilesOnly) {
  Impl& impl = *m_impl;
  impl.daylight = daylight;
  ++impl.revision;
  SWARD_TRY(impl.ready());
  impl.relit->setIllumination(illuminationOf(daylight));
  impl.relit->invalidate();
  SWARD_TRY(impl.relit->relight(impl.programs, tilesOnly ? SetMask(1) : SetMask().set()));
  gpu::gl().Finish();
  return impl.context.checkErrors("relighting");
}

Result<std::vector<glm::vec4>> Renderer::readRelitSlices(int tile, int layer, int mip) {
  Impl& impl = *m_impl;
  SWARD_TRY(impl.ready());
  const SetLayout& layout = impl.relit->layout(kSliceSet);
  if (tile < 0 || tile >= layout.images || layer < 0 || layer >= layout.layers || mip < 0 || mip > layout.maxLevel)
    return Error::badInput("there is no such relit texel", "readRelitSlices");
  SWARD_TRY(impl.relit->relight(impl.programs, SetMask(1)));
  return impl.relit->readPlane(kSliceSet, tile * layout.layers + layer, mip);
}

double Renderer::relightScale() const {
  return m_impl->relit ? m_impl->relit->scale() : 1.0;
}

}  // namespace sward::render
