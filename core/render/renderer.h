#pragma once

#include "bake/ground_bake.h"
#include "base/result.h"
#include "gpu/context.h"
#include "image/image.h"
#include "render/options.h"
#include "scene/camera.h"
#include "scene/sun_sky.h"

#include <memory>
#include <string>
#include <vector>

namespace sward::render {

/// One picture to draw.
struct Frame {
  scene::Camera camera;
  int width = 1280, height = 720;
  double exposure = 1.0;  ///< multiplies linear radiance before the view transform
  RenderOptions options;
};

/// Draws a baked ground under a sun and sky. The world's origin is the south-west corner of the tile map's middle cell;
/// the map repeats beyond its borders. Lives on one context and thread. Draws into framebuffer objects of its
/// own.
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create(gpu::Context& context);
  ~Renderer();

  /// Uploads a bake; replaces the one before. An error when the GPU has no room.
  Result<void> setGround(std::shared_ptr<const bake::GroundBake> ground);
  /// Takes a new light; what a picture reads is relit when it is drawn, if the light differs from the last. `hazeKm`:
  /// distance at which aerial perspective hides 63 % (scene::SkyOptions); 0: none.
  void setDaylight(const scene::Daylight& daylight, double hazeKm = 12.0);

  /// Draws options.samples jittered samples and averages them; linear radiance times exposure, RGB.
  Result<image::Image> drawLinear(const Frame& frame);
  /// The same after the view transform, sRGB-encoded in [0, 1], RGB.
  Result<image::Image> drawDisplay(const Frame& frame);

  /// One sample into the renderer's own framebuffer, without reading it back, finished (glFinish): what a benchmark
  /// times.
  Result<void> drawOnly(const Frame& frame);
  /// Relights unconditionally and finishes: what a benchmark times. `tilesOnly` leaves the blade sets out.
  Result<void> relight(const scene::Daylight& daylight, bool tilesOnly);
  /// One relit plane of a tile as the GPU holds it at a mip level, row by row from the south-west: straight radiance /
  /// relightScale() and coverage. Layer slices.layers is the soil; tile tiles.size() is the mean of all tiles, held at
  /// the coarsest level alone. For tests.
  Result<std::vector<glm::vec4>> readRelitSlices(int tile, int layer, int mip);
  /// Radiance that relit texels are stored relative to; chosen from the light so that texels stay below 1.
  double relightScale() const;

 private:
  Renderer();
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

/// Linear radiance times exposure to display: the view transform, then sRGB encoding, per pixel.
image::Image toDisplay(const image::Image& linear, ViewTransform transform);

}  // namespace sward::render
