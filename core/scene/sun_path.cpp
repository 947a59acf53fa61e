#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <algorithm>
#include <chrono>
#include <optional>

namespace sward::scene {
namespace {

/// A leap year, so that every date exists.
constexpr int kYear = 2024;

/// The sun at a time of day; longitude 0, so that hours of UTC are local solar ones within some minutes.
SunAngles sunAt(const SunPathOptions& options, const SunDate& date, double hour) {
  return sunAngles({kYear, date.month, date.day, hour, options.latitudeDeg, 0.0});
}

/// Hours between which the sun stands above the lowest elevation.
struct Span {
  double from = 0.0;
  double to = 24.0;
};

/// The hour at which the elevation crosses the lowest one, between one on each side; to a thousandth of a second.
double crossing(const SunPathOptions& options, const SunDate& date, double under, double over) {
  for (int i = 0; i < 32; ++i) {
    const double middle = 0.5 * (under + over);
    (sunAt(options, date, middle).elevationDeg < options.lowestDeg ? under : over) = middle;
  }
  return over;
}

std::optional<Span> daylight(const SunPathOptions& options, const SunDate& date) {
  // The elevation rises to its noon and falls to its midnight; ten minutes are close enough to tell which is where.
  constexpr int kSteps = 144;
  const auto hour = [](int step) { return 24.0 * step / kSteps; };
  int noon = 0, midnight = 0;
  std::vector<double> elevation;
  for (int step = 0; step < kSteps; ++step) {
    elevation.push_back(sunAt(options, date, hour(step)).elevationDeg);
    const auto at = [&](int s) { return elevation[static_cast<std::size_t>(s)]; };
    if (at(step) > at(noon)) noon = step;
    if (at(step) < at(midnight)) midnight = step;
  }
  const auto isUp = [&](int step) {
    return elevation[static_cast<std::size_t>(((step % kSteps) + kSteps) % kSteps)] >= options.lowestDeg;
  };
  if (!isUp(noon)) return std::nullopt;
  if (isUp(midnight)) return Span{};
  int first = noon, last = noon;
  while (isUp(first - 1)) --first;
  while (isUp(last + 1)) ++last;
  return Span{crossing(options, date, hour(first - 1), hour(first)),
              crossing(options, date, hour(last + 1), hour(last))};
}

}  // namespace

std::vector<glm::dvec3> sunPathLights(const SunPathOptions& options) {
  std::vector<glm::dvec3> directions;
  for (const SunDate& date : options.dates) {
    using namespace std::chrono;
    if (date.month < 1 || date.day < 1) continue;
    const year_month_day day{year(kYear), month(static_cast<unsigned>(date.month)),
                             std::chrono::day(static_cast<unsigned>(date.day))};
    if (!day.ok()) continue;
    const std::optional<Span> span = daylight(options, date);
    if (!span) continue;
    for (int i = 0; i < options.positions; ++i) {
      const double hour = span->from + (span->to - span->from) * (i + 0.5) / options.positions;
      // At the very lowest elevation 0, rounding must not put a light under the horizon.
      SunAngles angles = sunAt(options, date, hour);
      angles.elevationDeg = std::max(angles.elevationDeg, options.lowestDeg);
      directions.push_back(directionFromAngles(angles));
    }
  }
  return directions;
}

}  // namespace sward::scene
