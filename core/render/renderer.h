#pragma once

#include "bake/ground_bake.h"
#include "bake/inspection.h"
#include "base/result.h"
#include "gpu/context.h"
#include "image/bytes.h"
#include "image/image.h"
#include "render/display.h"
#include "render/options.h"
#include "render/view_mode.h"
#include "scene/camera.h"
#include "scene/sun_sky.h"
#include "terrain/height_field.h"

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace sward::render {

/// One picture to draw.
struct Frame {
  scene::Camera camera;
  int width = 1280, height = 720;
  double exposure = 1.0;  ///< multiplies linear radiance before the view transform
  RenderOptions options;
  ViewMode mode;
  /// Only these columns are drawn, the rest stays black: one side of a split picture. Nothing: all.
  std::optional<Columns> columns;

  Columns drawn() const { return columns.value_or(Columns{0, width}); }
};

/// A picture that grows sample by sample, and the texture that holds it. Begun and drawn by one renderer; may be begun
/// again, which keeps the texture where the size is the same. Goes before its context does, with the context current.
class Drawing {
 public:
  Drawing();
  ~Drawing();
  Drawing(Drawing&&) noexcept;
  Drawing& operator=(Drawing&&) noexcept;

  int width() const;
  int height() const;
  int samples() const;    ///< drawn so far
  bool complete() const;  ///< all of the frame's samples are drawn

 private:
  friend class Renderer;
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

/// Draws a baked ground under a sun and sky. The world's origin is the south-west corner of the tile map's middle cell;
/// the map repeats beyond its borders. Lives on one context and thread. Draws into framebuffer objects of its
/// own.
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create(gpu::Context& context);
  ~Renderer();

  /// Uploads a bake, layers or texels; replaces the one before. Only GroundMethod::Texels draws texels, and nothing
  /// else does. An error when the GPU has no room.
  Result<void> setGround(std::shared_ptr<const bake::GroundBake> ground);
  /// Lays the ground over a terrain; nothing: level ground. Cameras keep their height above z = 0, one that lies below
  /// the ground is raised to it. The blended methods draw as the march does. Shadows of the hills follow setDaylight().
  /// Takes some 100 ms for a field of 1024 x 1024.
  Result<void> setTerrain(std::shared_ptr<const terrain::HeightField> field);
  /// What the view modes Visibility and Condition show of the ground; the next setGround() forgets it. Errors: it
  /// belongs to another ground.
  Result<void> setInspection(const bake::Inspection& inspection);
  /// Takes a new light; what a picture reads is relit when it is drawn, if the light differs from the last. `hazeKm`:
  /// distance at which aerial perspective hides 63 % (scene::SkyOptions); 0: none.
  void setDaylight(const scene::Daylight& daylight, double hazeKm = 12.0);

  /// Lighting texels takes the processor seconds: a request to stop ends it, and begin(), with Error::cancelled().
  void setStop(std::stop_token stop);

  /// Starts a picture: relights what it reads, clears what was drawn. The samples follow with addSample().
  Result<void> begin(Drawing& drawing, const Frame& frame);
  /// Draws the next sample. Errors: all are drawn; ground or light have changed since begin().
  Result<void> addSample(Drawing& drawing);
  /// The mean of the samples drawn so far, as drawLinear() and drawDisplay() give it; the same bytes once complete. In
  /// a view mode linear values are the quantity times the share of the pixel that is ground, over black.
  Result<image::Image> readLinear(const Drawing& drawing);
  Result<image::Image> readDisplay(const Drawing& drawing);
  /// The same in 8 bits, the bytes that image::writePng makes of readDisplay(), for the columns that the frame draws;
  /// `out` takes the picture's size and keeps its other columns when it has that size already.
  Result<void> readBytes(const Drawing& drawing, image::ByteImage& out);
  /// Waits until everything asked for is drawn.
  Result<void> finish();

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

}  // namespace sward::render
