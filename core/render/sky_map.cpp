#include "render/sky_map.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::render {
namespace {

constexpr int kSkyColumns = 256, kSkyRows = 128;  ///< kSkyRows and kHorizonTexels also in constants.glsl
constexpr int kHorizonTexels = 512;

/// Inverse of diamondAngle() of sky.glsl: a horizontal unit vector.
glm::dvec2 fromDiamondAngle(double u) {
  const double turned = u - std::floor(u + 0.25);  // in [-1/4, 3/4)
  const bool north = turned < 0.25;
  const double x = north ? 4.0 * turned : 4.0 * (0.5 - turned);
  const double y = (north ? 1.0 : -1.0) * (1.0 - std::abs(x));
  return glm::normalize(glm::dvec2(x, y));
}

}  // namespace

gpu::Texture makeSkyTexture(const scene::Daylight& daylight) {
  std::vector<float> pixels;
  pixels.reserve(static_cast<std::size_t>(kSkyColumns * kSkyRows) * 3);
  for (int row = 0; row < kSkyRows; ++row) {
    const double root = static_cast<double>(row) / (kSkyRows - 1);
    const double height = root * root;
    for (int column = 0; column < kSkyColumns; ++column) {
      const glm::dvec2 azimuth = fromDiamondAngle((column + 0.5) / kSkyColumns);
      const glm::dvec2 across = azimuth * std::sqrt(1.0 - height * height);
      const glm::dvec3 radiance = daylight.skyRadiance({across.x, across.y, height});
      for (int c = 0; c < 3; ++c) pixels.push_back(static_cast<float>(radiance[c]));
    }
  }
  gpu::Texture texture = gpu::Texture::make2d(GL_RGB32F, kSkyColumns, kSkyRows);
  texture.write(GL_RGB, GL_FLOAT, pixels.data());
  texture.setLinear(true, false);
  return texture;
}

gpu::Buffer makeHorizonBuffer(const scene::Daylight& daylight) {
  // One entry more than the shader's kHorizonTexels: its jitter may reach the one that closes the circle.
  std::vector<float> values;
  for (int i = 0; i <= kHorizonTexels; ++i) {
    const glm::dvec2 azimuth = fromDiamondAngle(static_cast<double>(i) / kHorizonTexels - 0.25);
    const glm::dvec3 radiance = daylight.skyRadiance({azimuth.x, azimuth.y, 0.0});
    for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(radiance[c]));
    values.push_back(1.0f);
  }
  return gpu::Buffer(std::as_bytes(std::span(values)));
}

}  // namespace sward::render
