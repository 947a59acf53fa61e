#include "live/view_painter.h"

#include "base/check.h"
#include "render/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::editor {
namespace {

Result<void> checkRequest(const ViewRequest& request) {
  if (!request.project) return Error::failed("there is no project", "viewport");
  if (!request.ground) return Error::failed("there is no ground yet", "viewport");
  return {};
}

/// What the project's own picture of a request is; a moving one has half the size and one sample.
Result<render::Frame> frameOf(const ViewRequest& request, const scene::Daylight& daylight) {
  SWARD_ASSIGN(render::Frame frame, render::planFrame(*request.project, request.view, daylight));
  frame.mode = request.mode;
  frame.width = request.width;
  frame.height = request.height;
  if (request.moving) {
    frame.width = (frame.width + 1) / 2;
    frame.height = (frame.height + 1) / 2;
    frame.options.samples = 1;
  }
  return frame;
}

}  // namespace

int splitColumn(const Comparison& comparison, int width) {
  const double at = std::isfinite(comparison.splitAt) ? std::clamp(comparison.splitAt, 0.0, 1.0) : 0.5;
  return static_cast<int>(std::lround(at * width));
}

image::ByteImage differenceOf(const image::ByteImage& own, const image::ByteImage& other,
                              const Comparison& comparison) {
  SWARD_CHECK_EQ(own.rgba.size(), other.rgba.size());
  const bool withSign = comparison.show == Comparison::Show::SignedDifference;
  std::array<std::uint8_t, 511> shown{};  // by the difference of two bytes, + 255
  for (int difference = -255; difference <= 255; ++difference) {
    const double scaled = comparison.differenceGain * difference;
    const double value = withSign ? 127.5 + 0.5 * scaled : std::abs(scaled);
    shown[static_cast<std::size_t>(difference + 255)] =
        static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  }
  image::ByteImage out = own;
  for (std::size_t i = 0; i < out.rgba.size(); ++i) {
    const int difference = static_cast<int>(other.rgba[i]) - static_cast<int>(own.rgba[i]);
    out.rgba[i] = i % 4 == 3 ? std::uint8_t{255} : shown[static_cast<std::size_t>(difference + 255)];
  }
  return out;
}

ViewPainter::~ViewPainter() {
  // Textures are deleted on their own context, before it goes.
  if (m_context) (void)m_context->makeCurrent();
}

std::optional<gpu::DeviceInfo> ViewPainter::device() const {
  if (!m_context) return std::nullopt;
  return m_context->info();
}

Result<void> ViewPainter::open() {
  if (m_context) return m_context->makeCurrent();
  SWARD_ASSIGN(m_context, gpu::Context::create(m_device));
  return {};
}

Result<void> ViewPainter::light(const project::Project& project) {
  if (m_daylight && m_sun == project.sun && m_sky == project.sky) return {};
  SWARD_ASSIGN(m_daylight, render::daylightOf(project));
  m_sun = project.sun;
  m_sky = project.sky;
  for (Bench& bench : m_benches) bench.lit = false;
  return {};
}

Result<void> ViewPainter::prepare(Bench& bench, const std::shared_ptr<const bake::GroundBake>& ground,
                                  const std::shared_ptr<const bake::Inspection>& inspection) {
  if (!bench.renderer) {
    SWARD_ASSIGN(bench.renderer, render::Renderer::create(*m_context));
  }
  if (bench.ground != ground) {
    bench.ground.reset();
    bench.inspection.reset();
    SWARD_TRY(bench.renderer->setGround(ground));
    bench.ground = ground;
  }
  if (inspection && bench.inspection != inspection) {
    SWARD_TRY(bench.renderer->setInspection(*inspection));
    bench.inspection = inspection;
  }
  if (!std::exchange(bench.lit, true)) bench.renderer->setDaylight(*m_daylight, m_sky.hazeKm);
  return {};
}

Result<void> ViewPainter::beginSides(const ViewRequest& request, const render::Frame& frame) {
  render::Frame own = frame, other = frame;
  if (m_comparison) {
    other.options.method = m_comparison->method;
    if (m_comparison->show == Comparison::Show::Split) {
      const int split = splitColumn(*m_comparison, frame.width);
      own.columns = render::Columns{0, split};
      other.columns = render::Columns{split, frame.width};
    }
  }
  SWARD_TRY(prepare(m_benches[0], request.ground, request.inspection));
  m_sides[0].renderer = m_benches[0].renderer.get();
  SWARD_TRY(m_sides[0].renderer->begin(m_sides[0].drawing, own));
  if (!m_comparison) {
    // A second ground is large, and comparing is done for a while at a time.
    m_sides[1] = {};
    m_benches[1] = {};
    return {};
  }
  const bool another = m_comparison->ground && m_comparison->ground != request.ground;
  if (another) SWARD_TRY(prepare(m_benches[1], m_comparison->ground, m_comparison->inspection));
  m_sides[1].renderer = m_benches[another ? 1 : 0].renderer.get();
  return m_sides[1].renderer->begin(m_sides[1].drawing, other);
}

Result<void> ViewPainter::begin(const ViewRequest& request) {
  SWARD_TRY(open());
  SWARD_TRY(checkRequest(request));
  SWARD_TRY(light(*request.project));
  SWARD_ASSIGN(const render::Frame frame, frameOf(request, *m_daylight));
  m_comparison = request.comparison;
  return beginSides(request, frame);
}

Result<void> ViewPainter::addSample() {
  for (Side& side : m_sides) {
    if (side.renderer != nullptr) SWARD_TRY(side.renderer->addSample(side.drawing));
  }
  return m_sides[0].renderer->finish();
}

Result<image::ByteImage> ViewPainter::read() {
  Side &own = m_sides[0], &other = m_sides[1];
  if (!m_comparison) {
    SWARD_TRY(own.renderer->readBytes(own.drawing, own.bytes));
    return std::move(own.bytes);
  }
  const bool split = m_comparison->show == Comparison::Show::Split;
  SWARD_TRY(own.renderer->readBytes(own.drawing, own.bytes));
  // The two halves of a split go into one picture.
  SWARD_TRY(other.renderer->readBytes(other.drawing, split ? own.bytes : other.bytes));
  if (split) return std::move(own.bytes);
  return differenceOf(own.bytes, other.bytes, *m_comparison);
}

}  // namespace sward::editor
