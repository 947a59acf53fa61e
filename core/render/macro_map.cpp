#include "render/macro_map.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

constexpr std::uint64_t kSeed = 0x5eed;
constexpr double kFineRatio = 3.7;   ///< of the second octave's frequency to the first's
constexpr double kFineShare = 0.35;  ///< of its strength

/// Smooth value noise along a periodic axis: lattice points before and after, and the blend between.
struct LatticePlace {
  std::uint64_t before = 0, after = 0;
  double blend = 0.0;
};

std::vector<LatticePlace> latticeOf(int cells, int points) {
  std::vector<LatticePlace> places(static_cast<std::size_t>(cells));
  for (int i = 0; i < cells; ++i) {
    const double place = (i + 0.5) / cells * points;
    const double f = place - std::floor(place);
    const auto before = static_cast<std::uint64_t>(place);
    places[static_cast<std::size_t>(i)] = {before, (before + 1) % static_cast<std::uint64_t>(points),
                                           f * f * (3.0 - 2.0 * f)};
  }
  return places;
}

double latticeValue(std::uint64_t octave, std::uint64_t x, std::uint64_t y) {
  return 2.0 * base::unitDouble(base::mix64(kSeed, octave, x, y)) - 1.0;
}

/// Adds an octave of noise in [-strength, strength] to `out`.
void addOctave(std::vector<float>& out, int width, int height, double pointsPerCell, double strength,
               std::uint64_t octave) {
  const auto points = [&](int cells) { return std::max(static_cast<int>(std::lround(cells * pointsPerCell)), 1); };
  const auto columns = latticeOf(width, points(width));
  const auto rows = latticeOf(height, points(height));
  std::size_t at = 0;
  for (const LatticePlace& row : rows) {
    for (const LatticePlace& column : columns) {
      const double south = std::lerp(latticeValue(octave, column.before, row.before),
                                     latticeValue(octave, column.after, row.before), column.blend);
      const double north = std::lerp(latticeValue(octave, column.before, row.after),
                                     latticeValue(octave, column.after, row.after), column.blend);
      out[at++] += static_cast<float>(strength * std::lerp(south, north, row.blend));
    }
  }
}

std::vector<float> noise(int width, int height, double pointsPerCell, double strength, std::uint64_t seed) {
  std::vector<float> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);
  addOctave(out, width, height, pointsPerCell, strength * (1.0 - kFineShare), 2 * seed);
  addOctave(out, width, height, pointsPerCell * kFineRatio, strength * kFineShare, 2 * seed + 1);
  return out;
}

int wrapped(int i, int period) {
  return (i % period + period) % period;
}

std::uint32_t deviationByte(float deviation) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(128.0f * (1.0f + deviation), 0.0f, 255.0f)));
}

std::vector<std::uint32_t> withBorder(const std::vector<std::uint32_t>& words, int width, int height) {
  std::vector<std::uint32_t> out;
  out.reserve(static_cast<std::size_t>(width + 2 * kMapBorder) * static_cast<std::size_t>(height + 2 * kMapBorder));
  for (int y = -kMapBorder; y < height + kMapBorder; ++y) {
    const std::size_t row = static_cast<std::size_t>(wrapped(y, height)) * static_cast<std::size_t>(width);
    for (int x = -kMapBorder; x < width + kMapBorder; ++x)
      out.push_back(words[row + static_cast<std::size_t>(wrapped(x, width))]);
  }
  return out;
}

}  // namespace

std::vector<std::uint32_t> makeMacroMap(const tiles::TileMap& map, double tileSideM, const MacroSettings& settings) {
  std::vector<std::uint32_t> words(map.tiles.begin(), map.tiles.end());
  const double pointsPerCell = tileSideM / std::max(settings.scaleM, tileSideM);
  const auto brightness = noise(map.width, map.height, pointsPerCell, settings.variation, 0);
  const auto hue = noise(map.width, map.height, pointsPerCell, settings.variation, 1);
  for (std::size_t i = 0; i < words.size(); ++i)
    words[i] |= (deviationByte(brightness[i]) << 8) | (deviationByte(hue[i]) << 16);
  return withBorder(words, map.width, map.height);
}

}  // namespace sward::render
