#include "render/renderer.h"

#include "gpu/objects.h"
#include "render/ground_pass.h"
#include "render/macro_map.h"
#include "render/programs.h"
#include "render/relit_ground.h"
#include "render/sky_map.h"

#include <algorithm>
#include <cmath>
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

struct Renderer::Impl {
  explicit Impl(gpu::Context& c) : context(c) {}

  gpu::Context& context;
  ProgramCache programs;
  GroundPass pass;
  gpu::Buffer mapWords, horizonValues;
  gpu::Texture map, sky, horizon, target;
  std::optional<MacroSettings> macro;  ///< what mapWords was made with
  gpu::Framebuffer framebuffer;
  std::shared_ptr<const bake::GroundBake> ground;
  std::optional<RelitGround> relit;
  std::optional<scene::Daylight> daylight;
  double hazeKm = 0.0;

  Result<void> ready() {
    SWARD_TRY(context.makeCurrent());
    if (!relit) return Error::failed("no ground was given to the renderer", "render");
    if (!daylight) return Error::failed("no daylight was given to the renderer", "render");
    return {};
  }

  Result<void> bindTarget(int width, int height) {
    if (target.width() != width || target.height() != height) {
      target = gpu::Texture::make2d(GL_RGBA32F, width, height);
      framebuffer = gpu::Framebuffer(target);
      SWARD_TRY(context.checkErrors("framebuffer"));
      if (!framebuffer.complete()) return Error::failed("the driver cannot draw into floats", "framebuffer");
    }
    framebuffer.bind();
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

  PassInput input() const {
    return {ground.get(),
            &*relit,
            &map,
            &sky,
            &horizon,
            daylight->sunDirection(),
            daylight->sunIrradiance(),
            hazeKm > 0.0 ? 1.0 / (hazeKm * kMetresPerKilometre) : 0.0};
  }

  /// Relights what the plan reads, then draws `samples` samples, added up with equal weights.
  Result<void> draw(const Frame& frame, int samples) {
    SWARD_TRY(checkFrame(frame));
    SWARD_TRY(ready());
    const BlockPlan plan = planBlocks(frame, *ground, relit->hasBlades());
    SWARD_TRY(relit->relight(programs, plan.sets));
    makeMap(frame.options);
    SWARD_TRY(bindTarget(frame.width, frame.height));
    const bool several = samples > 1;
    if (several) {
      constexpr float kBlack[4] = {};
      gpu::gl().ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, kBlack);
      gpu::gl().BlendFunc(GL_ONE, GL_ONE);
      gpu::gl().Enable(GL_BLEND);
    }
    Result<void> drawn;
    for (int sample = 0; sample < samples && drawn.ok(); ++sample)
      drawn = pass.draw(programs, input(), frame, plan, sample, 1.0 / samples);
    gpu::gl().Disable(GL_BLEND);
    SWARD_TRY(std::move(drawn));
    return context.checkErrors("drawing");
  }

  /// The target's RGB, rows from the top.
  image::Image readTarget() const {
    image::Image out(target.width(), target.height(), 3);
    gpu::gl().PixelStorei(GL_PACK_ALIGNMENT, 1);
    gpu::gl().GetTextureImage(target.name(), 0, GL_RGB, GL_FLOAT, static_cast<GLsizei>(out.pixels.size() * 4),
                              out.pixels.data());
    const auto row = static_cast<std::ptrdiff_t>(out.offset(0, 1));
    for (int y = 0; y < out.height / 2; ++y) {
      const auto top = out.pixels.begin() + y * row;
      std::swap_ranges(top, top + row, out.pixels.begin() + (out.height - 1 - y) * row);
    }
    return out;
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
  SWARD_TRY(context.checkErrors("renderer"));
  return renderer;
}

Result<void> Renderer::setGround(std::shared_ptr<const bake::GroundBake> ground) {
  Impl& impl = *m_impl;
  SWARD_TRY(impl.context.makeCurrent());
  if (!ground) return Error::failed("there is no ground", "render");
  impl.relit.reset();
  SWARD_ASSIGN(RelitGround relit, RelitGround::create(*ground));
  impl.macro.reset();
  SWARD_TRY(impl.context.checkErrors("uploading the ground"));
  impl.ground = std::move(ground);
  impl.relit = std::move(relit);
  if (impl.daylight) impl.relit->setIllumination(illuminationOf(*impl.daylight));
  return {};
}

void Renderer::setDaylight(const scene::Daylight& daylight, double hazeKm) {
  Impl& impl = *m_impl;
  if (!impl.context.makeCurrent().ok()) return;
  impl.daylight = daylight;
  impl.hazeKm = hazeKm;
  impl.sky = makeSkyTexture(daylight);
  impl.horizonValues = makeHorizonBuffer(daylight);
  impl.horizon = gpu::Texture::ofBuffer(GL_RGBA32F, impl.horizonValues);
  if (impl.relit) impl.relit->setIllumination(illuminationOf(daylight));
}

Result<image::Image> Renderer::drawLinear(const Frame& frame) {
  SWARD_TRY(m_impl->draw(frame, frame.options.samples));
  return m_impl->readTarget();
}

Result<image::Image> Renderer::drawDisplay(const Frame& frame) {
  SWARD_ASSIGN(const image::Image linear, drawLinear(frame));
  return toDisplay(linear, frame.options.viewTransform);
}

Result<void> Renderer::drawOnly(const Frame& frame) {
  Frame single = frame;
  single.options.samples = 1;
  SWARD_TRY(m_impl->draw(single, 1));
  gpu::gl().Finish();
  return {};
}

Result<void> Renderer::relight(const scene::Daylight& daylight, bool tilesOnly) {
  Impl& impl = *m_impl;
  impl.daylight = daylight;
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
