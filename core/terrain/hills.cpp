#include "terrain/hills.h"

#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace sward::terrain {
namespace {

constexpr int kSide = 1024;          ///< samples, whatever the octaves: some 30 ms on two cores
constexpr int kSamplesAFeature = 4;  ///< of the smallest octave: fewer alias
constexpr int kMaxOctaves = 7;       ///< 4 features of the largest size, 2^6 times as many of the smallest
constexpr double kNoisePeak = 0.70710678118654752;  ///< of gradient noise with unit gradients in two dimensions

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

/// Gradient noise that repeats after `cells` cells, in about [-1, 1].
class PeriodicNoise {
 public:
  PeriodicNoise(int cells, std::uint64_t seed) : m_cells(static_cast<std::size_t>(cells)) {
    m_gradients.reserve(m_cells * m_cells);
    for (std::size_t i = 0; i < m_cells * m_cells; ++i) {
      const double angle = 2.0 * std::numbers::pi * base::unitDouble(base::mix64(seed, i));
      m_gradients.emplace_back(std::cos(angle), std::sin(angle));
    }
  }

  /// At a place in cells within [0, cells) along both axes.
  double at(double x, double y) const {
    const auto cx = static_cast<std::size_t>(x), cy = static_cast<std::size_t>(y);
    const double fx = x - static_cast<double>(cx), fy = y - static_cast<double>(cy);
    const std::size_t nx = cx + 1 < m_cells ? cx + 1 : 0, ny = cy + 1 < m_cells ? cy + 1 : 0;
    const double u = fade(fx);
    const double south = std::lerp(dot(cx, cy, fx, fy), dot(nx, cy, fx - 1.0, fy), u);
    const double north = std::lerp(dot(cx, ny, fx, fy - 1.0), dot(nx, ny, fx - 1.0, fy - 1.0), u);
    return std::lerp(south, north, fade(fy)) / kNoisePeak;
  }

 private:
  double dot(std::size_t cx, std::size_t cy, double x, double y) const {
    const glm::dvec2& g = m_gradients[cy * m_cells + cx];
    return g.x * x + g.y * y;
  }
  std::size_t m_cells;
  std::vector<glm::dvec2> m_gradients;
};

/// From smooth hills to ridges where the noise changes its sign.
double folded(double noise, double ruggedness) {
  return std::lerp(noise, 1.0 - 2.0 * std::abs(noise), ruggedness);
}

Result<void> checkHills(const HillOptions& options) {
  const auto bad = [](const char* where, const char* what, const char* remedy) {
    return Error::badInput(what, std::string("terrain.hills.") + where, remedy);
  };
  if (!(options.featureSizeM > 0.0) || !std::isfinite(options.featureSizeM))
    return bad("featureSizeM", "the distance between hills is not above 0", "Give metres, such as 140.");
  if (!std::isfinite(options.amplitudeM)) return bad("amplitudeM", "the height is not a number", "Give metres.");
  if (options.octaves < 1 || options.octaves > kMaxOctaves)
    return bad("octaves", "the number of octaves is out of its range", "Give 1 to 7.");
  if (!(options.ruggedness >= 0.0 && options.ruggedness <= 1.0))
    return bad("ruggedness", "the ruggedness is out of its range", "Give 0 to 1.");
  return {};
}

}  // namespace

Result<HeightGrid> makeHills(const HillOptions& options, const JobContext& job) {
  SWARD_TRY(checkHills(options));
  const int features = std::min(kSide / kSamplesAFeature >> (options.octaves - 1), 32);
  HeightGrid grid;
  grid.columns = grid.rows = kSide;
  grid.border = Border::Repeat;
  grid.cellM = glm::dvec2(options.featureSizeM * features / kSide);
  grid.heights.resize(static_cast<std::size_t>(kSide) * kSide);
  std::vector<PeriodicNoise> octaves;
  for (int i = 0; i < options.octaves; ++i)
    octaves.emplace_back(features << i, base::mix64(options.seed, static_cast<std::uint64_t>(i)));
  const double gain = std::lerp(0.3, 0.55, options.ruggedness);
  constexpr std::size_t kRowsATime = 16;
  base::parallelFor(job, kSide, kRowsATime, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < kSide; ++x) {
        double sum = 0.0, share = 1.0;
        // Half a sample off the lattice, where all gradient noise is 0.
        double px = (static_cast<double>(x) + 0.5) * features / kSide,
               py = (static_cast<double>(y) + 0.5) * features / kSide;
        for (const PeriodicNoise& octave : octaves) {
          sum += share * folded(octave.at(px, py), options.ruggedness);
          share *= gain;
          px *= 2.0;
          py *= 2.0;
        }
        grid.heights[y * kSide + x] = static_cast<float>(sum);
      }
    }
  });
  if (job.cancelled()) return Error::cancelled();
  const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const double range = static_cast<double>(*high) - static_cast<double>(*low);
  const double scale = range > 0.0 ? options.amplitudeM / range : 0.0, zero = static_cast<double>(grid.heights[0]);
  for (float& h : grid.heights) h = static_cast<float>((static_cast<double>(h) - zero) * scale);
  return grid;
}

}  // namespace sward::terrain
