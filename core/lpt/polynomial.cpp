#include "lpt/polynomial.h"

#include <cstddef>
#include <numbers>

namespace sward::lpt {
namespace {

/// factor * lx^x ly^y u^u
struct Monomial {
  double factor;
  int x, y, u;
};

constexpr std::array<Monomial, kLptCoefficients> kMonomials{{{1, 2, 0, 0},
                                                             {1, 0, 2, 0},
                                                             {1, 0, 0, 2},
                                                             {2, 1, 1, 0},
                                                             {2, 1, 0, 1},
                                                             {2, 0, 1, 1},
                                                             {2, 1, 0, 0},
                                                             {2, 0, 1, 0},
                                                             {2, 0, 0, 1},
                                                             {1, 0, 0, 0}}};

constexpr double doubleFactorial(int n) {
  double product = 1.0;
  for (int i = n; i > 1; i -= 2) product *= i;
  return product;
}

/// Integral of x^a y^b over the square [-1, 1]^2: (2 / (a + 1)) (2 / (b + 1)) for even a and b, else 0.
double squareMoment(int a, int b) {
  if (a % 2 != 0 || b % 2 != 0) return 0.0;
  return (2.0 / (a + 1)) * (2.0 / (b + 1));
}

/// The same over the unit disc. In polar coordinates the radius gives 1 / (a + b + 2), and for even a and b
/// integral_0^2pi cos^a sin^b = 2 pi (a - 1)!! (b - 1)!! / (a + b)!!.
double discMoment(int a, int b) {
  if (a % 2 != 0 || b % 2 != 0) return 0.0;
  const double angle =
      2.0 * std::numbers::pi * doubleFactorial(a - 1) * doubleFactorial(b - 1) / doubleFactorial(a + b);
  return angle / (a + b + 2);
}

}  // namespace

std::array<double, kLptCoefficients> lptBasis(double lx, double ly, double u) {
  return {lx * lx, ly * ly, u * u, 2.0 * lx * ly, 2.0 * lx * u, 2.0 * ly * u, 2.0 * lx, 2.0 * ly, 2.0 * u, 1.0};
}

std::array<double, kLptCoefficients> responseBasis(double lx, double ly, double g) {
  const double square = g * g;
  return {2.0 * lx * square, 2.0 * ly * square, square,   0.0,     2.0 * lx * g,
          2.0 * ly * g,      2.0 * lx,          2.0 * ly, 2.0 * g, 1.0};
}

std::array<double, kPtmCoefficients> ptmBasis(double lx, double ly) {
  return {lx * lx, ly * ly, 2.0 * lx * ly, 2.0 * lx, 2.0 * ly, 1.0};
}

LayerQuadratic atLight(std::span<const float, kLptCoefficients> coefficients, double lx, double ly) {
  const auto b = [&](std::size_t j) { return static_cast<double>(coefficients[j]); };
  LayerQuadratic q;
  q.a = lx * (b(0) * lx + 2.0 * (b(3) * ly + b(6))) + ly * (b(1) * ly + 2.0 * b(7)) + b(9);
  q.b = 2.0 * (b(4) * lx + b(5) * ly + b(8));
  q.c = b(2);
  return q;
}

double evaluateLpt(std::span<const float, kLptCoefficients> coefficients, double lx, double ly, double u) {
  const auto basis = lptBasis(lx, ly, u);
  double sum = 0.0;
  for (std::size_t j = 0; j < basis.size(); ++j) sum += static_cast<double>(coefficients[j]) * basis[j];
  return sum;
}

double evaluatePtm(std::span<const float, kPtmCoefficients> coefficients, double lx, double ly) {
  const auto basis = ptmBasis(lx, ly);
  double sum = 0.0;
  for (std::size_t j = 0; j < basis.size(); ++j) sum += static_cast<double>(coefficients[j]) * basis[j];
  return sum;
}

std::array<double, kLptCoefficients * kLptCoefficients> gramMatrix(LightDomain domain) {
  std::array<double, kLptCoefficients * kLptCoefficients> gram{};
  for (std::size_t j = 0; j < kLptCoefficients; ++j) {
    for (std::size_t k = 0; k < kLptCoefficients; ++k) {
      const Monomial& p = kMonomials[j];
      const Monomial& q = kMonomials[k];
      const double light =
          domain == LightDomain::Disc ? discMoment(p.x + q.x, p.y + q.y) : squareMoment(p.x + q.x, p.y + q.y);
      gram[j * kLptCoefficients + k] = p.factor * q.factor * light / (p.u + q.u + 1);
    }
  }
  return gram;
}

}  // namespace sward::lpt
