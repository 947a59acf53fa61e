#pragma once

#include "live/view_service.h"

#include "gpu/context.h"
#include "image/bytes.h"
#include "render/renderer.h"
#include "scene/sun_sky.h"

#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

namespace sward::editor {

/// Draws requests of the viewport on a context of its own, all on the thread that calls it. Keeps what two requests
/// have in common: grounds stay uploaded, light stays lit, textures stay allocated.
class ViewPainter {
 public:
  /// `stop`: ends what takes long on the processor, with Error::cancelled().
  explicit ViewPainter(gpu::Device device, std::stop_token stop = {}) : m_device(device), m_stop(std::move(stop)) {}
  ~ViewPainter();

  /// Starts a picture, or goes on with the last one where only its comparison with a given picture changed; and a
  /// context when there is none yet. Errors: no context, a request that cannot be drawn.
  Result<void> begin(const ViewRequest& request);
  /// One more sample of everything the picture shows, drawn to its end.
  Result<void> addSample();
  int samples() const { return m_sides[0].drawing.samples(); }
  bool complete() const { return m_sides[0].drawing.complete(); }
  /// The picture so far.
  Result<image::ByteImage> read();
  /// ViewPicture::rmse of what was read last.
  std::optional<double> rmse() const { return m_rmse; }
  std::optional<gpu::DeviceInfo> device() const;

 private:
  /// A renderer and the ground that it holds.
  struct Bench {
    std::unique_ptr<render::Renderer> renderer;
    std::shared_ptr<const bake::GroundBake> ground;
    std::shared_ptr<const bake::Inspection> inspection;
    bool lit = false;  ///< with m_daylight
  };
  /// The project's own picture, or the other one of a comparison.
  struct Side {
    render::Drawing drawing;
    render::Renderer* renderer = nullptr;
    image::ByteImage bytes;
  };

  Result<void> open();
  Result<void> light(const project::Project& project);
  Result<void> shape(const project::Project& project);
  Result<void> prepare(Bench& bench, const std::shared_ptr<const bake::GroundBake>& ground,
                       const std::shared_ptr<const bake::Inspection>& inspection);
  Result<void> beginSides(const ViewRequest& request, const render::Frame& frame);
  Result<image::ByteImage> readGiven();

  gpu::Device m_device;
  std::stop_token m_stop;
  std::unique_ptr<gpu::Context> m_context;
  std::array<Bench, 2> m_benches;  ///< the second only for a comparison with another ground
  std::array<Side, 2> m_sides;
  std::optional<ViewRequest> m_request;  ///< that m_sides were begun for
  std::optional<Comparison> m_comparison;
  std::optional<double> m_rmse;
  std::optional<scene::Daylight> m_daylight;
  scene::SunOptions m_sun;  ///< what m_daylight was made of
  scene::SkyOptions m_sky;
  std::shared_ptr<const terrain::HeightField> m_field;  ///< nothing: level ground
  terrain::TerrainOptions m_terrain;                    ///< what m_field was made of
  std::filesystem::path m_folder;                       ///< and where its path starts
};

/// Column at which a split picture changes sides, 0 to width.
int splitColumn(const Comparison& comparison, int width);

/// A picture in another size, of its nearest pixels.
image::ByteImage inSize(const image::ByteImage& picture, int width, int height);

/// The project's own picture beside or against the other, which is of the same size.
image::ByteImage composed(const image::ByteImage& own, const image::ByteImage& other, const Comparison& comparison);

/// The project's own picture, dark where the comparison's other one will be.
image::ByteImage darkened(const image::ByteImage& own, const Comparison& comparison);

/// The difference of two pictures of one size as a comparison shows it, on their 8-bit display values; alpha 255.
image::ByteImage differenceOf(const image::ByteImage& own, const image::ByteImage& other, const Comparison& comparison);

}  // namespace sward::editor
