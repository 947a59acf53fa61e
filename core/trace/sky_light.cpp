#include "trace/sky_light.h"

#include "image/colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sward::trace {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRows = 96, kColumns = 192;  ///< of the sky's cells
constexpr int kHorizon = 1024;

glm::dvec3 upward(double height, double turn) {
  const double radius = std::sqrt(std::max(0.0, (1.0 - height) * (1.0 + height)));
  return {radius * std::sin(2.0 * kPi * turn), radius * std::cos(2.0 * kPi * turn), height};
}

glm::dvec3 meanRadiance(const scene::Daylight& daylight, int row, int column) {
  glm::dvec3 sum(0.0);
  for (const double z : {0.25, 0.75}) {
    for (const double a : {0.25, 0.75}) sum += daylight.skyRadiance(upward((row + z) / kRows, (column + a) / kColumns));
  }
  return 0.25 * sum;
}

/// The interval of cumulated chances that holds u, and u's place within it in [0, 1).
struct Choice {
  std::size_t index = 0;
  double within = 0.0;
};
Choice choose(const double* ends, std::size_t count, double u) {
  const double at = u * ends[count - 1];
  const auto index =
      std::min<std::size_t>(static_cast<std::size_t>(std::upper_bound(ends, ends + count, at) - ends), count - 1);
  const double from = index == 0 ? 0.0 : ends[index - 1];
  return {index, std::clamp((at - from) / (ends[index] - from), 0.0, 1.0 - 0x1.0p-53)};
}

}  // namespace

SkyLight::SkyLight(const scene::Daylight& daylight, const std::optional<glm::dvec3>& uniform) {
  std::vector<double> luminance;
  double total = 0.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const glm::dvec3 radiance = uniform ? *uniform : meanRadiance(daylight, row, column);
      m_weights.push_back(radiance);
      luminance.push_back(std::max(static_cast<double>(image::luminance(glm::vec3(radiance))), 0.0));
      total += luminance.back();
    }
  }
  if (!(total > 0.0)) return;
  // No cell is left out altogether: its colour may have no luminance.
  const double least = 1e-3 * total / static_cast<double>(luminance.size());
  const double solidAngle = 2.0 * kPi / static_cast<double>(luminance.size());
  double all = 0.0;
  for (double& value : luminance) all += value = std::max(value, least);
  double rows = 0.0, cells = 0.0;
  for (std::size_t i = 0; i < luminance.size(); ++i) {
    m_weights[i] *= solidAngle * all / luminance[i];
    m_cellEnds.push_back(cells += luminance[i]);
    if ((i + 1) % kColumns != 0) continue;
    m_rowEnds.push_back(rows += cells);
    cells = 0.0;
  }
}

LightSample SkyLight::sample(const glm::dvec2& u) const {
  const Choice row = choose(m_rowEnds.data(), kRows, u.x);
  const Choice column = choose(m_cellEnds.data() + row.index * kColumns, kColumns, u.y);
  return {upward((static_cast<double>(row.index) + row.within) / kRows,
                 (static_cast<double>(column.index) + column.within) / kColumns),
          m_weights[row.index * kColumns + column.index]};
}

SunLight::SunLight(const scene::Daylight& daylight, double radiusDeg)
    : m_direction(daylight.sunDirection()), m_irradiance(daylight.sunIrradiance()) {
  const double sine = std::sin(radiusDeg * kPi / 180.0);
  m_cap = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));  // without the loss of 1 - cos R
  const glm::dvec3 guide = std::abs(m_direction.z) < 0.7 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  m_across = glm::normalize(glm::cross(guide, m_direction));
  m_along = glm::cross(m_direction, m_across);
  // The disc's solid angle 2 pi (1 - cos R) times its radiance.
  m_irradiance *= 2.0 / (2.0 - m_cap);
}

LightSample SunLight::sample(const glm::dvec2& u) const {
  LightSample out{m_direction, m_irradiance};
  if (m_cap > 0.0) {
    const double drop = u.x * m_cap;  // 1 - cosine of the angle from the centre
    const double radius = std::sqrt(drop * (2.0 - drop)), turn = 2.0 * kPi * u.y;
    out.direction =
        glm::normalize((1.0 - drop) * m_direction + radius * (std::cos(turn) * m_across + std::sin(turn) * m_along));
  }
  out.direction.z = std::abs(out.direction.z);
  return out;
}

HorizonSky::HorizonSky(const scene::Daylight& daylight, const std::optional<glm::dvec3>& uniform) {
  for (int i = 0; i <= kHorizon; ++i) {
    m_radiance.push_back(uniform ? *uniform : daylight.skyRadiance(upward(0.0, static_cast<double>(i) / kHorizon)));
  }
}

glm::dvec3 HorizonSky::at(const glm::dvec2& direction) const {
  const double turn = std::atan2(direction.x, direction.y) / (2.0 * kPi);
  const double at = (turn < 0.0 ? turn + 1.0 : turn) * kHorizon;
  const auto first = std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kHorizon - 1));
  return glm::mix(m_radiance[first], m_radiance[first + 1], at - static_cast<double>(first));
}

}  // namespace sward::trace
