#include "report/stability.h"

#include "lpt/quantisation.h"
#include "report/fit_oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

const std::vector<HardCase>& cases() {
  static const std::vector<HardCase> all = [] {
    auto made = hardCases({});
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().text());
    return made.ok() ? std::move(made).value() : std::vector<HardCase>{};
  }();
  return all;
}

const HardCase& caseOf(const std::string& name) {
  const auto found = std::find_if(cases().begin(), cases().end(), [&](const HardCase& c) { return c.name == name; });
  EXPECT_NE(found, cases().end()) << name;
  return *found;
}

Stability stabilityOf(const HardCase& one, const lpt::FitOptions& options) {
  auto measured = measureStability(one, options, {});
  EXPECT_TRUE(measured.ok()) << (measured.ok() ? "" : measured.error().text());
  return measured.ok() ? std::move(measured).value() : Stability{};
}

/// What holds of any fit of any case; the bounds are derived in core/report/stability_bounds.h.
void expectSound(const Stability& s) {
  EXPECT_TRUE(s.finite);
  EXPECT_EQ(s.wrongRanks, 0);
  EXPECT_LE(s.coefficientShare, 1.0);
  EXPECT_LE(s.errorShare, 1.0);
  EXPECT_LE(s.coefficientErrorShare, 1.0);
  EXPECT_LE(s.orderShare, 1.0);
  EXPECT_LE(s.quantisationShare, 1.0);
  // No singular value is so close to the rank's tolerance that rounding would decide.
  EXPECT_GT(s.rankMargin, 1.001);
  if (s.moments + s.orthogonal == 0) return;
  // lpt::Fit: stated from below, within a tenth; 2^-23 for its storage as float and 1e-6 for singular values in double.
  EXPECT_GE(s.conditionLow, 0.9);
  EXPECT_LE(s.conditionHigh, 1.0 + 0x1p-23 + 1e-6);
}

TEST(Stability, EveryFitOfEveryHardCaseIsWithinItsBounds) {
  EXPECT_GE(cases().size(), 20u);
  for (const HardCase& one : cases()) {
    for (const HardFit fit : kHardFits) {
      SCOPED_TRACE(one.name + ", " + hardFitName(fit));
      const Stability s = stabilityOf(one, hardFitOptions(fit));
      EXPECT_EQ(s.wrongPaths, 0);
      EXPECT_EQ(s.moments + s.orthogonal + s.empty, one.columns);
      expectSound(s);
    }
  }
}

/// A ridge of 1e-7 leaves the normal equations on all but the worst lights, with a condition of thousands.
TEST(Stability, SmallRidgesKeepTheirBounds) {
  for (const HardCase& one : cases()) {
    for (const double ridge : {1e-4, 1e-7, 3e-8, 0.0}) {
      for (const lpt::Basis basis : {lpt::Basis::Lpt, lpt::Basis::Ptm}) {
        SCOPED_TRACE(one.name + ", ridge " + std::to_string(ridge));
        lpt::FitOptions options;
        options.basis = basis;
        options.layerRidge = options.lightRidge = ridge;
        expectSound(stabilityOf(one, options));
      }
    }
  }
}

TEST(Stability, PathsAreThoseThatACaseIsMadeFor) {
  const auto lpt = [](const char* name) { return stabilityOf(caseOf(name), {}); };
  for (const char* name : {"lights_one", "lights_three", "lights_five", "lights_coincident"}) {
    EXPECT_EQ(lpt(name).orthogonal, 6) << name;
  }
  for (const char* name : {"lights_coplanar", "lights_ring", "lights_horizon", "visibility_zero"}) {
    EXPECT_EQ(lpt(name).moments, 6) << name;
  }
  EXPECT_EQ(lpt("layers_none").empty, 3);
  EXPECT_EQ(stabilityOf(caseOf("visibility_zero"), hardFitOptions(HardFit::LptPaper)).empty, 6);
  for (const char* name : {"sample_nan", "sample_infinite"}) {
    const Stability s = lpt(name);
    EXPECT_EQ(s.orthogonal, 4) << name;
    EXPECT_EQ(s.moments, 1) << name;
    EXPECT_EQ(s.empty, 1) << name;
  }
}

/// Lengths times a power of two scale every product and quotient of lengths exactly: the same bits, unless a length is
/// compared with a constant.
TEST(Stability, PatchesOfAMillimetreAndAKilometreGiveTheSameSamples) {
  const HardCase& metre = caseOf("patch_1m");
  EXPECT_GT(metre.layer.size(), 100u);
  EXPECT_TRUE(std::any_of(metre.samples[3].begin(), metre.samples[3].end(), [](float y) { return y > 0.1f; }));
  for (const char* name : {"patch_1mm", "patch_1km"}) {
    const HardCase& other = caseOf(name);
    EXPECT_EQ(other.columnStart, metre.columnStart);
    EXPECT_EQ(other.layer, metre.layer);
    EXPECT_EQ(other.coverage, metre.coverage);
    EXPECT_EQ(other.visibility, metre.visibility);
    EXPECT_EQ(other.samples, metre.samples);
  }
}

/// The oracle itself: samples of a polynomial come back as that polynomial, to long double's rounding.
TEST(Stability, TheOracleFindsAPolynomialAgain) {
  HardCase exact = caseOf("lights_fifteen");
  const std::array<double, 10> b{0.5, -0.25, 0.75, 0.125, -0.5, 0.25, 1.0, -1.5, 0.375, 2.0};
  std::vector<std::vector<float>> samples = exact.samples;
  lpt::FitOptions options;
  options.layerRidge = options.lightRidge = 0.0;
  // Lights at multiples of 1/8 and sixteenths of u: products of few bits, that a float sample holds exactly.
  exact.lights.clear();
  for (int x = -2; x <= 2; ++x) {
    for (int y = -1; y <= 1; ++y) exact.lights.emplace_back(x / 4.0, y / 4.0, 0.8);
  }
  for (std::size_t k = 0; k < 15; ++k) {
    for (std::size_t t = 0; t < exact.layer.size(); ++t) {
      const double lx = exact.lights[k].x, ly = exact.lights[k].y, u = exact.layer[t] / 16.0;
      const double f = b[0] * lx * lx + b[1] * ly * ly + b[2] * u * u + 2 * b[3] * lx * ly + 2 * b[4] * lx * u +
                       2 * b[5] * ly * u + 2 * b[6] * lx + 2 * b[7] * ly + 2 * b[8] * u + b[9];
      exact.samples[k][t] = static_cast<float>(f);
      ASSERT_EQ(static_cast<double>(exact.samples[k][t]), f);
    }
  }
  const std::size_t last = exact.columnStart.size() - 2;
  const OracleSolution solved =
      solveOracle(exact.input(), options, exact.columnStart[last], exact.columnStart[last + 1]);
  ASSERT_EQ(solved.rank, 10);
  const auto found = solved.expanded(0);
  // Householder: (m + n) n 2^-64 k |x|, no residual to square k; times 4 for the expansion.
  const long double bound = 4 * (solved.rows + 10) * 10 * 0x1p-64L * solved.condition * solved.norm(0) * 3;
  for (std::size_t j = 0; j < 10; ++j) EXPECT_LE(std::abs(found[j] - static_cast<long double>(b[j])), bound) << j;
  EXPECT_LT(bound, 1e-12L);
}

/// The oracle sees what a fit was given: one sample of fifteen off by 1e-4 moves coefficients a hundred times further
/// than the bounds above allow.
TEST(Stability, AShiftOfOneSampleIsBeyondTheBounds) {
  const HardCase& one = caseOf("lights_fifteen");
  HardCase off = one;
  off.samples[0][0] += 1e-4f;
  auto fitted = lpt::fit(off.input(), {}, {});
  ASSERT_TRUE(fitted.ok());
  const OracleSolution exact = solveOracle(one.input(), {}, one.columnStart[0], one.columnStart[1]);
  double largest = 0.0;
  for (std::size_t j = 0; j < 10; ++j) {
    const double b = static_cast<double>(fitted.value().column(0, 0)[j]);
    largest = std::max(largest, std::abs(b - static_cast<double>(exact.expanded(0)[j])));
  }
  EXPECT_GT(largest, 1e-5);
}

/// high - low beyond what a float holds: stored / scale would be infinite.
TEST(Stability, RangesWiderThanAFloatAreReadBackFinite) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  const std::vector<float> values{-kLargest, 0.0f, kLargest, 1.0f};
  for (const int bits : {8, 16}) {
    lpt::FitOptions options;
    options.bits = bits;
    const lpt::QuantisedSets sets = lpt::quantiseSets(values, 1, options, {});
    const std::uint32_t top = bits == 8 ? 255 : 65535;
    for (const std::uint32_t q : {0u, top / 2, top}) EXPECT_TRUE(std::isfinite(sets.ranges[0].value(q))) << bits;
    EXPECT_LT(sets.ranges[0].value(0), -8e37f);
    EXPECT_GT(sets.ranges[0].value(top), 8e37f);
  }
}

}  // namespace
}  // namespace sward::report
