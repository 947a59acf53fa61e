#include "terrain/height_field.h"

#include "base/random.h"
#include "terrain/hills.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

using Field = std::shared_ptr<const HeightField>;

HeightGrid gridOf(int columns, int rows, double cell, const std::function<double(double, double)>& height) {
  HeightGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.cellM = glm::dvec2(cell, cell * 1.25);
  grid.origin = {-3.0, 7.0};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      grid.heights.push_back(
          static_cast<float>(height(grid.origin.x + x * grid.cellM.x, grid.origin.y + y * grid.cellM.y)));
  return grid;
}

Field fieldOf(HeightGrid grid) {
  auto field = HeightField::create(std::move(grid));
  EXPECT_TRUE(field.ok()) << (field.ok() ? "" : field.error().text());
  return field.value();
}

Field randomField(std::uint64_t seed, int columns, int rows, Border border = Border::Clamp) {
  base::Random random(seed);
  HeightGrid grid = gridOf(columns, rows, 2.0, [&](double, double) { return random.uniform(-5.0, 5.0); });
  grid.border = border;
  return fieldOf(std::move(grid));
}

TEST(HeightField, PlaneIsExactInside) {
  // Catmull-Rom has linear precision; heights are floats below 32: half an ulp is 1e-6, a slope over a cell of 0.5 m
  // sums a few of them.
  const Field field = fieldOf(gridOf(12, 9, 0.5, [](double x, double y) { return 2.0 + 0.3 * x - 0.7 * y; }));
  base::Random random(3);
  for (int i = 0; i < 500; ++i) {
    const glm::dvec2 p(random.uniform(-2.4, 1.9), random.uniform(7.7, 11.2));
    const HeightSample s = field->sample(p);
    EXPECT_NEAR(s.heightM, 2.0 + 0.3 * p.x - 0.7 * p.y, 4e-6);
    EXPECT_NEAR(s.gradient.x, 0.3, 2e-5);
    EXPECT_NEAR(s.gradient.y, -0.7, 2e-5);
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.3, 0.7, 1.0));
    EXPECT_LT(glm::length(field->normal(p) - expected), 3e-5);
  }
}

TEST(HeightField, SphereCapConvergesQuadraticallyOrBetter) {
  // h = sqrt(R^2 - r^2); Catmull-Rom's tangents are central differences: the error of heights is of the third order at
  // least, that of gradients of the second. Halving the cell must divide them by about 8 and 4; 5 and 3 leave room.
  const auto cap = [](double x, double y) { return std::sqrt(400.0 - x * x - (y - 10.0) * (y - 10.0)); };
  double heightError[2] = {}, slopeError[2] = {};
  for (int k = 0; k < 2; ++k) {
    const double cell = k == 0 ? 0.8 : 0.4;
    const Field field = fieldOf(gridOf(static_cast<int>(8 / cell), static_cast<int>(8 / cell), cell, cap));
    base::Random random(5);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 p(random.uniform(-1.9, 2.5), random.uniform(8.1, 13.0));
      const HeightSample s = field->sample(p);
      const double h = cap(p.x, p.y);
      heightError[k] = std::max(heightError[k], std::abs(s.heightM - h));
      const glm::dvec2 slope(-p.x / h, -(p.y - 10.0) / h);
      slopeError[k] = std::max(slopeError[k], glm::length(s.gradient - slope));
    }
  }
  EXPECT_LT(heightError[0], 2e-3);
  EXPECT_LT(heightError[1], heightError[0] / 5.0 + 4e-6);
  EXPECT_LT(slopeError[1], slopeError[0] / 3.0 + 2e-5);
}

TEST(HeightField, MeetsItsSamplesAndIsSmoothAcrossCells) {
  for (const Border border : {Border::Clamp, Border::Repeat}) {
    const Field field = randomField(11, 16, 8, border);
    const HeightGrid& grid = field->grid();
    for (int y = 0; y < grid.rows; ++y)
      for (int x = 0; x < grid.columns; ++x)
        EXPECT_NEAR(field->height(grid.origin + glm::dvec2(x, y) * grid.cellM), static_cast<double>(grid.at(x, y)),
                    1e-9);
    // From far outside on one side to far outside on the other, over both borders: the gradient may not jump. Second
    // derivatives of heights within 5 m over cells of 2 m stay below 60: a step of 1e-7 turns a slope by 6e-6 at most.
    base::Random random(12);
    for (int i = 0; i < 4000; ++i) {
      glm::dvec2 p(random.uniform(-20.0, 45.0), random.uniform(-10.0, 40.0));
      // A cell's border, from both sides.
      p.x = grid.origin.x + std::round((p.x - grid.origin.x) / grid.cellM.x) * grid.cellM.x;
      const glm::dvec2 step(1e-7, 0.0);
      const HeightSample a = field->sample(p - step), b = field->sample(p + step);
      EXPECT_LT(std::abs(a.heightM - b.heightM), 5e-6);
      EXPECT_LT(glm::length(a.gradient - b.gradient), 3e-5) << p.x << ' ' << p.y;
    }
  }
}

TEST(HeightField, GradientIsTheDerivative) {
  const Field field = randomField(21, 9, 9);
  base::Random random(22);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec2 p(random.uniform(-6.0, 16.0), random.uniform(3.0, 30.0));
    const double e = 1e-5;
    const glm::dvec2 difference((field->height(p + glm::dvec2(e, 0)) - field->height(p - glm::dvec2(e, 0))) / (2 * e),
                                (field->height(p + glm::dvec2(0, e)) - field->height(p - glm::dvec2(0, e))) / (2 * e));
    // Across a cell's border the second derivative jumps by less than 120: 120 e / 2.
    EXPECT_LT(glm::length(field->sample(p).gradient - difference), 7e-4);
  }
}

TEST(HeightField, RepeatsAndClamps) {
  const Field repeated = randomField(31, 8, 8, Border::Repeat);
  const glm::dvec2 period = 8.0 * repeated->grid().cellM;
  EXPECT_NEAR(repeated->height({1.3, 9.9}), repeated->height(glm::dvec2(1.3, 9.9) + period * glm::dvec2(-3, 5)), 1e-9);
  const Field clamped = randomField(32, 8, 8);
  const double corner = static_cast<double>(clamped->grid().at(0, 0));
  EXPECT_NEAR(clamped->height({-1e9, -1e9}), corner, 1e-9);
  EXPECT_TRUE(std::isfinite(clamped->height({std::numeric_limits<double>::infinity(), 0.0})));
  EXPECT_TRUE(std::isfinite(clamped->height({std::nan(""), std::nan("")})));
  EXPECT_TRUE(std::isfinite(repeated->height({1e300, -1e300})));
}

TEST(HeightField, RangesHoldTheSurface) {
  for (const Border border : {Border::Clamp, Border::Repeat}) {
    const Field field = randomField(41, 32, 16, border);
    base::Random random(42);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 low(random.uniform(-40.0, 90.0), random.uniform(-40.0, 70.0));
      const glm::dvec2 size(std::exp(random.uniform(-3.0, 4.0)), std::exp(random.uniform(-3.0, 4.0)));
      const HeightRange range = field->range(low, low + size);
      for (int k = 0; k < 60; ++k) {
        const double h = field->height(low + size * glm::dvec2(random.uniform(), random.uniform()));
        EXPECT_LE(range.low, h);
        EXPECT_GE(range.high, h);
      }
    }
  }
}

/// Steps so small that the surface cannot be crossed unseen by more than the last one.
std::optional<double> bruteForce(const HeightField& field, const glm::dvec3& from, const glm::dvec3& d, double end) {
  const double step = 2e-3;
  for (double t = 0.0; t <= end; t += step) {
    const glm::dvec3 p = from + d * t;
    if (p.z <= field.height(glm::dvec2(p))) return t;
  }
  return std::nullopt;
}

TEST(HeightField, RayCastAgreesWithBruteForce) {
  int hits = 0;
  for (const Border border : {Border::Clamp, Border::Repeat}) {
    const Field field = randomField(51, 16, 16, border);
    base::Random random(52);
    for (int i = 0; i < 400; ++i) {
      const glm::dvec3 from(random.uniform(-20.0, 50.0), random.uniform(-20.0, 60.0), random.uniform(-2.0, 9.0));
      const glm::dvec3 d = glm::normalize(glm::dvec3(random.normal(), random.normal(), random.uniform(-0.6, 0.15)));
      const auto slow = bruteForce(*field, from, d, 60.0);
      const auto fast = field->rayCast(from, d, 60.0);
      if (slow) {
        ASSERT_TRUE(fast) << i;
        // Brute force is late by a step at most; it may miss a graze that the exact walk finds, never the reverse.
        EXPECT_LE(*fast, *slow + 1e-6) << i;
        if (*fast < *slow - 2.1e-3) {
          const glm::dvec3 p = from + d * *fast;
          EXPECT_NEAR(p.z, field->height(glm::dvec2(p)), 1e-5);
        }
        ++hits;
      } else if (fast) {
        const glm::dvec3 p = from + d * *fast;
        EXPECT_NEAR(p.z, field->height(glm::dvec2(p)), 1e-5) << i;
      }
    }
  }
  EXPECT_GT(hits, 300);
}

TEST(HeightField, RayCastHardCases) {
  const Field flat = fieldOf(gridOf(5, 5, 1.0, [](double, double) { return 2.0; }));
  EXPECT_NEAR(flat->rayCast({0, 9, 12}, {0, 0, -1}, 1e9).value(), 10.0, 1e-5);
  EXPECT_NEAR(flat->rayCast({1e6, -1e6, 12}, {0, 0, -1}, 1e9).value(), 10.0, 1e-2);
  EXPECT_FALSE(flat->rayCast({0, 9, 12}, {0, 0, 1}, 1e9));
  EXPECT_FALSE(flat->rayCast({0, 9, 12}, {0, 0, -1}, 9.9));
  EXPECT_FALSE(flat->rayCast({0, 9, 12}, {1, 0, 0}, 1e6));
  EXPECT_EQ(flat->rayCast({0, 9, 1}, {0, 0, 1}, 1.0).value(), 0.0);
  EXPECT_FALSE(flat->rayCast({std::nan(""), 9, 1}, {0, 0, 1}, 1.0));
  const glm::dvec3 grazing = glm::normalize(glm::dvec3(1.0, 0.3, -0.001));
  EXPECT_NEAR(flat->rayCast({-900, 9, 3}, grazing, 1e5).value(), -1.0 / grazing.z, 1e-2);
}

TEST(HeightField, BadGridsAreRefused) {
  const HeightGrid good = gridOf(4, 4, 1.0, [](double, double) { return 0.0; });
  const auto refused = [](HeightGrid grid) { return !HeightField::create(std::move(grid)).ok(); };
  HeightGrid bad = good;
  bad.heights[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.heights.pop_back();
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.cellM.x = -1.0;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.columns = 1;
  bad.heights.resize(4);
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.columns = 100000;
  EXPECT_TRUE(refused(bad));
  bad = gridOf(5, 4, 1.0, [](double, double) { return 0.0; });
  bad.border = Border::Repeat;
  EXPECT_TRUE(refused(bad));
  std::stop_source stop;
  stop.request_stop();
  const auto cancelled = HeightField::create(good, {stop.get_token(), {}, 1});
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(Hills, AreDeterministicEndlessAndInRange) {
  HillOptions options;
  const HeightGrid a = makeHills(options, {{}, {}, 1}).value(), b = makeHills(options, {{}, {}, 3}).value();
  EXPECT_EQ(a.heights, b.heights);
  options.seed = 2;
  EXPECT_NE(a.heights, makeHills(options).value().heights);
  const auto [low, high] = std::minmax_element(a.heights.begin(), a.heights.end());
  EXPECT_NEAR(static_cast<double>(*high - *low), 14.0, 1e-4);
  const Field field = fieldOf(a);
  EXPECT_NEAR(field->height({0, 0}), 0.0, 1e-6);
  // No seam where the grid begins again: slopes there are like slopes elsewhere.
  double steepest = 0.0, atSeam = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double along = i * 1.7;
    steepest = std::max(steepest, glm::length(field->sample({along, 0.37 * along}).gradient));
    atSeam = std::max(atSeam, glm::length(field->sample({-0.5 * a.cellM.x, along}).gradient));
  }
  EXPECT_LT(atSeam, 1.5 * steepest);
}

TEST(Hills, HardCases) {
  for (const int octaves : {1, 7}) {
    for (const double ruggedness : {0.0, 1.0}) {
      HillOptions options;
      options.octaves = octaves;
      options.ruggedness = ruggedness;
      const HeightGrid grid = makeHills(options).value();
      // Neighbours differ by less than a fifth of the range: the smallest octave is resolved.
      float jump = 0.0f;
      for (int y = 0; y < grid.rows; ++y)
        for (int x = 1; x < grid.columns; ++x) jump = std::max(jump, std::abs(grid.at(x, y) - grid.at(x - 1, y)));
      EXPECT_LT(jump, 0.35f * 14.0f) << octaves << ' ' << ruggedness;
    }
  }
  HillOptions options;
  options.amplitudeM = 0.0;
  const HeightGrid flat = makeHills(options).value();
  EXPECT_EQ(*std::max_element(flat.heights.begin(), flat.heights.end()), 0.0f);
  options.octaves = 8;
  EXPECT_FALSE(makeHills(options).ok());
  options = {};
  options.featureSizeM = 0.0;
  EXPECT_FALSE(makeHills(options).ok());
  options = {};
  options.ruggedness = std::nan("");
  EXPECT_FALSE(makeHills(options).ok());
}

}  // namespace
}  // namespace sward::terrain
