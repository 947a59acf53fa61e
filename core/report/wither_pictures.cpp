// Of section wither: what the cones' texel looks like from the side.

#include "image/colour.h"
#include "report/section_wither.h"
#include "report/text.h"
#include "wither/extinction.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr int kWidth = 480;        ///< pixels of a picture
constexpr double kThicken = 20.0;  ///< of the depth: needles are a thirteenth of a voxel wide
constexpr double kExposure = 2.0;
constexpr double kProportion = 110.0;  ///< so that blades are lines and not dots
constexpr std::uint64_t kSeed = 1;
const glm::dvec3 kBackground(0.020, 0.022, 0.026);  ///< dark, so that straw shows as leaves do

/// Depth, and reflectance times depth, of the columns along y: [z][x].
std::vector<glm::dvec4> columnsOf(const wither::Texel& texel) {
  const wither::TexelGrid& grid = texel.grid();
  std::vector<glm::dvec4> columns(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.layers),
                                  glm::dvec4(0.0));
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const wither::Voxel& voxel = texel.voxels()[i];
    const glm::u16vec3 at = texel.places()[i];
    const double depth = wither::extinction(voxel, {0.0, 1.0, 0.0}) * grid.voxelM().y;
    columns[static_cast<std::size_t>(at.z) * static_cast<std::size_t>(grid.columns) + at.x] +=
        depth * glm::dvec4(glm::dvec3(voxel.diffuse), 1.0);
  }
  return columns;
}

image::Image sideView(const wither::Texel& texel) {
  const wither::TexelGrid& grid = texel.grid();
  const std::vector<glm::dvec4> columns = columnsOf(texel);
  const int height = std::max(static_cast<int>(std::lround(kWidth * grid.heightM / grid.sideM)), 1);
  image::Image picture(kWidth, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int column = x * grid.columns / kWidth;
      // Rows may be fewer than layers: the mean of those that fall into one.
      const int low = (height - 1 - y) * grid.layers / height;
      const int high = std::max((height - y) * grid.layers / height, low + 1);
      glm::dvec3 sum(0.0);
      for (int layer = low; layer < high; ++layer) {
        const glm::dvec4 c = columns[static_cast<std::size_t>(layer) * static_cast<std::size_t>(grid.columns) +
                                     static_cast<std::size_t>(column)];
        const double alpha = -std::expm1(-kThicken * c.w);
        const glm::dvec3 leaf = c.w > 0.0 ? glm::dvec3(c) / c.w * kExposure : glm::dvec3(0.0);
        sum += (1.0 - alpha) * kBackground + alpha * glm::min(leaf, 1.0);
      }
      for (int channel = 0; channel < 3; ++channel) {
        picture.at(x, y, channel) = static_cast<float>(sum[channel] / (high - low));
      }
    }
  }
  return picture;
}

}  // namespace

Result<void> addWitherPictures(const WitherSize& size, const WitherBench& bench, Section& section,
                               const JobContext& job) {
  Strip strip;
  strip.title = "A hundred cones in a texel, from the side, at rising weathering degrees";
  SWARD_ASSIGN(const wither::Points points, bench.points(kProportion, kSeed, job));
  for (std::size_t i = 0; i < size.weatherings.size(); ++i) {
    SWARD_ASSIGN(const wither::Texel texel, bench.texel(points, size.weatherings[i], {}, job));
    Picture picture;
    picture.name = "wither_side_" + std::to_string(i);
    picture.caption = "weathering " + numberText(size.weatherings[i]) + "; optical depth is " + numberText(kThicken) +
                      " times what it is";
    picture.linear = sideView(texel);
    picture.display = picture.linear;
    for (float& value : picture.display.pixels) value = image::srgbFromLinear(value);
    strip.pictures.push_back(std::move(picture));
  }
  section.strips.push_back(std::move(strip));
  return {};
}

}  // namespace sward::report
