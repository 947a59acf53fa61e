#include "samples.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// The minimisation that options.h states, written out in extended precision from the finite rows of a column.
struct Oracle {
  LongMatrix rows;    ///< normalised data rows in v
  LongMatrix system;  ///< with the ridge's rows
  LongVector right;
  long double mean = 0.0L;

  Oracle(const Scene& scene, int column, std::size_t channel, const FitOptions& options, int directions) {
    const auto at = static_cast<std::size_t>(column);
    long double total = 0.0L;
    std::vector<std::array<std::size_t, 2>> kept;
    for (std::size_t t = scene.columnStart[at]; t < scene.columnStart[at + 1]; ++t) {
      for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        bool finite = true;
        for (std::size_t c = 0; c < static_cast<std::size_t>(scene.channels); ++c) {
          finite = finite && std::isfinite(scene.sample(c, k, t));
        }
        if (!finite) continue;
        kept.push_back({t, k});
        total += weight(scene, t, directions);
        mean += weight(scene, t, directions) * static_cast<long double>(scene.u(t));
      }
    }
    mean /= total;
    const auto count = static_cast<Eigen::Index>(kept.size());
    system = LongMatrix::Zero(count + 10, 10);
    right = LongVector::Zero(count + 10);
    for (Eigen::Index r = 0; r < count; ++r) {
      const auto [t, k] = kept[static_cast<std::size_t>(r)];
      const long double root = std::sqrt(weight(scene, t, directions) / total);
      const auto phi = lptBasis(scene.lights[k].x, scene.lights[k].y, static_cast<double>(scene.u(t) - mean));
      for (Eigen::Index j = 0; j < 10; ++j)
        system(r, j) = root * static_cast<long double>(phi[static_cast<std::size_t>(j)]);
      right(r) = root * static_cast<long double>(scene.sample(channel, k, t));
    }
    rows = system.topRows(count);
    for (Eigen::Index j = 0; j < 9; ++j) {
      const bool layered = j == 2 || j == 4 || j == 5 || j == 8;
      system(count + j, j) = std::sqrt(static_cast<long double>(layered ? options.layerRidge : options.lightRidge));
    }
  }

  std::array<float, 10> coefficients() const {
    LongVector b = system.colPivHouseholderQr().solve(right);
    b(9) += mean * (b(2) * mean - 2.0L * b(8));
    b(8) -= b(2) * mean;
    b(6) -= b(4) * mean;
    b(7) -= b(5) * mean;
    std::array<float, 10> out;
    for (Eigen::Index j = 0; j < 10; ++j) out[static_cast<std::size_t>(j)] = static_cast<float>(b(j));
    return out;
  }
  double condition() const {
    const Eigen::VectorXd s = system.cast<double>().jacobiSvd().singularValues();
    return s.maxCoeff() / s.minCoeff();
  }
  int rank() const {
    const Eigen::VectorXd s = rows.cast<double>().jacobiSvd().singularValues();
    return static_cast<int>((s.array() > 1e-6 * s.maxCoeff()).count());
  }

 private:
  static long double weight(const Scene& scene, std::size_t t, int directions) {
    return std::max(static_cast<long double>(scene.visibility[t]), 0.5L / directions) *
           static_cast<long double>(scene.coverage[t]);
  }
};

TEST(Fit, FastPathEqualsAnExtendedPrecisionQr) {
  const Scene scene = randomScene(300, 16, 15, 2, 11);
  for (const FitOptions options : {FitOptions{}, FitOptions{.layerRidge = 0.3, .lightRidge = 1e-4}}) {
    const Fit fit = fitted(scene, options);
    for (int c = 0; c < scene.columns; ++c) {
      ASSERT_EQ(fit.path[static_cast<std::size_t>(c)], FitPath::Moments);
      for (int channel = 0; channel < 2; ++channel) {
        const auto expected = Oracle(scene, c, static_cast<std::size_t>(channel), options, 16).coefficients();
        ASSERT_LT(relativeDifference(fit.column(c, channel), expected), 1e-6) << c;
      }
    }
  }
}

TEST(Fit, RankAndConditionAreThoseOfTheRows) {
  const Scene scene = randomScene(200, 16, 15, 1, 12);
  const Fit fit = fitted(scene);
  std::array<int, 11> seen{};
  for (int c = 0; c < scene.columns; ++c) {
    const auto at = static_cast<std::size_t>(c);
    const Oracle oracle(scene, c, 0, {}, 16);
    ASSERT_EQ(fit.rank[at], oracle.rank()) << c;
    const double exact = oracle.condition(), estimate = static_cast<double>(fit.condition[at]);
    ASSERT_LE(estimate, exact * 1.00001) << c;
    ASSERT_GE(estimate, exact * 0.9) << c;
    ++seen[fit.rank[at]];
  }
  EXPECT_GT(seen[6], 0);
  EXPECT_GT(seen[9], 0);
  EXPECT_GT(seen[10], 0);
}

TEST(Fit, RecoversAPolynomialWithoutRidge) {
  const std::array<float, 10> truth{0.3f, -0.2f, 0.5f, 0.1f, -0.4f, 0.2f, 0.15f, -0.25f, 0.35f, 0.6f};
  Scene scene;
  const auto response = [&](int, int layer, const glm::dvec3& l) { return evaluateLpt(truth, l.x, l.y, layer / 16.0); };
  addColumn(scene, {0, 3, 5, 9, 15}, response);
  addColumn(scene, {2, 3, 4}, response);
  for (const bool paper : {false, true}) {
    const Fit fit = fitted(scene, {.paper = paper, .layerRidge = 0.0, .lightRidge = 0.0});
    // Samples are rounded to float; the three adjacent layers of the second column amplify that by 1 / (1/16)^2.
    EXPECT_LT(relativeDifference(fit.column(0, 0), truth), 1e-5) << paper;
    EXPECT_LT(relativeDifference(fit.column(1, 0), truth), 1e-3) << paper;
    EXPECT_EQ(fit.rank[0], 10);
  }
}

TEST(Fit, OneLayerLptEqualsPtm) {
  Scene scene = randomScene(100, 1, 15, 2, 13);
  for (const bool paper : {false, true}) {
    for (const double ridge : {0.002, 0.1, 0.0}) {
      FitOptions options{.paper = paper, .lightRidge = ridge};
      const Fit lpt = fitted(scene, options);
      options.basis = Basis::Ptm;
      const Fit ptm = fitted(scene, options);
      for (int c = 0; c < scene.columns; ++c) {
        for (int channel = 0; channel < 2; ++channel) {
          const auto b = lpt.column(c, channel);
          const std::array<float, 6> a{b[0], b[1], b[3], b[6], b[7], b[9]};
          ASSERT_LT(relativeDifference(a, ptm.column(c, channel)), 1e-6);
          for (const std::size_t layered : {2, 4, 5, 8}) ASSERT_NEAR(static_cast<double>(b[layered]), 0.0, 1e-9);
        }
      }
    }
  }
}

TEST(Fit, PtmFitsEveryLayerByItself) {
  Scene scene;
  scene.layers = 3;
  const std::array<std::array<float, 6>, 3> truth{
      {{0.1f, 0.2f, 0.3f, -0.1f, 0.2f, 0.5f}, {}, {-0.3f, 0.1f, 0.0f, 0.2f, 0.1f, 0.4f}}};
  addColumn(scene, {0, 2}, [&](int, int layer, const glm::dvec3& l) {
    return evaluatePtm(truth[static_cast<std::size_t>(layer)], l.x, l.y);
  });
  const Fit fit = fitted(scene, {.basis = Basis::Ptm, .lightRidge = 0.0});
  ASSERT_EQ(fit.perColumn, 18);
  for (std::size_t layer = 0; layer < 3; ++layer) {
    EXPECT_LT(relativeDifference(fit.column(0, 0).subspan(layer * 6, 6), truth[layer]), 1e-5) << layer;
    EXPECT_EQ(fit.layerWeight[layer] > 0.0f, layer != 1);
  }
  EXPECT_EQ(fit.rank[0], 6);
}

TEST(Fit, OrderOfLightsAndLayersDoesNotMatter) {
  const Scene scene = randomScene(64, 16, 15, 1, 14);
  Scene turned = scene;
  std::vector<std::size_t> order(15);
  std::iota(order.begin(), order.end(), 0u);
  std::reverse(order.begin(), order.end());
  std::swap(order[2], order[9]);
  for (std::size_t k = 0; k < 15; ++k) {
    turned.lights[k] = scene.lights[order[k]];
    turned.samples[k] = scene.samples[order[k]];
  }
  for (std::size_t c = 0; c < 64; ++c) {
    const auto flip = [&](auto& values) {
      std::reverse(values.begin() + scene.columnStart[c], values.begin() + scene.columnStart[c + 1]);
    };
    flip(turned.layer);
    flip(turned.coverage);
    flip(turned.visibility);
    for (auto& values : turned.samples) flip(values);
  }
  for (const FitOptions options : {FitOptions{}, FitOptions{.basis = Basis::Ptm}}) {
    const Fit a = fitted(scene, options), b = fitted(turned, options);
    for (int c = 0; c < 64; ++c) ASSERT_LT(relativeDifference(a.column(c, 0), b.column(c, 0)), 1e-6);
  }
}

TEST(Fit, SameBytesOnAnyNumberOfThreads) {
  Scene scene = randomScene(1000, 16, 15, 2, 15);
  scene.samples[4][100] = std::numeric_limits<float>::quiet_NaN();
  for (const FitOptions options : {FitOptions{}, FitOptions{.basis = Basis::Ptm}, FitOptions{.paper = true}}) {
    const Fit one = fitted(scene, options, 1);
    for (const int threads : {2, 3, 7}) {
      const Fit many = fitted(scene, options, threads);
      EXPECT_EQ(one.coefficients, many.coefficients);
      EXPECT_EQ(one.condition, many.condition);
      EXPECT_EQ(one.rank, many.rank);
    }
  }
}

TEST(Fit, MissingSamplesLeaveOutTheirRowsOnly) {
  Scene scene = randomScene(20, 16, 15, 2, 16);
  const float bad[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       -std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < scene.layer.size(); i += 3) scene.samples[i % 30][i] = bad[i % 9 / 3];
  const Fit fit = fitted(scene);
  for (int c = 0; c < scene.columns; ++c) {
    for (int channel = 0; channel < 2; ++channel) {
      const auto expected = Oracle(scene, c, static_cast<std::size_t>(channel), {}, 16).coefficients();
      ASSERT_LT(relativeDifference(fit.column(c, channel), expected), 1e-6) << c;
    }
  }
  EXPECT_GT(std::count(fit.path.begin(), fit.path.end(), FitPath::Orthogonal), 10);
}

TEST(Fit, PaperHasMinimumNormAndLeastResidual) {
  Scene scene;
  base::Random random(17);
  for (const std::vector<int>& layers : {std::vector<int>{4}, {4, 11}, {1, 2, 3}, {0, 5, 10, 15}}) {
    addColumn(scene, layers, [&](int, int, const glm::dvec3&) { return random.uniform(); });
  }
  for (std::size_t t = 0; t < scene.layer.size(); ++t)
    scene.visibility[t] = static_cast<float>(random.uniform(0.2, 1.0));
  const Fit fit = fitted(scene, {.paper = true});
  for (std::size_t c = 0; c < 4; ++c) {
    const std::size_t begin = scene.columnStart[c], end = scene.columnStart[c + 1];
    LongMatrix rows(static_cast<Eigen::Index>((end - begin) * 15), 10);
    LongVector right(rows.rows());
    for (std::size_t t = begin; t < end; ++t) {
      for (std::size_t k = 0; k < 15; ++k) {
        const auto r = static_cast<Eigen::Index>((t - begin) * 15 + k);
        const long double root = std::sqrt(static_cast<long double>(scene.visibility[t]));
        const auto phi = lptBasis(scene.lights[k].x, scene.lights[k].y, scene.u(t));
        for (Eigen::Index j = 0; j < 10; ++j)
          rows(r, j) = root * static_cast<long double>(phi[static_cast<std::size_t>(j)]);
        right(r) = root * static_cast<long double>(scene.sample(0, k, t));
      }
    }
    Eigen::CompleteOrthogonalDecomposition<LongMatrix> cod;
    cod.setThreshold(1e-6L);
    const LongVector b = cod.compute(rows).solve(right);
    std::array<float, 10> expected;
    for (Eigen::Index j = 0; j < 10; ++j) expected[static_cast<std::size_t>(j)] = static_cast<float>(b(j));
    EXPECT_LT(relativeDifference(fit.column(static_cast<int>(c), 0), expected), 1e-6) << c;
    EXPECT_EQ(fit.rank[c], cod.rank()) << c;
    EXPECT_EQ(fit.path[c], FitPath::Orthogonal);
  }
  EXPECT_EQ(fit.rank[0], 6);
  EXPECT_EQ(fit.rank[1], 9);
}

}  // namespace
}  // namespace sward::lpt::test
