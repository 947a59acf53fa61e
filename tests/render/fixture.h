#pragma once

#include "gpu/context.h"
#include "render/renderer.h"
#include "render/synthetic.h"
#include "scene/camera.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <gtest/gtest.h>

#include <memory>

namespace sward::testing {

/// A context with a renderer on it. Context before renderer: members die in reverse.
struct Stage {
  std::unique_ptr<gpu::Context> context;
  std::unique_ptr<render::Renderer> renderer;
};

inline Stage makeStage(gpu::Device device = gpu::Device::Egl) {
  Stage stage;
  auto context = gpu::Context::create(device);
  EXPECT_TRUE(context.ok()) << context.error().text();
  stage.context = std::move(context).value();
  auto renderer = render::Renderer::create(*stage.context);
  EXPECT_TRUE(renderer.ok()) << renderer.error().text();
  stage.renderer = std::move(renderer).value();
  return stage;
}

inline std::shared_ptr<const bake::GroundBake> makeGround(const SyntheticOptions& options) {
  return std::make_shared<const bake::GroundBake>(syntheticGround(options));
}

/// A small ground: 4 tiles of 32 texels from a patch of 64.
inline SyntheticOptions smallOptions() {
  SyntheticOptions options;
  options.patchTexels = 64;
  options.tileTexels = 32;
  options.tiles = 4;
  options.layers = 8;
  options.blades = 4;
  options.bladeRows = 32;
  options.mapSide = 32;
  options.plants = 90;
  options.patchSideM = 0.5;
  options.heightM = 0.3;
  return options;
}

inline scene::Daylight daylightAt(double azimuthDeg, double elevationDeg) {
  scene::SunAngles angles{azimuthDeg, elevationDeg};
  return scene::Daylight(scene::directionFromAngles(angles), scene::SunOptions{}, scene::SkyOptions{});
}

inline lpt::Illumination illuminationOf(const scene::Daylight& daylight) {
  return {daylight.sunDirection(), daylight.sunIrradiance(), daylight.meanSkyRadiance()};
}

inline render::Frame frameOf(const glm::dvec3& position, const glm::dvec3& target, int width, int height, int samples,
                             double focalLengthMm = 35.0) {
  scene::View view;
  view.position = position;
  view.target = target;
  view.focalLengthMm = focalLengthMm;
  render::Frame frame;
  frame.camera = scene::cameraFromView(view).value();
  frame.width = width;
  frame.height = height;
  frame.options.samples = samples;
  frame.options.macroVariation = 0.0;
  frame.options.gridBendM = 0.0;
  return frame;
}

/// Largest difference between a stored value and what was encoded: the square root of value / scale in 8 bits is off by
/// half a step, which spreads by the square; a little more for the arithmetic in float.
inline double storageBound(double value, double scale) {
  const double step = 0.5 / 255.0 + 2e-5;
  const double root = std::sqrt(std::max(value, 0.0) / scale);
  return scale * (2.0 * root * step + step * step) + 1e-6;
}

/// The same for coverage a, whose optical depth -ln(1 - 0.985 a) is stored as its root over that of full coverage.
inline double coverageBound(double coverage) {
  const double full = -std::log(1.0 - 0.985);
  const double depth = -std::log(1.0 - 0.985 * coverage);
  return (1.0 - 0.985 * coverage) / 0.985 * storageBound(depth, full);
}

}  // namespace sward::testing
