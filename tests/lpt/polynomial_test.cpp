#include "lpt/polynomial.h"

#include "base/random.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::lpt {
namespace {

struct Node {
  double x, weight;
};

/// Gauss-Legendre with 5 nodes on [low, high]: exact to degree 9.
std::array<Node, 5> gauss(double low, double high) {
  const double a = std::sqrt(5.0 - 2.0 * std::sqrt(10.0 / 7.0)) / 3.0,
               b = std::sqrt(5.0 + 2.0 * std::sqrt(10.0 / 7.0)) / 3.0;
  const double wa = (322.0 + 13.0 * std::sqrt(70.0)) / 900.0, wb = (322.0 - 13.0 * std::sqrt(70.0)) / 900.0;
  std::array<Node, 5> nodes{{{-b, wb}, {-a, wa}, {0.0, 128.0 / 225.0}, {a, wa}, {b, wb}}};
  for (Node& n : nodes) n = {0.5 * (low + high) + 0.5 * (high - low) * n.x, 0.5 * (high - low) * n.weight};
  return nodes;
}

using Gram = std::array<double, 100>;

void accumulate(Gram& gram, double lx, double ly, double weight) {
  for (const Node& u : gauss(0.0, 1.0)) {
    const auto phi = lptBasis(lx, ly, u.x);
    for (std::size_t j = 0; j < 10; ++j) {
      for (std::size_t k = 0; k < 10; ++k) gram[j * 10 + k] += weight * u.weight * phi[j] * phi[k];
    }
  }
}

TEST(Polynomial, GramMatrixOfTheSquareEqualsQuadrature) {
  Gram expected{};
  for (const Node& x : gauss(-1.0, 1.0)) {
    for (const Node& y : gauss(-1.0, 1.0)) accumulate(expected, x.x, y.x, x.weight * y.weight);
  }
  const Gram gram = gramMatrix(LightDomain::Square);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(gram[i], expected[i], 1e-14) << i / 10 << ',' << i % 10;
}

TEST(Polynomial, GramMatrixOfTheDiscEqualsQuadrature) {
  // Trapezia over the angle are exact for trigonometric polynomials of degree below their number.
  constexpr int kAngles = 16;
  Gram expected{};
  for (const Node& r : gauss(0.0, 1.0)) {
    for (int i = 0; i < kAngles; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.3) / kAngles;
      accumulate(expected, r.x * std::cos(angle), r.x * std::sin(angle),
                 r.weight * r.x * 2.0 * std::numbers::pi / kAngles);
    }
  }
  const Gram gram = gramMatrix(LightDomain::Disc);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(gram[i], expected[i], 1e-14) << i / 10 << ',' << i % 10;
}

std::array<float, 10> someCoefficients(base::Random& random) {
  std::array<float, 10> b;
  for (float& value : b) value = static_cast<float>(random.uniform(-2.0, 2.0));
  return b;
}

TEST(Polynomial, QuadraticInLayerEqualsTheMatrixForm) {
  // Equation 2 as a symmetric form: (lx ly u 1) M (lx ly u 1)^T.
  base::Random random(1);
  for (int run = 0; run < 1000; ++run) {
    const auto b = someCoefficients(random);
    const double m[4][4] = {
        {b[0], b[3], b[4], b[6]}, {b[3], b[1], b[5], b[7]}, {b[4], b[5], b[2], b[8]}, {b[6], b[7], b[8], b[9]}};
    const double lx = random.uniform(-1.0, 1.0), ly = random.uniform(-1.0, 1.0), u = random.uniform();
    const double vector[4] = {lx, ly, u, 1.0};
    double form = 0.0;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) form += vector[i] * m[i][j] * vector[j];
    }
    const LayerQuadratic q = atLight(b, lx, ly);
    EXPECT_NEAR(q(u), form, 1e-13);
    EXPECT_NEAR(q.a + q.b * u + q.c * u * u, form, 1e-13);
    EXPECT_NEAR(evaluateLpt(b, lx, ly, u), form, 1e-13);
  }
}

TEST(Polynomial, TopLayerIsThePtmOfItsLightCoefficients) {
  base::Random random(2);
  const auto b = someCoefficients(random);
  const std::array<float, 6> a{b[0], b[1], b[3], b[6], b[7], b[9]};
  EXPECT_NEAR(evaluateLpt(b, 0.3, -0.6, 0.0), evaluatePtm(a, 0.3, -0.6), 1e-14);
  EXPECT_GT(std::abs(evaluateLpt(b, 0.3, -0.6, 1.0) - evaluatePtm(a, 0.3, -0.6)), 1e-3);
}

TEST(Polynomial, GramMatrixMeasuresTheDifferenceOfTwoPolynomials) {
  base::Random random(3);
  const auto b = someCoefficients(random), c = someCoefficients(random);
  const Gram gram = gramMatrix(LightDomain::Square);
  double closed = 0.0, integral = 0.0;
  for (std::size_t j = 0; j < 10; ++j) {
    for (std::size_t k = 0; k < 10; ++k) closed += (b[j] - c[j]) * gram[j * 10 + k] * (b[k] - c[k]);
  }
  for (const Node& x : gauss(-1.0, 1.0)) {
    for (const Node& y : gauss(-1.0, 1.0)) {
      for (const Node& u : gauss(0.0, 1.0)) {
        const double d = evaluateLpt(b, x.x, y.x, u.x) - evaluateLpt(c, x.x, y.x, u.x);
        integral += x.weight * y.weight * u.weight * d * d;
      }
    }
  }
  EXPECT_NEAR(closed, integral, 1e-5 * integral);  // differences of coefficients are rounded to float above
}

}  // namespace
}  // namespace sward::lpt
