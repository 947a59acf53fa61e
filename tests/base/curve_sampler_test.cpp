#include "base/curve_sampler.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace sward::base {
namespace {

Curve make(std::vector<CurvePoint> points) {
  auto curve = Curve::fromPoints(std::move(points));
  EXPECT_TRUE(curve.ok());
  return std::move(curve).value();
}

TEST(CurveSampler, InvertsClosedForms) {
  const CurveSampler flat(Curve::constant(0.3), -1.0, 3.0);
  const CurveSampler rising(make({{0.0, 0.0}, {1.0, 2.0}}), 0.0, 1.0);   // cumulative x^2
  const CurveSampler falling(make({{0.0, 5.0}, {1.0, 0.0}}), 0.0, 1.0);  // cumulative 1 - (1 - x)^2
  for (int i = 0; i <= 1000; ++i) {
    const double u = i / 1000.0;
    EXPECT_NEAR(flat(u), -1.0 + 4.0 * u, 1e-12);
    EXPECT_NEAR(rising(u), std::sqrt(u), 1e-12);
    EXPECT_NEAR(falling(u), 1.0 - std::sqrt(1.0 - u), 1e-7);  // the root of rounding near 1
  }
  EXPECT_NEAR(flat.mean(), 1.0, 1e-12);
  EXPECT_NEAR(rising.mean(), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(falling.mean(), 1.0 / 3.0, 1e-12);
}

/// Kolmogorov and Smirnov's distance of draws from a finely integrated cubic with two humps and an empty gap.
TEST(CurveSampler, DrawsFollowTheCurve) {
  const Curve curve = make({{0.0, 0.0}, {0.4, 1.0}, {0.8, 0.0}, {1.2, 0.0}, {1.5, 0.4}, {2.0, 0.1}});
  constexpr int kSteps = 200000;
  std::vector<double> cumulative{0.0};
  for (int i = 0; i < kSteps; ++i) cumulative.push_back(cumulative.back() + curve(2.0 * (i + 0.5) / kSteps));
  const CurveSampler sampler(curve, 0.0, 2.0);
  Random random(3);
  constexpr int kDraws = 20000;
  std::vector<double> draws;
  for (int i = 0; i < kDraws; ++i) draws.push_back(sampler(random.uniform()));
  std::sort(draws.begin(), draws.end());
  double distance = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = draws[static_cast<std::size_t>(i)];
    EXPECT_FALSE(x > 0.801 && x < 1.199) << x << " lies where there is nothing";
    const double expected = cumulative[static_cast<std::size_t>(std::lround(x / 2.0 * kSteps))] / cumulative.back();
    distance = std::max(distance, std::abs((i + 0.5) / kDraws - expected));
  }
  EXPECT_LT(distance, 1.95 / std::sqrt(kDraws));  // exceeded once in a thousand seeds
}

TEST(CurveSampler, NeverTurnsBackAndStaysInside) {
  Random random(11);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<CurvePoint> points;
    double x = -0.5;
    for (int i = 0; i < 7; ++i)
      points.push_back({x += random.uniform(1e-9, 0.6), std::max(random.uniform(-1, 1), 0.0)});
    points[3].y = 1.0;
    const CurveSampler sampler(make(points), 0.0, 2.0);
    if (!sampler.possible()) continue;
    double last = 0.0;
    for (int i = 0; i <= 200; ++i) {
      const double value = sampler(i / 200.0);
      EXPECT_GE(value, last - 1e-12) << trial;
      EXPECT_LE(value, 2.0);
      last = value;
    }
  }
}

TEST(CurveSampler, ASpikeBetweenGridLinesIsFound) {
  const CurveSampler sampler(make({{0.5001, 0.0}, {0.50015, 1.0}, {0.5002, 0.0}}), 0.0, 2.0);
  ASSERT_TRUE(sampler.possible());
  for (const double u : {0.0, 0.3, 1.0}) EXPECT_NEAR(sampler(u), 0.50015, 6e-5);
}

TEST(CurveSampler, NothingToDrawIsSaid) {
  for (const Curve& curve : {Curve(), Curve::constant(0.0), Curve::constant(-1.0), make({{3.0, 0.0}, {4.0, 1.0}})}) {
    const CurveSampler sampler(curve, 0.0, 2.0);
    EXPECT_FALSE(sampler.possible());
    EXPECT_EQ(sampler(0.7), 1.0);
    EXPECT_EQ(sampler.mean(), 1.0);
  }
}

TEST(CurvePresets, LieInTheUnitSquareAndStretch) {
  std::set<std::string> names;
  for (const CurvePreset& preset : curvePresets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_EQ(preset.points.front().x, 0.0);
    EXPECT_EQ(preset.points.back().x, 1.0);
    for (const CurvePoint& p : preset.points) EXPECT_TRUE(p.y >= 0.0 && p.y <= 1.0) << preset.name;
    const Curve curve = presetCurve(preset, -2.0, 4.0, 10.0, 20.0);
    ASSERT_EQ(curve.points().size(), preset.points.size());
    EXPECT_EQ(curve.points().back().x, 4.0);
    EXPECT_NEAR(curve(-2.0), 10.0 + 10.0 * preset.points.front().y, 1e-12);
  }
  EXPECT_GE(names.size(), 6u);
}

TEST(CurvePresets, EasesAreThePowersTheyStandFor) {
  const auto preset = [](const std::string& name) {
    for (const CurvePreset& p : curvePresets()) {
      if (p.name == name) return presetCurve(p, 0.0, 1.0, 0.0, 1.0);
    }
    ADD_FAILURE() << name;
    return Curve();
  };
  const Curve in = preset("Ease in"), out = preset("Ease out"), s = preset("S");
  for (int i = 0; i <= 100; ++i) {
    const double x = i / 100.0;
    EXPECT_NEAR(in(x), x * x, 0.02);
    EXPECT_NEAR(out(x), x * (2.0 - x), 0.02);
    EXPECT_NEAR(s(x), x * x * (3.0 - 2.0 * x), 0.02);
  }
}

}  // namespace
}  // namespace sward::base
