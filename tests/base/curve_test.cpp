#include "base/curve.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::base {
namespace {

Curve make(std::vector<CurvePoint> points) {
  auto curve = Curve::fromPoints(std::move(points));
  EXPECT_TRUE(curve.ok());
  return std::move(curve).value();
}

TEST(Curve, PassesThroughItsPoints) {
  const Curve curve = make({{0, 1}, {0.3, 0.2}, {0.31, 5}, {2, 5}, {4, -1}});
  for (const CurvePoint& point : curve.points()) EXPECT_NEAR(curve(point.x), point.y, 1e-12);
}

TEST(Curve, NeverLeavesTheRangeOfItsNeighbours) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<CurvePoint> points;
    double x = 0.0;
    for (int i = 0; i < 8; ++i) points.push_back({x += random.uniform(1e-6, 2.0), random.uniform(-3.0, 3.0)});
    const Curve curve = make(points);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto [low, high] = std::minmax(points[i].y, points[i + 1].y);
      double last = points[i].y;
      for (int k = 1; k <= 50; ++k) {
        // Rounding must not carry x into the next segment.
        const double value = curve(std::min(points[i].x + (points[i + 1].x - points[i].x) * k / 50.0, points[i + 1].x));
        EXPECT_GE(value, low);
        EXPECT_LE(value, high);
        // Monotone within a segment: it may not turn back (1e-9 for rounding of values near 3).
        EXPECT_GE((value - last) * (points[i + 1].y - points[i].y), -1e-9);
        last = value;
      }
    }
  }
}

TEST(Curve, IsSmoothAtItsPoints) {
  const Curve curve = make({{0, 0}, {1, 0.2}, {2, 1}, {3, 1.1}});
  for (double x : {1.0, 2.0}) {
    EXPECT_NEAR(curve.derivative(x - 1e-7), curve.derivative(x + 1e-7), 1e-5);
  }
  // The derivative is that of the values: central differences of a cubic with step h err by h^2 f''' / 6.
  for (double x = 0.05; x < 3.0; x += 0.1) {
    EXPECT_NEAR(curve.derivative(x), (curve(x + 1e-4) - curve(x - 1e-4)) / 2e-4, 1e-5);
  }
}

TEST(Curve, IsConstantOutsideAndLinearThroughTwoPoints) {
  const Curve line = make({{1, 2}, {3, 6}});
  EXPECT_EQ(line(0.0), 2.0);
  EXPECT_EQ(line(9.0), 6.0);
  EXPECT_NEAR(line(1.7), 3.4, 1e-12);
  EXPECT_EQ(Curve::constant(4.5)(-1e9), 4.5);
  EXPECT_EQ(Curve()(1.0), 0.0);
  EXPECT_EQ(make({{2, 7}})(100), 7.0);
}

TEST(Curve, RefusesWhatIsNoFunction) {
  EXPECT_FALSE(Curve::fromPoints({{0, 0}, {0, 1}}).ok());
  EXPECT_FALSE(Curve::fromPoints({{1, 0}, {0, 1}}).ok());
  EXPECT_FALSE(Curve::fromPoints({{0, std::numeric_limits<double>::quiet_NaN()}}).ok());
  EXPECT_NE(Curve::fromPoints({{0, 0}, {INFINITY, 1}}).error().where.find("1"), std::string::npos);
}

}  // namespace
}  // namespace sward::base
