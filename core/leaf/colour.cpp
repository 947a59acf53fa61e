#include "leaf/colour.h"

#include "image/colour.h"

#include <algorithm>
#include <array>

namespace sward::leaf {
namespace {

using Weights = std::array<glm::dvec3, kSamples>;

Weights xyzWeights() {
  Weights weights;
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Observer observer = observerAt(wavelengthNm(i));
    weights[i] = daylightAt(wavelengthNm(i)) * glm::dvec3(observer.x, observer.y, observer.z);
    sum += weights[i];
  }
  for (glm::dvec3& w : weights) w *= image::kWhiteXyz / sum;
  return weights;
}

glm::dvec3 weighted(const Spectrum& spectrum, const Weights& weights) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < kSamples; ++i) sum += spectrum[i] * weights[i];
  return sum;
}

}  // namespace

glm::dvec3 xyzFromSpectrum(const Spectrum& spectrum) {
  static const Weights weights = xyzWeights();
  return weighted(spectrum, weights);
}

glm::dvec3 linearFromSpectrum(const Spectrum& spectrum) {
  return image::linearFromXyz(xyzFromSpectrum(spectrum));
}

GamutColour intoGamut(const glm::dvec3& linear) {
  const double luminance = std::clamp(image::xyzFromLinear(linear).y, 0.0, 1.0);
  double kept = 1.0;
  for (int c = 0; c < 3; ++c) {
    const double step = linear[c] - luminance;
    if (linear[c] < 0.0) kept = std::min(kept, luminance / -step);
    if (linear[c] > 1.0) kept = std::min(kept, (1.0 - luminance) / step);
  }
  if (kept == 1.0) return {linear, 0.0};
  kept = std::clamp(kept, 0.0, 1.0);
  return {glm::clamp(glm::dvec3(luminance) + kept * (linear - luminance), 0.0, 1.0), 1.0 - kept};
}

}  // namespace sward::leaf
