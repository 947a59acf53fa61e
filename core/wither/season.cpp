#include "wither/season.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace sward::wither {
namespace {

constexpr int kSteps = 512;
constexpr double kRestTurn = 10.0 * std::numbers::pi / 180.0;
constexpr double kLargestTurn = 175.0 * std::numbers::pi / 180.0;  // beyond, a blade would curl back up

base::Curve preset(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();  // x increases and all is finite
}

base::Curve normalWater() {
  return preset({{0.0, 1.0}, {0.2, 0.97}, {0.4, 0.85}, {0.55, 0.64}, {0.7, 0.38}, {0.85, 0.18}, {1.0, 0.10}});
}

base::Curve normalChlorophyll() {
  return preset(
      {{0.0, 1.0}, {0.15, 0.97}, {0.3, 0.85}, {0.45, 0.58}, {0.6, 0.29}, {0.75, 0.12}, {0.9, 0.055}, {1.0, 0.04}});
}

/// Share that is a number: what is not one counts as full, so that nothing happens to the blade.
double share(double value) {
  return value < 1.0 ? std::max(value, 0.0) : 1.0;
}

/// T(x) / x up to a factor: reach of the centre of mass of a blade of length 1 that turns by x s^2, over x.
/// T(x) = int_0^1 int_0^s sin(x a^2) da ds = int_0^1 (1 - a) sin(x a^2) da. It falls strictly while x < 4.49, where
/// sin(u) / u has its first minimum.
double reachOverTurn(double x) {
  // Gauss-Legendre, 8 points on [0, 1]: exact to 1e-9 for the smooth integrand at x <= pi.
  static constexpr std::array<double, 4> kNode{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                               0.9602898564975363};
  static constexpr std::array<double, 4> kWeight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                                 0.1012285362903763};
  const auto integrand = [x](double a) {
    const double u = x * a * a;
    const double sinc = u < 1e-6 ? 1.0 - u * u / 6.0 : std::sin(u) / u;
    return (1.0 - a) * a * a * sinc;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < kNode.size(); ++i) {
    sum += 0.5 * kWeight[i] * (integrand(0.5 - 0.5 * kNode[i]) + integrand(0.5 + 0.5 * kNode[i]));
  }
  return sum;
}

Result<void> checkShare(const base::Curve& curve, const char* name) {
  for (std::size_t i = 0; i < curve.points().size(); ++i) {
    const base::CurvePoint& point = curve.points()[i];
    if (!std::isfinite(point.x) || !(point.y >= 0.0 && point.y <= 1.0)) {
      return Error::badInput(
          "the curve of " + std::string(name) + " is " + std::to_string(point.y) + " at " + std::to_string(point.x),
          "ageing, point " + std::to_string(i), "Keep it between 0 and 1.");
    }
  }
  return {};
}

Result<void> checkRange(double value, double low, double high, const char* name) {
  if (value >= low && value <= high) return {};
  return Error::badInput(std::string(name) + " is " + std::to_string(value), "body",
                         "Give a value from " + std::to_string(low) + " to " + std::to_string(high) + ".");
}

Result<void> check(const AgeingOptions& ageing, const BodyOptions& body) {
  SWARD_TRY(checkShare(ageing.water, "water"));
  SWARD_TRY(checkShare(ageing.chlorophyll, "chlorophyll"));
  SWARD_TRY(checkShare(ageing.weathering, "the weathering degree"));
  const std::vector<base::CurvePoint>& points = ageing.weathering.points();
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].y < points[i - 1].y) {
      return Error::badInput("the weathering degree falls", "ageing.weathering, point " + std::to_string(i),
                             "Let it rise or rest: what has withered stays withered.");
    }
  }
  SWARD_TRY(checkRange(ageing.tipLead, -1.0, 1.0, "tipLead"));
  SWARD_TRY(checkRange(ageing.variation, 0.0, 1.0, "variation"));
  SWARD_TRY(checkRange(body.shrinkVein, 0.0, 0.9, "shrinkVein"));
  SWARD_TRY(checkRange(body.shrinkMesophyll, body.shrinkVein, 0.9, "shrinkMesophyll"));
  SWARD_TRY(checkRange(body.stiffening, 1.0, 100.0, "stiffening"));
  SWARD_TRY(checkRange(body.droopDeg, 0.0, 170.0, "droopDeg"));
  SWARD_TRY(checkRange(body.droopVariation, 0.0, 1.0, "droopVariation"));
  return checkRange(body.response, 0.0, 10.0, "response");
}

}  // namespace

base::Curve waterCurve(const AgeingOptions& ageing) {
  switch (ageing.autumn) {
    case Autumn::AmpleWater:
      return preset({{0.0, 1.0}, {0.3, 0.98}, {0.6, 0.90}, {0.8, 0.83}, {1.0, 0.80}});
    case Autumn::LowTemperature:
      return preset({{0.0, 1.0}, {0.08, 0.95}, {0.18, 0.60}, {0.28, 0.27}, {0.4, 0.14}, {0.6, 0.09}, {1.0, 0.07}});
    case Autumn::Custom:
      return ageing.water.points().empty() ? normalWater() : ageing.water;
    case Autumn::Normal:
      break;
  }
  return normalWater();
}

base::Curve chlorophyllCurve(const AgeingOptions& ageing) {
  switch (ageing.autumn) {
    case Autumn::LowTemperature:
      return preset({{0.0, 1.0}, {0.06, 0.95}, {0.14, 0.62}, {0.22, 0.25}, {0.32, 0.09}, {0.5, 0.05}, {1.0, 0.03}});
    case Autumn::Custom:
      return ageing.chlorophyll.points().empty() ? normalChlorophyll() : ageing.chlorophyll;
    case Autumn::Normal:
    case Autumn::AmpleWater:
      break;
  }
  return normalChlorophyll();
}

double restingTurnRad(double water, double droopDeg) {
  const double lost = 1.0 - share(water);
  const double dry = kRestTurn + droopDeg * std::numbers::pi / 180.0;
  if (lost <= 0.0 || !(dry > kRestTurn)) return 0.0;
  const double atRest = reachOverTurn(kRestTurn), atDry = reachOverTurn(dry);
  const double wanted = atRest + (atDry - atRest) * lost * lost * lost;  // k(w) up to a factor
  double low = kRestTurn, high = dry;
  while (true) {  // ends: the interval shrinks to neighbouring numbers
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (reachOverTurn(middle) > wanted ? low : high) = middle;
    if (high - low < 1e-14) break;
  }
  return (lost >= 1.0 ? dry : 0.5 * (low + high)) - kRestTurn;
}

void BodyMotion::advance(double season, double step, double water0, double water1, const BodyOptions& body) {
  const double before = share(water0), after = share(water1);
  const double grown = (body.stiffening - 1.0) * share(season);
  veinLoss = std::clamp(veinLoss + body.shrinkVein * (before - after) / (1.0 + 2.0 * grown), 0.0, body.shrinkVein);
  mesophyllLoss =
      std::clamp(mesophyllLoss + body.shrinkMesophyll * (before - after) / (1.0 + grown), 0.0, body.shrinkMesophyll);
  const double length = 1.0 - veinLoss / 3.0;
  state.strainAlong = veinLoss / 3.0;
  state.strainAcross = 1.0 - std::min(std::sqrt((1.0 - mesophyllLoss) / length), 1.0);
  // x' = (r(t) - x) / tau with r from r0 to r1: x1 = e x0 + (f - e) r0 + (1 - f) r1, e = exp(-q), f = (1 - e) / q.
  const double from = restingTurnRad(before, body.droopDeg), to = restingTurnRad(after, body.droopDeg);
  const double q = body.response > 0.0 ? step / body.response : 1e300;
  const double e = std::exp(-q), f = q > 1e-12 ? -std::expm1(-q) / q : 1.0;
  state.tipRad = e * state.tipRad + std::max(f - e, 0.0) * from + (1.0 - f) * to;
}

Result<Season> Season::create(const AgeingOptions& ageing, const BodyOptions& body) {
  SWARD_TRY(check(ageing, body));
  Season season;
  season.m_ageing = ageing;
  season.m_water = waterCurve(ageing);
  season.m_chlorophyll = chlorophyllCurve(ageing);
  const double first = season.m_water(0.0);
  const auto left = [&](int i) { return 1.0 - std::max(first - season.m_water(static_cast<double>(i) / kSteps), 0.0); };
  BodyMotion motion;
  season.m_states.reserve(kSteps + 1);
  season.m_states.push_back(motion.state);
  for (int i = 0; i < kSteps; ++i) {
    motion.advance((i + 0.5) / kSteps, 1.0 / kSteps, left(i), left(i + 1), body);
    season.m_states.push_back(motion.state);
  }
  return season;
}

double Season::seasonOf(double weathering) const {
  const double wanted = weathering > 0.0 ? std::min(weathering, 1.0) : 0.0;
  if (m_ageing.weathering.points().empty()) return wanted;
  const double reached = std::min(wanted, m_ageing.weathering(1.0));
  if (m_ageing.weathering(0.0) >= reached) return 0.0;
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 53; ++i) {
    const double middle = 0.5 * (low + high);
    (m_ageing.weathering(middle) >= reached ? high : low) = middle;
  }
  return high;
}

double Season::water(double season) const {
  return m_water(std::clamp(season, 0.0, 1.0));
}

double Season::chlorophyll(double season) const {
  return m_chlorophyll(std::clamp(season, 0.0, 1.0));
}

double ownSeason(double season, double ahead) {
  // The offset grows as 1 - (1 - x)^2 over `ramp`, whose slope of at most 2 / ramp keeps the sum from falling.
  const double ramp = std::max(0.5, 2.0 * std::abs(ahead));
  const double rest = 1.0 - std::clamp(season / ramp, 0.0, 1.0);
  return std::clamp(season + ahead * (1.0 - rest * rest), 0.0, 1.0);
}

BladeState Season::stateAt(double season, double delay, double droop) const {
  const double place = ownSeason(season, -delay) * kSteps;
  const auto i = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kSteps - 1));
  const double t = place - static_cast<double>(i);
  const BladeState &a = m_states[i], &b = m_states[i + 1];
  const auto mix = [t](double from, double to) { return from + (to - from) * t; };
  return {mix(a.strainAlong, b.strainAlong), mix(a.strainAcross, b.strainAcross),
          std::clamp(mix(a.tipRad, b.tipRad) * droop, 0.0, kLargestTurn)};
}

Season::Shares Season::sharesAt(double season, double delay, double s) const {
  const double own = ownSeason(season, m_ageing.tipLead * (s - 0.5) - delay);
  return {water(own), chlorophyll(own)};
}

}  // namespace sward::wither
