#include "image/flip.h"

#include "image/colour.h"
#include "image/flip_map.h"
#include "image/metrics_common.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace sward::image {

namespace {

constexpr double kLeastPixelsPerDegree = 1.0;
constexpr double kGreatestPixelsPerDegree = 1000.0;
constexpr double kMappedTarget = 0.85;  // what the first and last exposure of the paper of 2021 aim at

/// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5) per value.
struct RationalCurve {
  double k0, k1, k3, k4, k5;

  double operator()(double x) const { return (k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5); }
  // The x >= 0 whose image is t: the greater root of (k0 - t k3) x^2 + (k1 - t k4) x - t k5.
  double inverse(double t) const {
    const double half = 0.5 * (k1 - t * k4) / (k0 - t * k3);
    return -half + std::sqrt(half * half + t * k5 / (k0 - t * k3));
  }
};

// Narkowicz's (2.51 x^2 + 0.03 x) / (2.43 x^2 + 0.59 x + 0.14) of x exposed by 0.6.
constexpr RationalCurve kAces{0.36 * 2.51, 0.6 * 0.03, 0.36 * 2.43, 0.6 * 0.59, 0.14};

// Hable's ((x (A x + C B) + D E) / (x (A x + B) + D F)) - E / F with A to F below, of x exposed by 2, over that
// of 11.2.
RationalCurve hable() {
  constexpr double kA = 0.15, kB = 0.50, kC = 0.10, kD = 0.20, kE = 0.02, kF = 0.30, kWhite = 11.2;
  const RationalCurve plain{kA * kF - kA * kE, kC * kB * kF - kB * kE, kA * kF, kB * kF, kD * kF * kF};
  const double scale = 1.0 / plain(kWhite);
  return {4.0 * plain.k0 * scale, 2.0 * plain.k1 * scale, 4.0 * plain.k3, 2.0 * plain.k4, plain.k5};
}

double exactLuminance(const glm::dvec3& linear) {
  return 0.2126 * linear.x + 0.7152 * linear.y + 0.0722 * linear.z;
}

/// Exposes linear values and maps them to the display.
class ToneMap {
 public:
  explicit ToneMap(FlipToneMapper mapper)
      : m_mapper(mapper), m_curve(mapper == FlipToneMapper::Hable ? hable() : kAces) {}

  glm::vec3 operator()(const glm::vec3& linear, double factor) const {
    const glm::dvec3 x = glm::max(glm::dvec3(linear), 0.0) * factor;
    const glm::dvec3 mapped = m_mapper == FlipToneMapper::Reinhard
                                  ? x / (1.0 + exactLuminance(x))
                                  : glm::dvec3(m_curve(x.x), m_curve(x.y), m_curve(x.z));
    return glm::vec3(glm::clamp(mapped, 0.0, 1.0));
  }
  // The linear grey that is shown as t.
  double inverse(double t) const { return m_mapper == FlipToneMapper::Reinhard ? t / (1.0 - t) : m_curve.inverse(t); }

 private:
  FlipToneMapper m_mapper;
  RationalCurve m_curve;
};

Result<void> checkPixelsPerDegree(double value) {
  if (value >= kLeastPixelsPerDegree && value <= kGreatestPixelsPerDegree) return {};
  return Error::badInput("pixels per degree are " + std::to_string(value), "FLIP",
                         "Give 1 to 1000; 67.02 is a 4K screen of 0.7 m from 0.7 m.");
}

Result<void> checkExposures(const FlipExposures& exposures) {
  const std::string range = std::to_string(exposures.count) + " exposures from " + std::to_string(exposures.start) +
                            " to " + std::to_string(exposures.stop) + " stops";
  if (exposures.count < 1 || exposures.count > kMaxFlipExposures) {
    return Error::badInput(range + ": their number must be 1 to " + std::to_string(kMaxFlipExposures), "HDR-FLIP",
                           "State a range of exposures that people would look at.");
  }
  const bool inRange = exposures.start >= -kMaxFlipExposure && exposures.stop <= kMaxFlipExposure;
  if (inRange && exposures.start <= exposures.stop) return {};
  return Error::badInput(range + ": no such range", "HDR-FLIP",
                         "Start at or below the stop, both within 256 stops of 0.");
}

// `map` makes displayed linear RGB of the image's own values.
template <typename Map>
ShownColour shownBy(const Image& image, Map map) {
  return [&image, map](int x, int y) { return map(colourAt(image, x, y)); };
}

double meanOf(const Image& map) {
  return sumOf(map) / (static_cast<double>(map.width) * static_cast<double>(map.height));
}

// Keeps the greater of both values and the exposure at which it was met first.
void keepGreatest(const Image& errors, double stops, HdrFlipError& result) {
  for (std::size_t i = 0; i < errors.pixels.size(); ++i) {
    if (errors.pixels[i] <= result.map.pixels[i]) continue;
    result.map.pixels[i] = errors.pixels[i];
    result.exposure.pixels[i] = static_cast<float>(stops);
  }
}

}  // namespace

double pixelsPerDegree(double distanceM, double screenWidthM, double screenWidthPixels) {
  return distanceM * screenWidthPixels / screenWidthM * std::numbers::pi / 180.0;
}

Result<FlipError> flip(const Image& referenceDisplay, const Image& testDisplay, const FlipOptions& options,
                       const JobContext& job) {
  SWARD_TRY(checkPixelsPerDegree(options.pixelsPerDegree));
  SWARD_TRY(checkComparable(referenceDisplay, testDisplay, ChannelNeed::Colour, job));
  const auto decode = [](const glm::vec3& encoded) { return linearFromSrgb(glm::clamp(encoded, 0.0f, 1.0f)); };
  FlipError result{0.0, Image(referenceDisplay.width, referenceDisplay.height, 1)};
  fillFlipMap(shownBy(referenceDisplay, decode), shownBy(testDisplay, decode), options.pixelsPerDegree, job,
              result.map);
  if (job.cancelled()) return Error::cancelled();
  result.mean = meanOf(result.map);
  return result;
}

Result<FlipExposures> flipExposures(const Image& referenceLinear, FlipToneMapper toneMapper, const JobContext& job) {
  SWARD_TRY(checkComparable(referenceLinear, referenceLinear, ChannelNeed::Colour, job));
  std::vector<double> luminances;
  luminances.reserve(referenceLinear.pixels.size() / static_cast<std::size_t>(referenceLinear.channels));
  for (int y = 0; y < referenceLinear.height; ++y) {
    for (int x = 0; x < referenceLinear.width; ++x) {
      luminances.push_back(exactLuminance(glm::max(glm::dvec3(colourAt(referenceLinear, x, y)), 0.0)));
    }
  }
  const double greatest = *std::max_element(luminances.begin(), luminances.end());
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double median = *middle;
  if (!(median > 0.0)) {
    const char* what = greatest > 0.0 ? "half of the image is black" : "the image is black";
    return Error::badInput(std::string(what) + ": HDR-FLIP's exposures cannot be derived from it", "reference image",
                           "State the exposures (start, stop and count), or compare a brighter part.");
  }
  const double target = ToneMap(toneMapper).inverse(kMappedTarget);
  FlipExposures exposures{std::log2(target / greatest), std::log2(target / median), 2};
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop - exposures.start)));
  SWARD_TRY(checkExposures(exposures));
  return exposures;
}

Result<HdrFlipError> hdrFlip(const Image& referenceLinear, const Image& testLinear, const HdrFlipOptions& options,
                             const JobContext& job) {
  SWARD_TRY(checkPixelsPerDegree(options.pixelsPerDegree));
  SWARD_TRY(checkComparable(referenceLinear, testLinear, ChannelNeed::Colour, job));
  HdrFlipError result;
  if (options.exposures) {
    SWARD_TRY(checkExposures(*options.exposures));
    result.exposures = *options.exposures;
  } else {
    SWARD_ASSIGN(result.exposures, flipExposures(referenceLinear, options.toneMapper, job));
  }
  const FlipExposures& range = result.exposures;
  const ToneMap toneMap(options.toneMapper);
  result.map = Image(referenceLinear.width, referenceLinear.height, 1);
  result.exposure = Image(referenceLinear.width, referenceLinear.height, 1, static_cast<float>(range.start));
  Image errors(referenceLinear.width, referenceLinear.height, 1);
  for (int i = 0; i < range.count; ++i) {
    const double stops = range.start + i * (range.stop - range.start) / std::max(range.count - 1, 1);
    const auto expose = [&, factor = std::exp2(stops)](const glm::vec3& linear) { return toneMap(linear, factor); };
    fillFlipMap(shownBy(referenceLinear, expose), shownBy(testLinear, expose), options.pixelsPerDegree, job, errors);
    if (job.cancelled()) return Error::cancelled();
    keepGreatest(errors, stops, result);
  }
  result.mean = meanOf(result.map);
  return result;
}

}  // namespace sward::image
