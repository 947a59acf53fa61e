#include "wither/season.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace sward::wither {
namespace {

constexpr double kPi = std::numbers::pi;

base::Curve curve(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();
}

Season season(const AgeingOptions& ageing = {}, const BodyOptions& body = {}) {
  return Season::create(ageing, body).value();
}

/// A season of `steps` steps under a smooth fall of water.
BodyMotion passed(int steps, const BodyOptions& body, const std::function<double(double)>& water) {
  BodyMotion motion;
  for (int i = 0; i < steps; ++i) {
    const double from = static_cast<double>(i) / steps, to = static_cast<double>(i + 1) / steps;
    motion.advance(0.5 * (from + to), 1.0 / steps, water(from), water(to), body);
  }
  return motion;
}

double smoothWater(double t) {
  return 1.0 - 0.9 * t * t * (3.0 - 2.0 * t);
}

TEST(Curves, PresetsFallFromOneToTheirEnds) {
  for (const Autumn autumn : {Autumn::Normal, Autumn::AmpleWater, Autumn::LowTemperature, Autumn::Custom}) {
    AgeingOptions ageing;
    ageing.autumn = autumn;
    const base::Curve water = waterCurve(ageing), chlorophyll = chlorophyllCurve(ageing);
    EXPECT_EQ(water(0.0), 1.0);
    EXPECT_EQ(chlorophyll(0.0), 1.0);
    EXPECT_LE(chlorophyll(1.0), 0.04);
    for (int i = 0; i < 200; ++i) {
      EXPECT_GE(water(i / 200.0), water((i + 1) / 200.0));
      EXPECT_GE(chlorophyll(i / 200.0), chlorophyll((i + 1) / 200.0));
    }
  }
  EXPECT_NEAR(waterCurve({})(1.0), 0.1, 1e-12);
  AgeingOptions ample, cold;
  ample.autumn = Autumn::AmpleWater;
  cold.autumn = Autumn::LowTemperature;
  EXPECT_GT(waterCurve(ample)(1.0), 0.75);
  EXPECT_LT(waterCurve(cold)(0.35), 0.25);
  EXPECT_LT(chlorophyllCurve(cold)(0.35), 0.1);
  EXPECT_GT(waterCurve({})(0.35), 0.8);
}

TEST(RestingTurn, IsZeroAtFullWaterAndTheDroopWhenDry) {
  for (const double droop : {0.0, 1.0, 60.0, 130.0, 170.0}) {
    EXPECT_EQ(restingTurnRad(1.0, droop), 0.0);
    EXPECT_EQ(restingTurnRad(1.5, droop), 0.0);
    EXPECT_NEAR(restingTurnRad(0.0, droop), droop * kPi / 180.0, 1e-12);
    EXPECT_NEAR(restingTurnRad(-3.0, droop), droop * kPi / 180.0, 1e-12);
    double last = 0.0;
    for (int i = 1; i <= 400; ++i) {
      const double turn = restingTurnRad(1.0 - i / 400.0, droop);
      EXPECT_TRUE(turn > last || droop == 0.0) << droop << " at " << i;
      last = turn;
    }
  }
  EXPECT_EQ(restingTurnRad(std::numeric_limits<double>::quiet_NaN(), 130.0), 0.0);
}

/// The equation that it solves, with the torque integrated in another way (midpoints): k(w) x = T(x) up to the factor
/// that x at rest gives.
TEST(RestingTurn, BalancesTorque) {
  const auto torque = [](double x) {
    double sum = 0.0;
    const int count = 20000;
    for (int i = 0; i < count; ++i) {
      const double a = (i + 0.5) / count;
      sum += (1.0 - a) * std::sin(x * a * a);
    }
    return sum / count;
  };
  const double rest = 10.0 * kPi / 180.0, dry = rest + 130.0 * kPi / 180.0;
  const double kDry = torque(dry) / dry * rest / torque(rest);
  for (const double water : {0.9, 0.6, 0.3, 0.1}) {
    const double k = kDry + (1.0 - kDry) * (1.0 - std::pow(1.0 - water, 3.0));
    const double x = rest + restingTurnRad(water, 130.0);
    // Midpoints err by 1e-9; T(x)/x differs from its value at rest by as little as 1e-3 at w = 0.9.
    EXPECT_NEAR(k * x * torque(rest) / rest, torque(x), 1e-7) << water;
  }
}

TEST(Motion, HalvingTheStepQuartersTheError) {
  const BodyOptions body;
  const BodyMotion exact = passed(1 << 14, body, smoothWater);
  for (const auto member : {&BladeState::strainAlong, &BladeState::strainAcross, &BladeState::tipRad}) {
    double last = 0.0;
    for (const int steps : {64, 128, 256, 512}) {
      const double error = std::abs(passed(steps, body, smoothWater).state.*member - exact.state.*member);
      // Order 2 +- 0.2: the next terms are of order h^2 / response^2 = 0.15 at the first pair, a quarter at each next.
      if (steps > 128) {
        EXPECT_NEAR(std::log2(last / error), 2.0, 0.2) << steps;
      }
      last = error;
    }
  }
}

/// Without stiffening the strain is the share of water lost times k, whatever the path.
TEST(Motion, ShrinksAsWaterIsLost) {
  BodyOptions body;
  body.stiffening = 1.0;
  const BodyMotion motion = passed(7, body, smoothWater);
  EXPECT_NEAR(motion.veinLoss, 0.9 * body.shrinkVein, 1e-12);
  EXPECT_NEAR(motion.mesophyllLoss, 0.9 * body.shrinkMesophyll, 1e-12);
  EXPECT_NEAR(motion.state.strainAlong, motion.veinLoss / 3.0, 1e-12);
  const double mu = 1.0 - motion.state.strainAcross, lambda = 1.0 - motion.state.strainAlong;
  EXPECT_NEAR(lambda * mu * mu, 1.0 - motion.mesophyllLoss, 1e-12);
  body.stiffening = 4.0;
  const BodyMotion stiff = passed(512, body, smoothWater);
  EXPECT_LT(stiff.mesophyllLoss, motion.mesophyllLoss);
  // The vein stiffens more.
  EXPECT_LT(stiff.veinLoss / motion.veinLoss, stiff.mesophyllLoss / motion.mesophyllLoss);
}

/// Water that falls at an even rate and E = 1 + 3 t: strain = k int dt / (1 + 3 t) = k ln(4) / 3.
TEST(Motion, StiffeningSlowsShrinkingAsTheIntegralSays) {
  const BodyMotion motion = passed(2048, {}, [](double t) { return 1.0 - t; });
  EXPECT_NEAR(motion.mesophyllLoss, 0.60 * std::log(4.0) / 3.0, 1e-7);
  EXPECT_NEAR(motion.veinLoss, 0.12 * std::log(7.0) / 6.0, 1e-7);
}

TEST(Motion, AnyStepIsFiniteAndOrdered) {
  for (const double response : {0.0, 1e-9, 0.04, 10.0}) {
    for (const double step : {1e-12, 0.1, 1.0, 1e6}) {
      BodyOptions body;
      body.response = response;
      BodyMotion motion;
      motion.advance(0.5, step, 1.0, 0.1, body);
      EXPECT_TRUE(motion.state.tipRad >= 0.0 && motion.state.tipRad <= restingTurnRad(0.1, body.droopDeg));
      EXPECT_TRUE(motion.state.strainAlong >= 0.0 && motion.state.strainAlong <= body.shrinkVein / 3.0);
      EXPECT_TRUE(motion.state.strainAcross >= 0.0 && motion.state.strainAcross < 1.0);
    }
  }
  BodyMotion odd;
  odd.advance(0.5, 1.0, std::numeric_limits<double>::quiet_NaN(), 7.0, {});
  EXPECT_EQ(odd.state.tipRad, 0.0);
  EXPECT_EQ(odd.state.strainAcross, 0.0);
  BodyMotion drowned = passed(16, {}, smoothWater);
  drowned.advance(1.0, 1.0, 0.1, 2.0, {});  // water comes back: it swells, never beyond the state at rest
  EXPECT_GE(drowned.state.strainAcross, 0.0);
  BodyMotion dry;
  dry.advance(0.5, 1e-3, 0.0, 0.0, {});  // no water to lose
  EXPECT_EQ(dry.state.strainAlong, 0.0);
  EXPECT_TRUE(std::isfinite(dry.state.tipRad));
}

TEST(SeasonTest, BeginsAtRestWhateverTheDelay) {
  for (const Autumn autumn : {Autumn::Normal, Autumn::AmpleWater, Autumn::LowTemperature}) {
    AgeingOptions ageing;
    ageing.autumn = autumn;
    const Season made = season(ageing);
    for (const double delay : {-1.0, -0.24, 0.0, 0.24, 1.0}) {
      const BladeState rest = made.state(0.0, delay, 2.0);
      EXPECT_EQ(rest.strainAlong, 0.0);
      EXPECT_EQ(rest.strainAcross, 0.0);
      EXPECT_EQ(rest.tipRad, 0.0);
      EXPECT_EQ(made.shares(0.0, delay, 1.0).water, 1.0);
      EXPECT_EQ(made.shares(0.0, delay, 0.0).chlorophyll, 1.0);
    }
  }
}

TEST(SeasonTest, StateRisesWithTheDegree) {
  AgeingOptions ageing;
  ageing.weathering = curve({{0.0, 0.0}, {0.3, 0.5}, {0.5, 0.5}, {1.0, 1.0}});
  const Season made = season(ageing);
  for (const double delay : {-0.24, -0.1, 0.0, 0.1, 0.24, 0.6}) {
    BladeState last;
    Season::Shares lastShares;
    for (int i = 0; i <= 500; ++i) {
      const BladeState state = made.state(i / 500.0, delay, 1.0);
      const Season::Shares shares = made.shares(i / 500.0, delay, 0.9);
      EXPECT_GE(state.strainAlong, last.strainAlong);
      EXPECT_GE(state.strainAcross, last.strainAcross);
      EXPECT_GE(state.tipRad, last.tipRad);
      EXPECT_LE(shares.water, lastShares.water);
      EXPECT_LE(shares.chlorophyll, lastShares.chlorophyll);
      last = state;
      lastShares = shares;
    }
    EXPECT_TRUE(last.tipRad > 1.0 || delay > 0.2) << delay;
  }
}

TEST(SeasonTest, AmpleWaterStaysUprightAndTurnsYellow) {
  AgeingOptions ageing;
  ageing.autumn = Autumn::AmpleWater;
  const Season made = season(ageing);
  EXPECT_LT(made.state(1.0, 0.0, 1.0).tipRad, 0.2);
  EXPECT_GT(season().state(1.0, 0.0, 1.0).tipRad, 1.5);
  EXPECT_LT(made.shares(1.0, 0.0, 0.5).chlorophyll, 0.1);
}

TEST(SeasonTest, TipsAndEarlyBladesLead) {
  const Season made = season();
  EXPECT_LT(made.shares(0.4, 0.0, 1.0).chlorophyll, made.shares(0.4, 0.0, 0.0).chlorophyll - 0.1);
  EXPECT_EQ(made.shares(0.4, 0.0, 0.5).chlorophyll, made.chlorophyll(0.4));
  EXPECT_GT(made.state(0.5, -0.2, 1.0).tipRad, made.state(0.5, 0.2, 1.0).tipRad);
  EXPECT_LT(made.state(1.0, 0.0, 100.0).tipRad, kPi);
}

TEST(SeasonTest, MomentOfADegreeIsTheEarliest) {
  AgeingOptions ageing;
  ageing.weathering = curve({{0.2, 0.1}, {0.4, 0.5}, {0.6, 0.5}, {0.8, 0.9}});
  const Season made = season(ageing);
  EXPECT_EQ(made.seasonOf(-1.0), 0.0);
  EXPECT_EQ(made.seasonOf(0.1), 0.0);
  EXPECT_NEAR(made.seasonOf(0.5), 0.4, 1e-7);  // the curve is level there: the root is found to the root of rounding
  EXPECT_NEAR(made.seasonOf(0.9), 0.8, 1e-7);
  EXPECT_NEAR(made.seasonOf(1.0), 0.8, 1e-7);
  EXPECT_EQ(made.seasonOf(std::numeric_limits<double>::quiet_NaN()), 0.0);
  for (const double degree : {0.2, 0.3, 0.7}) EXPECT_NEAR(ageing.weathering(made.seasonOf(degree)), degree, 1e-12);
  EXPECT_EQ(season().seasonOf(0.37), 0.37);
}

TEST(SeasonTest, OddCurves) {
  AgeingOptions ageing;
  ageing.autumn = Autumn::Custom;
  for (const double level : {0.0, 0.5, 1.0}) {  // one point: nothing is lost over the season
    ageing.water = base::Curve::constant(level);
    const BladeState state = season(ageing).state(1.0, 0.0, 1.0);
    EXPECT_EQ(state.tipRad, 0.0) << level;
    EXPECT_EQ(state.strainAlong, 0.0) << level;
  }
  ageing.water = curve({{0.0, 0.2}, {1.0, 1.0}});  // water rises: nothing is lost either
  EXPECT_EQ(season(ageing).state(1.0, 0.0, 1.0).tipRad, 0.0);
  ageing.water = curve({{0.0, 1.0}, {1e-9, 0.0}});  // all lost at once
  EXPECT_NEAR(season(ageing).state(1.0, 0.0, 1.0).tipRad, 130.0 * kPi / 180.0, 1e-6);
}

TEST(SeasonTest, RefusesWhatMakesNoSense) {
  const auto fails = [](const AgeingOptions& ageing, const BodyOptions& body, const char* word) {
    const Result<Season> made = Season::create(ageing, body);
    ASSERT_FALSE(made.ok()) << word;
    EXPECT_NE(made.error().text().find(word), std::string::npos) << made.error().text();
    EXPECT_FALSE(made.error().remedy.empty());
  };
  AgeingOptions ageing;
  ageing.water = curve({{0.0, 1.2}, {1.0, 0.0}});
  fails(ageing, {}, "water");
  ageing = {};
  ageing.chlorophyll = curve({{0.0, 1.0}, {1.0, -0.1}});
  fails(ageing, {}, "chlorophyll");
  ageing = {};
  ageing.weathering = curve({{0.0, 0.0}, {0.5, 0.8}, {1.0, 0.7}});
  fails(ageing, {}, "falls");
  ageing = {};
  ageing.tipLead = std::numeric_limits<double>::quiet_NaN();
  fails(ageing, {}, "tipLead");
  BodyOptions body;
  body.shrinkMesophyll = 0.05;  // less than the vein's
  fails({}, body, "shrinkMesophyll");
  body = {};
  body.droopDeg = 171.0;
  fails({}, body, "droopDeg");
  body = {};
  body.stiffening = 0.5;
  fails({}, body, "stiffening");
  // What a curve itself refuses: equal and unsorted keys, values that are not numbers.
  EXPECT_FALSE(base::Curve::fromPoints({{0.0, 1.0}, {0.0, 0.5}}).ok());
  EXPECT_FALSE(base::Curve::fromPoints({{1.0, 1.0}, {0.0, 0.5}}).ok());
  EXPECT_FALSE(base::Curve::fromPoints({{0.0, std::numeric_limits<double>::quiet_NaN()}}).ok());
}

TEST(OwnSeason, NeverFallsAndEndsAhead) {
  for (const double ahead : {-1.5, -0.4, -0.1, 0.0, 0.2, 0.7, 1.5}) {
    double last = 0.0;
    EXPECT_EQ(ownSeason(0.0, ahead), 0.0);
    for (int i = 1; i <= 1000; ++i) {
      const double own = ownSeason(i / 1000.0, ahead);
      EXPECT_GE(own, last - 1e-15) << ahead << " at " << i;
      last = own;
    }
  }
  EXPECT_NEAR(ownSeason(0.6, 0.2), 0.8, 1e-12);
  EXPECT_NEAR(ownSeason(0.6, -0.2), 0.4, 1e-12);
}

}  // namespace
}  // namespace sward::wither
