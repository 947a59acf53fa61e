#include "bake/soil.h"

#include "base/random.h"
#include "image/io.h"

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

/// Value noise in [-1, 1] that repeats over the unit square, `cells` lattice cells along each side.
class PeriodicNoise {
 public:
  PeriodicNoise(std::uint64_t seed, int cells) : m_seed(seed), m_cells(std::max(cells, 1)) {}

  double operator()(double x, double y) const {
    const double gx = x * m_cells, gy = y * m_cells;
    const double fx = std::floor(gx), fy = std::floor(gy);
    const auto ix = static_cast<int>(fx), iy = static_cast<int>(fy);
    const double tx = smooth(gx - fx), ty = smooth(gy - fy);
    const double low = std::lerp(lattice(ix, iy), lattice(ix + 1, iy), tx);
    const double high = std::lerp(lattice(ix, iy + 1), lattice(ix + 1, iy + 1), tx);
    return std::lerp(low, high, ty);
  }

 private:
  static double smooth(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }
  double lattice(int x, int y) const {
    const auto wrap = [&](int i) { return static_cast<std::uint64_t>((i % m_cells + m_cells) % m_cells); };
    return 2.0 * base::unitDouble(base::mix64(m_seed, wrap(x), wrap(y))) - 1.0;
  }
  std::uint64_t m_seed;
  int m_cells;
};

std::vector<glm::vec3> variedColours(const project::Project& project, int resolution) {
  const project::Soil& soil = project.patch.soil;
  const auto cells = [&](double sizeM) { return static_cast<int>(std::lround(project.patch.sideM / sizeM)); };
  const PeriodicNoise coarse(base::mix64(project.patch.seed, 0x736f696c, 1), cells(0.05));
  const PeriodicNoise fine(base::mix64(project.patch.seed, 0x736f696c, 2), cells(0.012));
  std::vector<glm::vec3> colours;
  colours.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const double u = (x + 0.5) / resolution, v = (y + 0.5) / resolution;
      const double brightness = 1.0 + soil.colourVariation * (0.6 * coarse(u, v) + 0.6 * fine(u, v));
      colours.emplace_back(glm::clamp(soil.colour * brightness, 0.0, 1.0));
    }
  }
  return colours;
}

glm::vec3 pixel(const image::Image& image, int x, int y) {
  x = (x % image.width + image.width) % image.width;
  y = (y % image.height + image.height) % image.height;
  return image.channels >= 3 ? image.rgb(x, y) : glm::vec3(image.at(x, y, 0));
}

/// Bilinear, repeated; u along +x and v along +y (the image's top row is the patch's north edge).
glm::vec3 texel(const image::Image& image, double u, double v) {
  const double px = u * image.width - 0.5, py = (1.0 - v) * image.height - 0.5;
  const auto x = static_cast<int>(std::floor(px)), y = static_cast<int>(std::floor(py));
  const auto tx = static_cast<float>(px - x), ty = static_cast<float>(py - y);
  return glm::mix(glm::mix(pixel(image, x, y), pixel(image, x + 1, y), tx),
                  glm::mix(pixel(image, x, y + 1), pixel(image, x + 1, y + 1), tx), ty);
}

std::vector<glm::vec3> texturedColours(const image::Image& image, int resolution) {
  // As many samples a side as the texture has texels in one of ours, so that a fine texture is averaged.
  const int samples = std::clamp((std::max(image.width, image.height) + resolution - 1) / resolution, 1, 16);
  std::vector<glm::vec3> colours;
  colours.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      glm::vec3 sum(0.0f);
      for (int s = 0; s < samples * samples; ++s) {
        const double u = (x + (s % samples + 0.5) / samples) / resolution;
        const double v = (y + (s / samples + 0.5) / samples) / resolution;
        sum += texel(image, u, v);
      }
      colours.push_back(glm::clamp(sum / static_cast<float>(samples * samples), 0.0f, 1.0f));
    }
  }
  return colours;
}

}  // namespace

Result<std::vector<glm::vec3>> soilColours(const project::Project& project, int resolution) {
  if (project.patch.soil.texture.empty()) return variedColours(project, resolution);
  SWARD_ASSIGN(const image::Image image, image::readImage(project.resolve(project.patch.soil.texture)));
  return texturedColours(image, resolution);
}

}  // namespace sward::bake
