#include "live/view_painter.h"

#include "base/check.h"
#include "image/metrics.h"
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

/// Whether the picture begun for `a` is the one that `b` needs, but for what is put beside it.
bool sameOwnPicture(const ViewRequest& a, const ViewRequest& b) {
  const auto given = [](const ViewRequest& r) { return r.comparison && r.comparison->given; };
  return given(a) && given(b) && a.project == b.project && a.ground == b.ground && a.inspection == b.inspection &&
         a.view == b.view && a.width == b.width && a.height == b.height && a.mode == b.mode && a.moving == b.moving;
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

image::ByteImage inSize(const image::ByteImage& picture, int width, int height) {
  if (picture.width == width && picture.height == height) return picture;
  image::ByteImage out{width, height, {}};
  out.rgba.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* pixel = picture.at(x * picture.width / width, y * picture.height / height);
      out.rgba.insert(out.rgba.end(), pixel, pixel + 4);
    }
  }
  return out;
}

image::ByteImage composed(const image::ByteImage& own, const image::ByteImage& other, const Comparison& comparison) {
  if (comparison.show != Comparison::Show::Split) return differenceOf(own, other, comparison);
  SWARD_CHECK_EQ(own.rgba.size(), other.rgba.size());
  image::ByteImage out = own;
  const auto row = static_cast<std::ptrdiff_t>(own.width) * 4;
  const auto split = static_cast<std::ptrdiff_t>(splitColumn(comparison, own.width)) * 4;
  for (std::ptrdiff_t y = 0; y < own.height; ++y)
    std::copy(other.rgba.begin() + y * row + split, other.rgba.begin() + (y + 1) * row,
              out.rgba.begin() + y * row + split);
  return out;
}

image::ByteImage darkened(const image::ByteImage& own, const Comparison& comparison) {
  constexpr int kParts = 3;  // dark enough to be no picture, light enough to find one's way
  image::ByteImage dark = own;
  for (std::size_t i = 0; i < dark.rgba.size(); ++i)
    if (i % 4 != 3) dark.rgba[i] = static_cast<std::uint8_t>(dark.rgba[i] / kParts);
  Comparison beside = comparison;
  beside.show = Comparison::Show::Split;
  if (comparison.show != Comparison::Show::Split) beside.splitAt = 0.0;
  return composed(own, dark, beside);
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

Result<void> ViewPainter::shape(const project::Project& project) {
  if (m_terrain == project.terrain && m_folder == project.folder) return {};
  SWARD_ASSIGN(terrain::Terrain terrain, render::terrainOf(project));
  m_field = std::move(terrain.field);
  m_terrain = project.terrain;
  m_folder = project.folder;
  return {};
}

Result<void> ViewPainter::prepare(Bench& bench, const std::shared_ptr<const bake::GroundBake>& ground,
                                  const std::shared_ptr<const bake::Inspection>& inspection) {
  if (!bench.renderer) {
    SWARD_ASSIGN(bench.renderer, render::Renderer::create(*m_context));
    bench.renderer->setStop(m_stop);
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
  SWARD_TRY(bench.renderer->setTerrain(m_field));
  if (!std::exchange(bench.lit, true)) bench.renderer->setDaylight(*m_daylight, m_sky.hazeKm);
  return {};
}

Result<void> ViewPainter::beginSides(const ViewRequest& request, const render::Frame& frame) {
  render::Frame own = frame, other = frame;
  if (m_comparison && m_comparison->given) {
    own.options.macroVariation = 0.0;  // a matter of taste, no error
  } else if (m_comparison) {
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
  if (!m_comparison || m_comparison->given) {
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
  m_comparison = request.comparison;
  m_rmse.reset();
  if (m_request && sameOwnPicture(*m_request, request)) return {};
  m_request.reset();
  SWARD_TRY(light(*request.project));
  SWARD_TRY(shape(*request.project));
  SWARD_ASSIGN(const render::Frame frame, frameOf(request, *m_daylight));
  SWARD_TRY(beginSides(request, frame));
  m_request = request;
  return {};
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
  if (m_comparison->given) return readGiven();
  const bool split = m_comparison->show == Comparison::Show::Split;
  SWARD_TRY(own.renderer->readBytes(own.drawing, own.bytes));
  // The two halves of a split go into one picture.
  SWARD_TRY(other.renderer->readBytes(other.drawing, split ? own.bytes : other.bytes));
  if (split) return std::move(own.bytes);
  return differenceOf(own.bytes, other.bytes, *m_comparison);
}

Result<image::ByteImage> ViewPainter::readGiven() {
  image::ByteImage& own = m_sides[0].bytes;
  SWARD_TRY(m_sides[0].renderer->readBytes(m_sides[0].drawing, own));
  const std::shared_ptr<const image::ByteImage>& given = m_comparison->other;
  if (!given) return darkened(own, *m_comparison);
  if (complete() && !m_request->moving && given->width == own.width && given->height == own.height) {
    SWARD_ASSIGN(const image::ValueErrors errors, image::valueErrors(image::fromBytes(*given), image::fromBytes(own)));
    m_rmse = errors.rmse;
  }
  return composed(own, inSize(*given, own.width, own.height), *m_comparison);
}

}  // namespace sward::editor
