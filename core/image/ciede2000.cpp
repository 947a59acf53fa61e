#include "image/ciede2000.h"

#include "image/metrics_common.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace sward::image {

namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

double power7(double x) {
  return x * x * x * x * x * x * x;
}

// sqrt(C^7 / (C^7 + 25^7)), in equations 4 and 17.
double chromaShare(double chroma) {
  const double power = power7(chroma);
  return std::sqrt(power / (power + power7(25.0)));
}

// Equation 7: the angle in degrees in [0, 360), and 0 for greys.
double hueDeg(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  const double degrees = std::atan2(b, a) * 180.0 / std::numbers::pi;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

// Equation 10: the short way around, 0 where one of the colours is grey.
double hueStepDeg(double hue1, double hue2, double chromaProduct) {
  if (chromaProduct == 0.0) return 0.0;
  const double step = hue2 - hue1;
  if (step > 180.0) return step - 360.0;
  return step < -180.0 ? step + 360.0 : step;
}

// Equation 14: the mean on the short side; where one of the colours is grey, the sum is the hue of the other.
double meanHueDeg(double hue1, double hue2, double chromaProduct) {
  const double sum = hue1 + hue2;
  if (chromaProduct == 0.0) return sum;
  if (std::abs(hue1 - hue2) <= 180.0) return sum / 2.0;
  return sum < 360.0 ? (sum + 360.0) / 2.0 : (sum - 360.0) / 2.0;
}

}  // namespace

double ciede2000(const Lab& first, const Lab& second) {
  // Step 1, equations 2 to 7: a* is stretched near the grey axis.
  const double stretch =
      1.0 + 0.5 * (1.0 - chromaShare((std::hypot(first.a, first.b) + std::hypot(second.a, second.b)) / 2.0));
  const double a1 = stretch * first.a;
  const double a2 = stretch * second.a;
  const double chroma1 = std::hypot(a1, first.b);
  const double chroma2 = std::hypot(a2, second.b);
  const double hue1 = hueDeg(a1, first.b);
  const double hue2 = hueDeg(a2, second.b);

  // Step 2, equations 8 to 11.
  const double product = chroma1 * chroma2;
  const double lightnessStep = second.l - first.l;
  const double chromaStep = chroma2 - chroma1;
  const double hueStep = 2.0 * std::sqrt(product) * std::sin(radians(hueStepDeg(hue1, hue2, product)) / 2.0);

  // Step 3, equations 12 to 22.
  const double lightness = (first.l + second.l) / 2.0;
  const double chroma = (chroma1 + chroma2) / 2.0;
  const double hue = meanHueDeg(hue1, hue2, product);
  const double t = 1.0 - 0.17 * std::cos(radians(hue - 30.0)) + 0.24 * std::cos(radians(2.0 * hue)) +
                   0.32 * std::cos(radians(3.0 * hue + 6.0)) - 0.20 * std::cos(radians(4.0 * hue - 63.0));
  const double turnDeg = 30.0 * std::exp(-std::pow((hue - 275.0) / 25.0, 2.0));
  const double fromMiddle = (lightness - 50.0) * (lightness - 50.0);
  const double l = lightnessStep / (1.0 + 0.015 * fromMiddle / std::sqrt(20.0 + fromMiddle));
  const double c = chromaStep / (1.0 + 0.045 * chroma);
  const double h = hueStep / (1.0 + 0.015 * chroma * t);
  const double turn = -std::sin(radians(2.0 * turnDeg)) * 2.0 * chromaShare(chroma);
  return std::sqrt(std::max(0.0, l * l + c * c + h * h + turn * c * h));
}

Result<ColourDifference> colourDifference(const Image& referenceLinear, const Image& testLinear,
                                          const JobContext& job) {
  SWARD_TRY(checkComparable(referenceLinear, testLinear, ChannelNeed::Colour, job));
  std::vector<ColourDifference> rows(static_cast<std::size_t>(referenceLinear.height));
  forEachRow(job, referenceLinear.height, [&](int y) {
    ColourDifference& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < referenceLinear.width; ++x) {
      const double difference = ciede2000(labFromLinear(glm::dvec3(colourAt(referenceLinear, x, y))),
                                          labFromLinear(glm::dvec3(colourAt(testLinear, x, y))));
      row.mean += difference;
      row.max = std::max(row.max, difference);
    }
  });
  if (job.cancelled()) return Error::cancelled();
  ColourDifference whole;
  for (const ColourDifference& row : rows) {
    whole.mean += row.mean;
    whole.max = std::max(whole.max, row.max);
  }
  whole.mean /= static_cast<double>(referenceLinear.width) * static_cast<double>(referenceLinear.height);
  return whole;
}

}  // namespace sward::image
