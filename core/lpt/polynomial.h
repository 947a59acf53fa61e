#pragma once

#include <array>
#include <span>

#include <glm/glm.hpp>

namespace sward::lpt {

inline constexpr int kLptCoefficients = 10;
inline constexpr int kPtmCoefficients = 6;

/// The ten functions of f(l, u) in the paper's order (equation 2), factors 2 included, so that f = sum b_j phi_j:
/// lx^2, ly^2, u^2, 2 lx ly, 2 lx u, 2 ly u, 2 lx, 2 ly, 2 u, 1.
std::array<double, kLptCoefficients> lptBasis(double lx, double ly, double u);
/// The six of PTM (equation 1): lx^2, ly^2, 2 lx ly, 2 lx, 2 ly, 1.
std::array<double, kPtmCoefficients> ptmBasis(double lx, double ly);

/// The same for LayerCoordinate::Response, g the texel's coordinate: what quadratics of the light alone tell is common
/// to all texels, so that their places hold how the light's direction matters to bright and dark texels. One is unused:
/// 2 lx g^2, 2 ly g^2, g^2, 0, 2 lx g, 2 ly g, 2 lx, 2 ly, 2 g, 1.
std::array<double, kLptCoefficients> responseBasis(double lx, double ly, double g);

/// f = A + B u + C u^2 for one light (equation 5).
struct LayerQuadratic {
  double a = 0.0, b = 0.0, c = 0.0;
  double operator()(double u) const { return a + (b + c * u) * u; }
};
LayerQuadratic atLight(std::span<const float, kLptCoefficients> coefficients, double lx, double ly);

/// f itself, from the coefficients in float: the sum over lptBasis or ptmBasis.
double evaluateLpt(std::span<const float, kLptCoefficients> coefficients, double lx, double ly, double u);
double evaluatePtm(std::span<const float, kPtmCoefficients> coefficients, double lx, double ly);

/// Gram matrix of the ten functions, row by row: G_jk = integral of phi_j phi_k over u in [0, 1] and (lx, ly) in the
/// unit disc of lights that exist, or in the square [-1, 1]^2 as in the paper (equation 9). In closed form.
enum class LightDomain { Disc, Square };
std::array<double, kLptCoefficients * kLptCoefficients> gramMatrix(LightDomain domain);

}  // namespace sward::lpt
