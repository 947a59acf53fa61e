#include "leaf/fit_contents.h"

#include "leaf/simplex.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sward::leaf {
namespace {

constexpr int kEvaluations = 3000;
constexpr double kStep = 0.4;

/// How much of a sample is seen, and a little everywhere: beyond 690 nm a leaf's reflectance rises eightfold within
/// 50 nm, which would rule the fit and is hardly visible.
const Spectrum& fitWeights() {
  static const Spectrum weights = [] {
    Spectrum w{};
    for (std::size_t i = 0; i < kSamples; ++i) {
      const Observer seen = observerAt(wavelengthNm(i));
      w[i] = 0.05 + seen.x + seen.y + seen.z;
    }
    return w;
  }();
  return weights;
}

double weightedDistance(const Spectrum& a, const Spectrum& b) {
  const Spectrum& weights = fitWeights();
  double sum = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) sum += weights[i] * (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

double rootMeanSquare(const Spectrum& a, const Spectrum& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(kSamples));
}

double greatestDistance(const Spectrum& a, const Spectrum& b) {
  double greatest = 0.0;
  for (std::size_t i = 0; i < kSamples; ++i) greatest = std::max(greatest, std::abs(a[i] - b[i]));
  return greatest;
}

// Logarithms keep contents above 0 and give the simplex steps of like size; the upper ends are those of checkContents.
// What is far below all effect is none: the simplex walks on towards it without end.
double content(double logarithm, double most) {
  constexpr double kNone = 1e-5;
  const double value = std::exp(logarithm);
  return value < kNone ? 0.0 : std::min(value, most);
}

LeafContents contentsOf(const std::vector<double>& logs) {
  LeafContents c;
  c.structure = 1.0 + content(logs[0], 3.0);
  c.chlorophyll = content(logs[1], 1000.0);
  c.carotenoid = content(logs[2], 1000.0);
  c.brown = content(logs[3], 100.0);
  c.dryMatter = content(logs[4], 1.0);
  c.waterCm = 0.0;
  return c;
}

double share(double logit) {
  return 1.0 / (1.0 + std::exp(-logit));
}

LeafOptions subtractionOf(const std::vector<double>& p) {
  LeafOptions options;
  options.model = LeafOptions::Model::Subtraction;
  options.subtractionTransmission = 0.0;
  options.subtractionLevel = share(p[0]);
  options.subtractionStrength = std::min(std::exp(p[1]), 100.0);
  return options;
}

}  // namespace

FittedContents fitContents(const Spectrum& reflectance, const Spectrum* transmittance) {
  const auto spectraOf = [](const std::vector<double>& logs) {
    return leafSpectra(contentsOf(logs), Calibration::ProspectD, kSurfaceKept);
  };
  const auto misfit = [&](const std::vector<double>& logs) {
    const Result<LeafSpectra> s = spectraOf(logs);
    if (!s.ok()) return std::numeric_limits<double>::infinity();
    return weightedDistance(s->reflectance, reflectance) +
           (transmittance != nullptr ? weightedDistance(s->transmittance, *transmittance) : 0.0);
  };
  // From a green leaf and from a dry one: between them the misfit has a ridge.
  const std::vector<double> starts[] = {{std::log(0.5), std::log(30.0), std::log(6.0), std::log(0.02), std::log(0.005)},
                                        {std::log(2.0), std::log(0.5), std::log(3.0), std::log(0.5), std::log(0.005)}};
  std::vector<double> best;
  for (const auto& start : starts) {
    const std::vector<double> found = minimumOf(misfit, start, kStep, kEvaluations / 2);
    if (best.empty() || misfit(found) < misfit(best)) best = found;
  }
  FittedContents fitted{contentsOf(best), spectraOf(best).value(), 0.0, 0.0};
  fitted.rmse = rootMeanSquare(fitted.spectra.reflectance, reflectance);
  fitted.max = greatestDistance(fitted.spectra.reflectance, reflectance);
  return fitted;
}

FittedSubtraction fitSubtraction(const Spectrum& reflectance) {
  const auto misfit = [&](const std::vector<double>& p) {
    const Result<SubtractionSpectra> s = subtractionSpectra(subtractionOf(p), share(p[2]));
    return s.ok() ? weightedDistance(s->reflectance, reflectance) : std::numeric_limits<double>::infinity();
  };
  std::vector<double> best;
  for (const double chlorophyll : {2.0, -3.0}) {
    const std::vector<double> found = minimumOf(misfit, {-1.0, 0.0, chlorophyll}, kStep, kEvaluations / 2);
    if (best.empty() || misfit(found) < misfit(best)) best = found;
  }
  const LeafOptions options = subtractionOf(best);
  FittedSubtraction fitted{options.subtractionLevel,
                           options.subtractionStrength,
                           share(best[2]),
                           subtractionSpectra(options, share(best[2])).value(),
                           0.0,
                           0.0};
  fitted.rmse = rootMeanSquare(fitted.spectra.reflectance, reflectance);
  fitted.max = greatestDistance(fitted.spectra.reflectance, reflectance);
  return fitted;
}

}  // namespace sward::leaf
