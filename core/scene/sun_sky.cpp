#include "scene/sun_sky.h"

#include "image/colour.h"
#include "scene/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sward::scene {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = kPi / 180.0;
/// Illuminance of the sun outside the atmosphere (klx) and its colour, the black body of 5778 K in Rec. 709.
constexpr double kSolarKilolux = 128.0;
const glm::dvec3 kSolarColour{1.113, 0.975, 0.913};
/// Kilolux that count as an irradiance of pi: about a clear noon's, so that a white plane's radiance is near 1.
constexpr double kKiloluxOfPi = 100.0;
constexpr double kSunRadiusDeg = 0.27;

/// CIE xyY to linear Rec. 709.
glm::dvec3 rgbFromXyY(double x, double y, double luminance) {
  const double X = luminance * x / y;
  const double Z = luminance * (1.0 - x - y) / y;
  return {3.2404542 * X - 1.5371385 * luminance - 0.4985314 * Z, -0.9692660 * X + 1.8760108 * luminance + 0.0415560 * Z,
          0.0556434 * X - 0.2040259 * luminance + 1.0572252 * Z};
}

/// Zenith Y (kcd/m^2), x, y of Preetham et al. (1999), appendix A.2; theta is the sun's angle from the zenith.
glm::dvec3 zenithColour(double turbidity, double theta) {
  const double t = turbidity;
  const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * theta);
  const double luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  const double t2 = theta * theta;
  const double t3 = t2 * theta;
  const auto row = [&](double c3, double c2, double c1, double c0) { return c3 * t3 + c2 * t2 + c1 * theta + c0; };
  const double x = t * t * row(0.00166, -0.00375, 0.00209, 0.0) + t * row(-0.02903, 0.06377, -0.03202, 0.00394) +
                   row(0.11693, -0.21196, 0.06052, 0.25886);
  const double y = t * t * row(0.00275, -0.00610, 0.00317, 0.0) + t * row(-0.04214, 0.08970, -0.04153, 0.00516) +
                   row(0.15346, -0.26756, 0.06670, 0.26688);
  return {std::max(luminance, 0.0), x, y};
}

/// Perez' distribution (1993), per component; cosTheta of the view from the zenith, gamma its angle to the sun.
glm::dvec3 perez(const glm::dvec3 (&c)[5], double cosTheta, double gamma) {
  const double cosGamma = std::cos(gamma);
  glm::dvec3 value;
  for (int i = 0; i < 3; ++i) {
    value[i] = (1.0 + c[0][i] * std::exp(c[1][i] / cosTheta)) *
               (1.0 + c[2][i] * std::exp(c[3][i] * gamma) + c[4][i] * cosGamma * cosGamma);
  }
  return value;
}

/// Transmittance of the direct sun at the wavelengths of red, green and blue (Preetham et al., appendix A.1): Rayleigh,
/// aerosol (Angstrom, alpha 1.3) and ozone (0.35 cm); gas and water absorb next to nothing at these three.
glm::dvec3 directTransmittance(double turbidity, double elevationDeg) {
  static constexpr std::array wavelengthUm{0.610, 0.550, 0.465};
  static constexpr std::array ozonePerCm{0.125, 0.085, 0.010};
  const double zenithDeg = std::min(90.0 - elevationDeg, 90.5);
  const double airMass = 1.0 / (std::cos(zenithDeg * kDegrees) + 0.15 * std::pow(93.885 - zenithDeg, -1.253));
  const double beta = std::max(0.04608365822050 * turbidity - 0.04586025928522, 0.0);
  glm::dvec3 transmittance;
  for (int i = 0; i < 3; ++i) {
    const double lambda = wavelengthUm[static_cast<std::size_t>(i)];
    const double optical = 0.008735 * std::pow(lambda, -4.08) + beta * std::pow(lambda, -1.3) +
                           0.35 * ozonePerCm[static_cast<std::size_t>(i)];
    transmittance[i] = std::exp(-optical * airMass);
  }
  return transmittance;
}

/// 1 by day; after sunset the sky's luminance falls by about 400 over six degrees of depression (civil twilight).
double twilightFactor(double elevationDeg) {
  return elevationDeg >= 0.0 ? 1.0 : std::max(std::exp(std::log(400.0) * elevationDeg / 6.0), 1e-5);
}

}  // namespace

Daylight::Daylight(const glm::dvec3& sun, const SunOptions& sunOptions, const SkyOptions& sky)
    : m_sunDirection(glm::normalize(sun)) {
  const double turbidity = std::clamp(sky.turbidity, 1.7, 10.0);
  const double elevationDeg = std::asin(std::clamp(m_sunDirection.z, -1.0, 1.0)) / kDegrees;
  const double theta = (90.0 - std::clamp(elevationDeg, 0.0, 90.0)) * kDegrees;
  const double t = turbidity;
  // Perez coefficients for Y, x, y (Preetham et al., appendix A.2).
  m_perez[0] = {0.1787 * t - 1.4630, -0.0193 * t - 0.2592, -0.0167 * t - 0.2608};
  m_perez[1] = {-0.3554 * t + 0.4275, -0.0665 * t + 0.0008, -0.0950 * t + 0.0092};
  m_perez[2] = {-0.0227 * t + 5.3251, -0.0004 * t + 0.2125, -0.0079 * t + 0.2102};
  m_perez[3] = {0.1206 * t - 2.5771, -0.0641 * t - 0.8989, -0.0441 * t - 1.6537};
  m_perez[4] = {-0.0670 * t + 0.3703, -0.0033 * t + 0.0452, -0.0109 * t + 0.0529};
  m_zenith = zenithColour(turbidity, theta);
  m_perezAtZenith = perez(m_perez, 1.0, theta);
  m_skyScale = sky.intensity * twilightFactor(elevationDeg) * kPi / kKiloluxOfPi;

  const double disc = std::clamp((elevationDeg + kSunRadiusDeg) / (2.0 * kSunRadiusDeg), 0.0, 1.0);
  const double risen = disc * disc * (3.0 - 2.0 * disc);
  m_sunIrradiance = sunOptions.intensity * risen * kSolarKilolux * kPi / kKiloluxOfPi * kSolarColour *
                    directTransmittance(turbidity, std::max(elevationDeg, 0.0));

  constexpr int kDirections = 512;
  for (const glm::dvec3& direction : fibonacciHemisphere(kDirections)) {
    m_meanSkyRadiance += skyRadiance(direction) * direction.z;
  }
  m_meanSkyRadiance *= 2.0 / kDirections;  // (1/pi) integral of L cos over 2 pi / N each
}

glm::dvec3 Daylight::skyRadiance(const glm::dvec3& direction) const {
  // The formula has a pole at the horizon; half a degree above it is near enough.
  const double cosTheta = std::max(direction.z, 0.008);
  const glm::dvec3 flat = glm::normalize(glm::dvec3(direction.x, direction.y, std::max(direction.z, 0.0)) + 1e-12);
  glm::dvec3 sun = m_sunDirection;
  if (sun.z < 0.0) sun = glm::normalize(glm::dvec3(sun.x, sun.y, 0.0) + glm::dvec3(0.0, 0.0, 1e-9));
  const double gamma = std::acos(std::clamp(glm::dot(flat, sun), -1.0, 1.0));
  const glm::dvec3 relative = perez(m_perez, cosTheta, gamma) / m_perezAtZenith;
  const double luminance = m_zenith.x * relative.x;
  const double x = m_zenith.y * relative.y;
  const double y = std::max(m_zenith.z * relative.z, 1e-3);
  return m_skyScale * glm::max(rgbFromXyY(x, y, std::max(luminance, 0.0)), glm::dvec3(0.0));
}

image::Image Daylight::skyMap(int width, int height) const {
  image::Image map(width, height, 3);
  for (int row = 0; row < height; ++row) {
    const double s = (row + 0.5) / height;
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 radiance = skyRadiance(directionFromAngles({360.0 * (column + 0.5) / width, 90.0 * s * s}));
      for (int c = 0; c < 3; ++c) map.at(column, row, c) = static_cast<float>(radiance[c]);
    }
  }
  return map;
}

double Daylight::autoExposure() const {
  const glm::dvec3 irradiance = m_sunIrradiance * std::max(m_sunDirection.z, 0.0) + kPi * m_meanSkyRadiance;
  const double grey = 0.18 / kPi * static_cast<double>(image::luminance(glm::vec3(irradiance)));
  constexpr int kAzimuths = 32;
  constexpr double kMeteredElevationDeg = 8.0;
  double horizon = 0.0;
  for (int i = 0; i < kAzimuths; ++i) {
    const glm::dvec3 radiance = skyRadiance(directionFromAngles({360.0 * i / kAzimuths, kMeteredElevationDeg}));
    horizon += static_cast<double>(image::luminance(glm::vec3(radiance))) / kAzimuths;
  }
  // A sky that would stand more than two stops over mid-grey is metered instead, as a photographer would at dusk.
  const double metered = std::max(grey, 0.25 * horizon);
  return metered > 0.0 ? 0.18 / metered : 1.0;
}

}  // namespace sward::scene
