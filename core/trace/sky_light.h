#pragma once

#include "scene/sun_sky.h"

#include <optional>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/trace: sun and sky as lights.
namespace sward::trace {

/// A direction toward a light and what to multiply the response to unit irradiance from there with (radiance over the
/// density of the direction; for the sun irradiance).
struct LightSample {
  glm::dvec3 direction{0.0, 0.0, 1.0};
  glm::dvec3 weight{0.0};
};

/// The sky as a light: cells of equal solid angle over the upper hemisphere, each of its mean radiance (four points a
/// cell), chosen by their luminance. Measured against the formula itself: the irradiance of a plane in any attitude
/// differs by less than 0.1 % (a test holds it).
class SkyLight {
 public:
  /// `uniform` replaces the daylight's sky by one radiance.
  SkyLight(const scene::Daylight& daylight, const std::optional<glm::dvec3>& uniform);

  bool dark() const { return m_rowEnds.empty(); }
  /// From two numbers in [0, 1).
  LightSample sample(const glm::dvec2& u) const;

 private:
  std::vector<double> m_rowEnds;   ///< cumulated chance of rows of cells, from the horizon up
  std::vector<double> m_cellEnds;  ///< [row][column], cumulated within the row
  std::vector<glm::dvec3> m_weights;
};

/// The sun as a disc, uniform over its solid angle, of radiance E / (pi sin^2 R): an open plane receives E n.s.
class SunLight {
 public:
  SunLight(const scene::Daylight& daylight, double radiusDeg);
  bool dark() const { return m_irradiance == glm::dvec3(0.0); }
  /// From two numbers in [0, 1). What a disc has under the horizon is mirrored above it: sunIrradiance() counts the
  /// part that has risen alone.
  LightSample sample(const glm::dvec2& u) const;

 private:
  glm::dvec3 m_direction, m_across, m_along;
  glm::dvec3 m_irradiance;
  double m_cap = 0.0;  ///< 1 - cos R
};

/// The sky's radiance at the horizon by azimuth, from a table of 1024 entries, linear between them.
class HorizonSky {
 public:
  HorizonSky(const scene::Daylight& daylight, const std::optional<glm::dvec3>& uniform);
  glm::dvec3 at(const glm::dvec2& direction) const;

 private:
  std::vector<glm::dvec3> m_radiance;
};

}  // namespace sward::trace
