#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <chrono>
#include <cmath>
#include <numbers>

namespace sward::scene {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;

/// Days from noon UTC of 1 January 2000 (J2000) to the moment.
double daysSinceJ2000(const SunMoment& moment) {
  using namespace std::chrono;
  const sys_days date =
      year(moment.year) / month(static_cast<unsigned>(moment.month)) / day(static_cast<unsigned>(moment.day));
  const sys_days epoch = year(2000) / January / day(1);
  return static_cast<double>((date - epoch).count()) - 0.5 + moment.hourUtc / 24.0;
}

Result<void> checkMoment(const SunMoment& moment) {
  using namespace std::chrono;
  const year_month_day date{year(moment.year), month(static_cast<unsigned>(moment.month)),
                            day(static_cast<unsigned>(moment.day))};
  if (moment.month < 1 || moment.day < 1 || !date.ok() || moment.year < 1 || moment.year > 9999) {
    return Error::badInput("there is no such date", "sun.moment", "Give year, month 1 to 12 and a day of that month.");
  }
  if (!(moment.hourUtc >= 0.0 && moment.hourUtc < 24.0)) {
    return Error::badInput("the hour is not in 0 to 24", "sun.moment.hourUtc", "Give hours of UTC, such as 13.5.");
  }
  if (!(std::abs(moment.latitudeDeg) <= 90.0) || !(std::abs(moment.longitudeDeg) <= 180.0)) {
    return Error::badInput("there is no such place", "sun.moment",
                           "Latitude is -90 to 90 degrees north, longitude -180 to 180 degrees east.");
  }
  return {};
}

}  // namespace

SunAngles sunAngles(const SunMoment& moment) {
  // Astronomical Almanac, "Low precision formulas for the Sun's coordinates".
  const double n = daysSinceJ2000(moment);
  const double meanLongitude = 280.460 + 0.9856474 * n;
  const double anomaly = (357.528 + 0.9856003 * n) * kDegrees;
  const double eclipticLongitude =
      (meanLongitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2.0 * anomaly)) * kDegrees;
  const double obliquity = (23.439 - 0.0000004 * n) * kDegrees;
  const double rightAscension =
      std::atan2(std::cos(obliquity) * std::sin(eclipticLongitude), std::cos(eclipticLongitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(eclipticLongitude));
  // Greenwich mean sidereal time in degrees, at the moment itself.
  const double siderealDeg = 280.46062 + 360.98564737 * n;
  const double hourAngle = (siderealDeg + moment.longitudeDeg) * kDegrees - rightAscension;
  const double latitude = moment.latitudeDeg * kDegrees;
  const glm::dvec3 direction{
      -std::cos(declination) * std::sin(hourAngle),
      std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::cos(hourAngle) * std::sin(latitude),
      std::sin(declination) * std::sin(latitude) + std::cos(declination) * std::cos(hourAngle) * std::cos(latitude)};
  return anglesFromDirection(direction);
}

Result<glm::dvec3> sunDirection(const SunOptions& options) {
  if (options.byMoment) {
    SWARD_TRY(checkMoment(options.moment));
    return directionFromAngles(sunAngles(options.moment));
  }
  const SunAngles& angles = options.angles;
  if (!std::isfinite(angles.azimuthDeg) || !std::isfinite(angles.elevationDeg) ||
      std::abs(angles.elevationDeg) > 90.0) {
    return Error::badInput("the sun's angles are out of range", "sun.angles",
                           "Azimuth is degrees clockwise from north, elevation -90 to 90 degrees.");
  }
  return directionFromAngles(angles);
}

}  // namespace sward::scene
