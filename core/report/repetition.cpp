#include "report/repetition.h"

#include "image/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sward::report {
namespace {

/// A scalar field with its local mean taken out.
struct Field {
  int width = 0, height = 0;
  std::vector<double> values;
  double at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Field withoutLocalMean(const image::Image& linear, int box) {
  Field out{linear.width, linear.height, {}};
  const auto w = static_cast<std::size_t>(linear.width + 1);
  // Summed areas: [y][x] the sum over all above and left.
  std::vector<double> sums(w * static_cast<std::size_t>(linear.height + 1), 0.0);
  for (int y = 0; y < linear.height; ++y) {
    for (int x = 0; x < linear.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * w + static_cast<std::size_t>(x);
      sums[i + w + 1] = static_cast<double>(image::luminance(linear.rgb(x, y))) + sums[i + 1] + sums[i + w] - sums[i];
    }
  }
  out.values.reserve(static_cast<std::size_t>(linear.width) * static_cast<std::size_t>(linear.height));
  for (int y = 0; y < linear.height; ++y) {
    for (int x = 0; x < linear.width; ++x) {
      const auto x0 = static_cast<std::size_t>(std::max(x - box / 2, 0));
      const auto y0 = static_cast<std::size_t>(std::max(y - box / 2, 0));
      const auto x1 = static_cast<std::size_t>(std::min(x + box / 2 + 1, linear.width));
      const auto y1 = static_cast<std::size_t>(std::min(y + box / 2 + 1, linear.height));
      const double sum = sums[y1 * w + x1] - sums[y0 * w + x1] - sums[y1 * w + x0] + sums[y0 * w + x0];
      out.values.push_back(static_cast<double>(image::luminance(linear.rgb(x, y))) -
                           sum / static_cast<double>((x1 - x0) * (y1 - y0)));
    }
  }
  return out;
}

double correlation(const Field& field, int dx, int dy) {
  double product = 0.0, first = 0.0, second = 0.0;
  for (int y = std::max(-dy, 0); y < field.height - std::max(dy, 0); ++y) {
    for (int x = std::max(-dx, 0); x < field.width - std::max(dx, 0); ++x) {
      const double a = field.at(x, y), b = field.at(x + dx, y + dy);
      product += a * b;
      first += a * a;
      second += b * b;
    }
  }
  const double scale = std::sqrt(first * second);
  return scale > 0.0 ? product / scale : 0.0;
}

/// All lags of up to `lags` a side, each once (the opposite lag is the same pair).
std::vector<glm::ivec2> halfPlane(int lags) {
  std::vector<glm::ivec2> out;
  for (int y = 0; y <= lags; ++y) {
    for (int x = y == 0 ? 1 : -lags; x <= lags; ++x) out.emplace_back(x, y);
  }
  return out;
}

}  // namespace

MapRepetition repetitionOf(const tiles::TileMap& map, int lags) {
  std::array<double, 256> share{};
  const auto cells = static_cast<double>(map.tiles.size());
  for (const std::uint8_t tile : map.tiles) share[tile] += 1.0 / cells;
  double chance = 0.0;
  for (const double p : share) chance += p * p;
  MapRepetition worst{-1.0, {}};
  for (const glm::ivec2 lag : halfPlane(lags)) {
    std::uint64_t same = 0;
    for (int y = 0; y < map.height; ++y) {
      const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width);
      const auto other = static_cast<std::size_t>((y + lag.y) % map.height) * static_cast<std::size_t>(map.width);
      for (int x = 0; x < map.width; ++x) {
        const int x2 = (x + lag.x + lags * map.width) % map.width;
        if (map.tiles[row + static_cast<std::size_t>(x)] == map.tiles[other + static_cast<std::size_t>(x2)]) ++same;
      }
    }
    const double excess = (static_cast<double>(same) / cells - chance) / std::max(1.0 - chance, 1e-12);
    if (excess > worst.excess) worst = {excess, lag};
  }
  return worst;
}

PictureRepetition repetitionOf(const image::Image& linear, double pixelsPerTile, int lags) {
  const Field field = withoutLocalMean(linear, static_cast<int>(std::lround(pixelsPerTile)));
  PictureRepetition out{-1.0, -1.0, {}};
  const auto pixels = [pixelsPerTile](double tiles) { return static_cast<int>(std::lround(tiles * pixelsPerTile)); };
  for (const glm::ivec2 lag : halfPlane(lags)) {
    const double at = correlation(field, pixels(lag.x), pixels(lag.y));
    if (at > out.atTiles) {
      out.atTiles = at;
      out.lag = lag;
    }
    out.between = std::max(out.between, correlation(field, pixels(lag.x + 0.5), pixels(lag.y + 0.5)));
  }
  return out;
}

}  // namespace sward::report
