#include "render/sky_map.h"

#include "base/random.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace sward::render {
namespace {

constexpr int kSkyColumns = 256, kSkyRows = 128;  ///< kSkyRows also in shaders/ground/sky.glsl
constexpr int kNoiseSide = 256;

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

gpu::Texture makeNoiseTexture() {
  constexpr std::uint64_t kSeed = 0x5eed;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kNoiseSide * kNoiseSide) * 2);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(base::mix64(kSeed, i) >> 56);
  gpu::Texture texture = gpu::Texture::make2d(GL_RG8, kNoiseSide, kNoiseSide);
  texture.write(GL_RG, GL_UNSIGNED_BYTE, pixels.data());
  texture.setLinear(true, true);
  return texture;
}

}  // namespace sward::render
