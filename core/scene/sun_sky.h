#pragma once

#include "base/result.h"
#include "image/image.h"
#include "scene/options.h"

#include <glm/glm.hpp>

namespace sward::scene {

/// Sun angles from date, time and place (the low-precision solar coordinates of the Astronomical Almanac; about 0.01
/// degree, 1950 to 2050), with atmospheric refraction left out.
SunAngles sunAngles(const SunMoment& moment);
/// Unit vector toward the sun that the options give; an error for a date, hour or place that does not exist.
Result<glm::dvec3> sunDirection(const SunOptions& options);

/// Daylight of Preetham, Shirley and Smits (1999): sky radiance by Perez' formula, the sun through Rayleigh, aerosol
/// and ozone extinction at three wavelengths, in linear Rec. 709 RGB, scaled so that a clear noon's horizontal sun
/// irradiance is near pi. Fades to a dim blue as the sun sets; never negative or NaN for any direction and elevation;
/// turbidity is held in [1.7, 10], where the model was fitted.
class Daylight {
 public:
  Daylight(const glm::dvec3& sunDirection, const SunOptions& sun, const SkyOptions& sky);

  const glm::dvec3& sunDirection() const { return m_sunDirection; }
  /// Irradiance on a plane that faces the sun; zero once the sun is below the horizon.
  glm::dvec3 sunIrradiance() const { return m_sunIrradiance; }
  /// Radiance of the sky toward a unit direction (the sun's disc left out); below the horizon, that of the horizon.
  glm::dvec3 skyRadiance(const glm::dvec3& direction) const;
  /// Cosine-weighted mean sky radiance over the upper hemisphere: irradiance of a horizontal plane divided by pi.
  glm::dvec3 meanSkyRadiance() const { return m_meanSkyRadiance; }
  /// A latitude-longitude map of skyRadiance over the upper hemisphere: column u is azimuth 360 (u + 1/2) / width
  /// degrees clockwise from north, row v elevation 90 ((v + 1/2) / height)^2 degrees, row 0 at the horizon, so that the
  /// horizon is finely sampled.
  image::Image skyMap(int width, int height) const;
  /// Exposure that brings a horizontal grey of 18 % under this light to 0.18, or the mean sky near the horizon to 0.72
  /// where that asks for less: a low sun does not bleach the sky.
  double autoExposure() const;

 private:
  glm::dvec3 m_sunDirection;
  glm::dvec3 m_sunIrradiance{0.0};
  glm::dvec3 m_meanSkyRadiance{0.0};
  glm::dvec3 m_zenith{0.0};  ///< Y, x, y at the zenith
  glm::dvec3 m_perez[5];     ///< A to E, each for Y, x, y
  glm::dvec3 m_perezAtZenith{1.0};
  double m_skyScale = 1.0;
};

}  // namespace sward::scene
