#include "lpt/light_quality.h"

#include "base/random.h"
#include "scene/lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace sward::lpt {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Lights = std::vector<glm::dvec3>;

Lights ring(int count, double elevationDeg) {
  return scene::ringLights({1, count, elevationDeg, elevationDeg, false});
}

Lights join(Lights a, const Lights& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Lights randomLights(int count, std::uint64_t seed) {
  base::Random random(seed);
  Lights lights;
  while (lights.size() < static_cast<std::size_t>(count)) {
    const double z = random.uniform(), azimuth = 2.0 * kPi * random.uniform(), r = std::sqrt(1.0 - z * z);
    lights.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), z);
  }
  return lights;
}

TEST(LightQuality, NoLightKnowsNothing) {
  const LightSetQuality quality{Lights{}};
  EXPECT_EQ(quality.rank(), 0);
  EXPECT_EQ(quality.condition(), kInfinity);
  EXPECT_EQ(quality.worstGapDeg(), 180.0);
  EXPECT_EQ(quality.coverage(), 0.0);
  EXPECT_EQ(quality.leverage({0, 0, 1}), kInfinity);
  EXPECT_EQ(quality.gapDeg({0, 0, 1}), 180.0);
}

TEST(LightQuality, OneLightKnowsItself) {
  const Lights lights{scene::directionFromAngles({100.0, 30.0})};
  const LightSetQuality quality(lights);
  EXPECT_EQ(quality.rank(), 1);
  EXPECT_EQ(quality.condition(), kInfinity);
  EXPECT_NEAR(quality.leverage(lights[0]), 1.0, 1e-12);
  EXPECT_EQ(quality.leverage({0, 0, 1}), kInfinity);
  // The furthest is the opposite horizon, 30 degrees short of the antipode.
  EXPECT_NEAR(quality.worstGapDeg(), 150.0, 1e-3);
  EXPECT_LT(glm::distance(quality.worstGap(), scene::directionFromAngles({280.0, 0.0})), 1e-3);
  const LightSetQuality zenith{Lights{{0, 0, 1}}};
  EXPECT_NEAR(zenith.worstGapDeg(), 90.0, 1e-3);
}

TEST(LightQuality, CoincidentLightsCountOnceButShareTheNoise) {
  const Lights lights(9, scene::directionFromAngles({40.0, 50.0}));
  const LightSetQuality quality(lights);
  EXPECT_EQ(quality.rank(), 1);
  EXPECT_EQ(quality.condition(), kInfinity);
  EXPECT_NEAR(quality.leverage(lights[0]), 1.0 / 9.0, 1e-12);
  // Six different lights, each doubled: ranks and conditions are those of the six, the noise is halved.
  const Lights six = randomLights(6, 5);
  const LightSetQuality once(six), twice(join(six, six));
  EXPECT_EQ(once.rank(), 6);
  EXPECT_EQ(twice.rank(), 6);
  EXPECT_NEAR(twice.condition() / once.condition(), 1.0, 1e-9);
  EXPECT_NEAR(once.leverage(six[2]), 1.0, 1e-9);
  EXPECT_NEAR(twice.leverage(six[2]), 0.5, 1e-9);
}

TEST(LightQuality, ARingAloneLacksOneFunction) {
  for (const int count : {5, 12, 40}) {
    const Lights lights = ring(count, 30.0);
    const LightSetQuality quality(lights);
    EXPECT_EQ(quality.rank(), 5) << count;  // lx^2 + ly^2 is the constant
    EXPECT_EQ(quality.condition(), kInfinity) << count;
    for (const glm::dvec3& light : lights) EXPECT_NEAR(quality.leverage(light), 5.0 / count, 1e-9);
    EXPECT_EQ(quality.leverage({0, 0, 1}), kInfinity);
    // Anywhere on the circle the answer is known, also between the lights.
    EXPECT_NEAR(quality.leverage(scene::directionFromAngles({1.234, 30.0})), 5.0 / count, 1e-9);
    EXPECT_LT(quality.coverage(), 0.001);
  }
  EXPECT_NEAR(LightSetQuality(ring(40, 30.0)).worstGapDeg(), 60.0, 1e-3);  // the zenith
}

TEST(LightQuality, RingAndZenithMatchTheClosedForm) {
  for (const double elevation : {10.0, 30.0, 60.0}) {
    constexpr int kCount = 9;
    const LightSetQuality quality(join(ring(kCount, elevation), {{0, 0, 1}}));
    EXPECT_EQ(quality.rank(), 6);
    // On a ring of radius r with N lights the squared singular values are N r^2 / 2 (lx, ly), N r^4 / 8 (lx ly),
    // N r^4 / 4 ((lx^2 - ly^2) / sqrt 2), and those of [[N r^4 / 2, N r^2 / sqrt 2], [., N + 1]].
    const double r2 = std::pow(std::cos(elevation * kPi / 180.0), 2), n = kCount;
    const double a = n * r2 * r2 / 2.0, b = n * r2 / std::sqrt(2.0), d = n + 1.0;
    const double root = std::sqrt((a - d) * (a - d) + 4.0 * b * b);
    const std::array<double, 5> squares{n * r2 / 2.0, n * r2 * r2 / 8.0, n * r2 * r2 / 4.0, 0.5 * (a + d + root),
                                        0.5 * (a + d - root)};
    const auto [least, most] = std::minmax_element(squares.begin(), squares.end());
    EXPECT_NEAR(quality.condition() / std::sqrt(*most / *least), 1.0, 1e-9) << elevation;
    EXPECT_NEAR(quality.leverage({0, 0, 1}), 1.0, 1e-9);  // it alone knows the sixth function
    EXPECT_NEAR(quality.leverage(scene::directionFromAngles({77.0, elevation})), 5.0 / n, 1e-9);
  }
}

TEST(LightQuality, LightsOnOnePlaneAreNotEnough) {
  // Any circle on the sphere satisfies one quadratic in (lx, ly).
  const glm::dvec3 axis = glm::normalize(glm::dvec3(0.0, -0.6, 0.8));
  const glm::dvec3 u(1.0, 0.0, 0.0), v = glm::cross(axis, u);
  Lights tilted, meridian;
  for (int i = 0; i < 20; ++i) {
    const double angle = 2.0 * kPi * i / 20.0, half = kPi * (i + 0.5) / 20.0;
    tilted.push_back(0.8 * axis + 0.6 * (std::cos(angle) * u + std::sin(angle) * v));
    meridian.emplace_back(0.0, std::cos(half), std::sin(half));
  }
  EXPECT_EQ(LightSetQuality(tilted).rank(), 5);
  // In the plane lx = 0 only ly^2, ly and 1 are left.
  EXPECT_EQ(LightSetQuality(meridian).rank(), 3);
  EXPECT_EQ(LightSetQuality(meridian).condition(), kInfinity);
  // One day's sun is such a circle, but for its declination's drift; two seasons are not.
  scene::SunPathOptions path;
  path.positions = 12;
  path.dates = {{6, 21}};
  EXPECT_EQ(LightSetQuality(scene::sunPathLights(path)).coverage() < 0.01, true);
  path.dates = {{6, 21}, {12, 21}};
  const LightSetQuality seasons(scene::sunPathLights(path));
  EXPECT_EQ(seasons.rank(), 6);
  EXPECT_LT(seasons.condition(), 100.0);
}

/// phi^T (Phi^T Phi)^-1 phi by Gauss and Jordan in extended precision.
double leverageByNormalEquations(const Lights& lights, const glm::dvec3& at) {
  using Real = long double;
  const auto functions = [](const glm::dvec3& l) {
    return std::array<Real, 6>{Real{l.x} * l.x, Real{l.y} * l.y, Real{l.x} * l.y, l.x, l.y, 1.0L};
  };
  std::array<std::array<Real, 7>, 6> m{};
  for (const glm::dvec3& light : lights) {
    const auto phi = functions(light);
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) m[i][j] += phi[i] * phi[j];
    }
  }
  const auto target = functions(at);
  for (std::size_t i = 0; i < 6; ++i) m[i][6] = target[i];
  for (std::size_t c = 0; c < 6; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < 6; ++r) pivot = std::abs(m[r][c]) > std::abs(m[pivot][c]) ? r : pivot;
    std::swap(m[c], m[pivot]);
    for (std::size_t r = 0; r < 6; ++r) {
      if (r == c) continue;
      const Real factor = m[r][c] / m[c][c];
      for (std::size_t k = c; k < 7; ++k) m[r][k] -= factor * m[c][k];
    }
  }
  Real sum = 0.0L;
  for (std::size_t i = 0; i < 6; ++i) sum += target[i] * m[i][6] / m[i][i];
  return static_cast<double>(sum);
}

TEST(LightQuality, LeverageIsTheVarianceOfThePrediction) {
  for (const Lights& lights : {scene::fibonacciHemisphere(15), randomLights(8, 2), randomLights(100, 3)}) {
    const LightSetQuality quality(lights);
    double sum = 0.0;
    for (const glm::dvec3& light : lights) {
      const double value = quality.leverage(light);
      EXPECT_LE(value, 1.0 + 1e-9);
      EXPECT_GE(value, 1.0 / static_cast<double>(lights.size()) - 1e-12);  // the constant's part
      sum += value;
    }
    EXPECT_NEAR(sum, 6.0, 1e-8);
    for (const glm::dvec3& direction : randomLights(50, 9)) {
      const double expected = leverageByNormalEquations(lights, direction);
      EXPECT_NEAR(quality.leverage(direction) / expected, 1.0, 1e-6);
    }
  }
}

TEST(LightQuality, WorstGapsMatchClosedForms) {
  // Four lights on the horizon and the zenith: octants, whose middles are acos(1 / sqrt 3) from their corners.
  const LightSetQuality octants(join(ring(4, 0.0), {{0, 0, 1}}));
  EXPECT_NEAR(octants.worstGapDeg(), std::acos(1.0 / std::sqrt(3.0)) * 180.0 / kPi, 1e-3);
  // Two on the opposite horizons: the whole great circle between them is 90 degrees away.
  EXPECT_NEAR(LightSetQuality(Lights{{1, 0, 0}, {-1, 0, 0}}).worstGapDeg(), 90.0, 1e-3);
}

TEST(LightQuality, WorstGapsHoldAgainstADenseSearch) {
  const Lights dense = scene::fibonacciHemisphere(200000);
  for (const Lights& lights :
       {scene::fibonacciHemisphere(15), randomLights(7, 1), randomLights(40, 4), ring(6, 45.0)}) {
    const LightSetQuality quality(lights);
    double worst = 0.0;
    for (const glm::dvec3& direction : dense) worst = std::max(worst, quality.gapDeg(direction));
    EXPECT_GE(quality.worstGapDeg(), worst - 1e-3);
    EXPECT_LE(quality.worstGapDeg(), worst + 0.3);  // the dense points' own distance
    EXPECT_NEAR(quality.gapDeg(quality.worstGap()), quality.worstGapDeg(), 1e-9);
    EXPECT_GE(quality.worstGap().z, 0.0);
  }
}

TEST(LightQuality, MoreLightsCoverMore) {
  double coverage = 0.0, gap = 180.0;
  EXPECT_LT(LightSetQuality(scene::fibonacciHemisphere(6)).coverage(), 0.5);
  for (const int count : {6, 15, 60, 400}) {
    const LightSetQuality quality(scene::fibonacciHemisphere(count));
    EXPECT_GE(quality.coverage(), coverage) << count;
    EXPECT_LT(quality.worstGapDeg(), gap) << count;
    coverage = quality.coverage();
    gap = quality.worstGapDeg();
  }
  EXPECT_GT(coverage, 0.99);
  // The defaults of the other patterns: rings cover the sky, a sun's path leaves the north out.
  const LightSetQuality rings(scene::ringLights({})), path(scene::sunPathLights({}));
  EXPECT_GT(rings.coverage(), 0.99);
  EXPECT_LT(rings.condition(), 10.0);
  EXPECT_GT(path.coverage(), 0.4);
  EXPECT_LT(path.coverage(), 0.8);
  EXPECT_LT(path.condition(), 20.0);
  EXPECT_GT(path.worstGap().y, 0.0);
}

TEST(HemisphereMap, ProjectionKeepsAreasAndGoesBothWays) {
  for (const glm::dvec3& direction : randomLights(200, 8)) {
    EXPECT_LT(glm::distance(directionAt(placeOf(direction)), direction), 1e-9);
    EXPECT_NEAR(glm::dot(placeOf(direction), placeOf(direction)), 1.0 - direction.z, 1e-12);
  }
  EXPECT_EQ(placeOf({0, 0, 1}), glm::dvec2(0, 0));
  EXPECT_NEAR(placeOf({0, 1, 0}).y, 1.0, 1e-12);
}

TEST(HemisphereMap, HoldsWhatTheQualitySays) {
  const LightSetQuality quality(scene::fibonacciHemisphere(15));
  const HemisphereMap map = hemisphereMap(quality, 33);
  ASSERT_EQ(map.leverage.size(), 33u * 33u);
  ASSERT_EQ(map.gapDeg.size(), 33u * 33u);
  EXPECT_TRUE(std::isnan(map.leverage[0]) && std::isnan(map.gapDeg.back()));
  EXPECT_NEAR(map.leverage[16 * 33 + 16], quality.leverage({0, 0, 1}), 1e-6);
  // Row 0 is north, the last column east.
  const glm::dvec3 north = directionAt({0.0, 1.0 - 1.0 / 33.0}), east = directionAt({1.0 - 1.0 / 33.0, 0.0});
  EXPECT_NEAR(map.gapDeg[16], quality.gapDeg(north), 1e-4);
  EXPECT_NEAR(map.gapDeg[16 * 33 + 32], quality.gapDeg(east), 1e-4);
  int covered = 0, inside = 0;
  for (const float value : map.leverage) {
    inside += std::isnan(value) ? 0 : 1;
    covered += value <= 1.0f ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(covered) / inside, quality.coverage(), 0.03);
  EXPECT_TRUE(hemisphereMap(quality, 0).leverage.empty());
}

}  // namespace
}  // namespace sward::lpt
