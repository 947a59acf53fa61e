#include "tiles/evenness.h"

#include "base/check.h"

#include <array>
#include <cmath>
#include <vector>

namespace sward::tiles {
namespace {

/// Sum and sum of squares of colours, for their variance summed over RGB.
struct Spread {
  glm::dvec3 sum{0.0};
  double squares = 0.0;
  double count = 0.0;

  void add(const glm::dvec3& value) {
    sum += value;
    squares += glm::dot(value, value);
    count += 1.0;
  }
  double variance() const { return squares / count - glm::dot(sum, sum) / (count * count); }
};

double variance(const std::vector<glm::dvec3>& values) {
  Spread spread;
  for (const glm::dvec3& value : values) spread.add(value);
  return spread.variance();
}

Edge diagonalOwner(int x, int y, int resolution) {
  const int right = 2 * x + 1 - resolution;
  const int up = 2 * y + 1 - resolution;
  if (std::abs(up) >= std::abs(right)) return up < 0 ? kSouth : kNorth;
  return right < 0 ? kWest : kEast;
}

/// What a pixseries adds to the picture: its colour where it covers, finite in any case.
glm::dvec3 shownColour(const SeamColumn& column) {
  const glm::dvec3 colour = glm::dvec3(column.meanColour[0]) * static_cast<double>(column.coverage);
  return std::isfinite(colour.x + colour.y + colour.z) ? colour : glm::dvec3(0.0);
}

}  // namespace

double unevenness(const TileSet& set, std::span<const SeamColumn> columns) {
  const int resolution = set.resolution;
  const int period = set.patchResolution;
  SWARD_CHECK_EQ(columns.size(), static_cast<std::size_t>(period) * static_cast<std::size_t>(period));
  std::vector<glm::dvec3> alongX(static_cast<std::size_t>(resolution), glm::dvec3(0.0)), alongY = alongX;
  std::vector<glm::dvec3> whole(set.tiles.size(), glm::dvec3(0.0));
  Spread single;
  for (std::size_t tile = 0; tile < set.tiles.size(); ++tile) {
    std::array<glm::ivec2, 4> offsets{};
    for (const Edge edge : {kSouth, kWest, kNorth, kEast})
      offsets[edge] = set.patchOffset(static_cast<int>(tile), edge);
    for (int y = 0; y < resolution; ++y) {
      for (int x = 0; x < resolution; ++x) {
        const glm::ivec2 place = glm::ivec2(x, y) + offsets[diagonalOwner(x, y, resolution)];
        const int px = ((place.x % period) + period) % period;
        const int py = ((place.y % period) + period) % period;
        const glm::dvec3 colour = shownColour(columns[static_cast<std::size_t>(py * period + px)]);
        alongX[static_cast<std::size_t>(x)] += colour;
        alongY[static_cast<std::size_t>(y)] += colour;
        whole[tile] += colour;
        single.add(colour);
      }
    }
  }
  const double texels = static_cast<double>(resolution);
  const double lines = texels * static_cast<double>(set.tiles.size());
  for (glm::dvec3& value : alongX) value /= lines;
  for (glm::dvec3& value : alongY) value /= lines;
  for (glm::dvec3& value : whole) value /= texels * texels;
  const double scale = single.variance();
  return scale > 0.0 ? (variance(alongX) + variance(alongY) + variance(whole)) / scale : 0.0;
}

}  // namespace sward::tiles
