#include "image/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace sward::image {

namespace {

// A Gaussian of the paper's form a sqrt(pi / b) exp(-pi^2 r^2 / b), r in degrees, and its values.
struct SensitivityTerm {
  double a;
  double b;
};
constexpr SensitivityTerm kAchromatic{1.0, 0.0047};
constexpr SensitivityTerm kRedGreen{1.0, 0.0053};
constexpr SensitivityTerm kBlueYellow1{34.1, 0.04};
constexpr SensitivityTerm kBlueYellow2{13.5, 0.025};

// Width of the edge that people detect best, in degrees.
constexpr double kFeatureWidthDeg = 0.082;

using Weights = std::vector<double>;

// The factor of the term along one axis: sqrt(a sqrt(pi / b)) exp(-pi^2 x^2 / b), whose product over x and y is the
// term.
Weights sampled(const SensitivityTerm& term, int radius, double pixelsPerDegree) {
  constexpr double kPi = std::numbers::pi;
  const double amplitude = std::sqrt(term.a * std::sqrt(kPi / term.b));
  Weights weights;
  for (int i = -radius; i <= radius; ++i) {
    const double degrees = i / pixelsPerDegree;
    weights.push_back(amplitude * std::exp(-kPi * kPi * degrees * degrees / term.b));
  }
  return weights;
}

double sum(const Weights& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

FlipKernel scaled(const Weights& weights, double factor) {
  FlipKernel kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight * factor));
  return kernel;
}

// Positive weights sum to 1 and negative ones to -1.
FlipKernel balanced(const Weights& weights) {
  double positive = 0.0;
  double negative = 0.0;
  for (const double weight : weights) (weight > 0.0 ? positive : negative) += std::abs(weight);
  FlipKernel kernel;
  for (const double weight : weights) {
    kernel.push_back(static_cast<float>(weight / (weight > 0.0 ? positive : negative)));
  }
  return kernel;
}

}  // namespace

FlipFilters::FlipFilters(double pixelsPerDegree) {
  // Three standard deviations of the widest term: exp(-pi^2 x^2 / b) has sigma^2 = b / (2 pi^2).
  constexpr double kPi = std::numbers::pi;
  const int spatial =
      static_cast<int>(std::ceil(3.0 * std::sqrt(kBlueYellow1.b / (2.0 * kPi * kPi)) * pixelsPerDegree));
  const Weights a = sampled(kAchromatic, spatial, pixelsPerDegree);
  const Weights rg = sampled(kRedGreen, spatial, pixelsPerDegree);
  const Weights by1 = sampled(kBlueYellow1, spatial, pixelsPerDegree);
  const Weights by2 = sampled(kBlueYellow2, spatial, pixelsPerDegree);
  achromatic = scaled(a, 1.0 / sum(a));
  redGreen = scaled(rg, 1.0 / sum(rg));
  // The plane's weights of a product sum to the square of the row's: one factor brings the sum of both products to 1.
  const double blueYellowScale = 1.0 / std::hypot(sum(by1), sum(by2));
  blueYellowWide = scaled(by1, blueYellowScale);
  blueYellowNarrow = scaled(by2, blueYellowScale);

  const double sigma = 0.5 * kFeatureWidthDeg * pixelsPerDegree;
  const int feature = static_cast<int>(std::ceil(3.0 * sigma));
  Weights gaussian;
  Weights first;
  Weights second;
  for (int i = -feature; i <= feature; ++i) {
    const double g = std::exp(-0.5 * i * i / (sigma * sigma));
    gaussian.push_back(g);
    first.push_back(-i * g);
    second.push_back((i * i / (sigma * sigma) - 1.0) * g);
  }
  smooth = scaled(gaussian, 1.0 / sum(gaussian));
  edge = balanced(first);
  point = balanced(second);
}

FlipPlane::FlipPlane(int columns, int lines)
    : width(columns), rows(lines), values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(lines), 0.0f) {}

void addFiltered(const FlipPlane& in, int halo, const FlipKernel& alongX, const FlipKernel& alongY, FlipPlane& out) {
  const int radius = static_cast<int>(alongX.size()) / 2;
  const std::size_t width = static_cast<std::size_t>(in.width);
  FlipPlane filteredX(in.width, out.rows + 2 * radius);
  std::vector<float> padded(width + 2 * static_cast<std::size_t>(radius));
  for (int y = 0; y < filteredX.rows; ++y) {
    const float* source = in.row(y + halo - radius);
    std::fill_n(padded.begin(), radius, source[0]);
    std::copy_n(source, width, padded.begin() + radius);
    std::fill_n(padded.end() - radius, radius, source[width - 1]);
    float* target = filteredX.row(y);
    for (std::size_t k = 0; k < alongX.size(); ++k) {
      const float weight = alongX[k];
      const float* shifted = padded.data() + k;
      for (std::size_t x = 0; x < width; ++x) target[x] += weight * shifted[x];
    }
  }
  for (int y = 0; y < out.rows; ++y) {
    float* target = out.row(y);
    for (std::size_t k = 0; k < alongY.size(); ++k) {
      const float weight = alongY[k];
      const float* source = filteredX.row(y + static_cast<int>(k));
      for (std::size_t x = 0; x < width; ++x) target[x] += weight * source[x];
    }
  }
}

}  // namespace sward::image
