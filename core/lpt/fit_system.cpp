#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace sward::lpt::detail {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

int countDistinct(std::span<const glm::dvec3> lights) {
  std::vector<std::array<double, 2>> seen;
  for (const glm::dvec3& light : lights) seen.push_back({light.x, light.y});
  std::sort(seen.begin(), seen.end());
  return static_cast<int>(std::unique(seen.begin(), seen.end()) - seen.begin());
}

/// Numerical rank of the six functions, from singular values of their rows (not of A, whose eigenvalues are squares).
int functionRank(const LightSystem& system) {
  const auto count = static_cast<Eigen::Index>(system.functions.size());
  Eigen::MatrixXd rows(count, 6);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index p = 0; p < 6; ++p) {
      rows(k, p) = system.functions[static_cast<std::size_t>(k)][static_cast<std::size_t>(p)];
    }
  }
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(rows).singularValues();
  return static_cast<int>((values.array() > kRankTolerance * values.maxCoeff()).count());
}

void decomposeLights(LightSystem& system, const Matrix6& data, double ridge) {
  Matrix6 block = data;
  for (Eigen::Index p = 0; p < 5; ++p) block(p, p) += ridge;
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(block);
  const Vector6 mean = data.col(5);  // the sixth function is 1
  Eigen::Map<Vector6>(system.lightValues.data()) = eigen.eigenvalues();
  Eigen::Map<Vector6>(system.lightMean.data()) = eigen.eigenvectors().transpose() * mean;
  system.dataScale = Eigen::SelfAdjointEigenSolver<Matrix6>(data).eigenvalues()(5);
  system.wellConditioned = system.distinctLights >= 6 && system.lightValues[0] > kMinPivot * system.lightValues[5];
  if (!system.wellConditioned) return;
  const Matrix6 inverse =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  Eigen::Map<Matrix6>(system.inverse.data()) = inverse;
}

}  // namespace

LightSystem makeLightSystem(std::span<const glm::dvec3> lights, const FitOptions& options) {
  LightSystem system;
  system.distinctLights = countDistinct(lights);
  Matrix6 data = Matrix6::Zero();
  Eigen::Matrix3d layers = Eigen::Matrix3d::Zero();
  for (const glm::dvec3& light : lights) {
    system.functions.push_back(ptmBasis(light.x, light.y));
    const Eigen::Map<const Vector6> g(system.functions.back().data());
    const Eigen::Vector3d h(2.0 * light.x, 2.0 * light.y, 2.0);
    data += g * g.transpose();
    layers += h * h.transpose();
  }
  data /= static_cast<double>(lights.size());
  layers /= static_cast<double>(lights.size());
  system.lightRank = functionRank(system);
  decomposeLights(system, data, options.lightRidge);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(layers);
  for (Eigen::Index j = 0; j < 3; ++j) {
    const auto at = static_cast<std::size_t>(j);
    system.layerValues[at] = std::max(eigen.eigenvalues()(j), 0.0);
    // E[h] = H e3 / 2, since the third component of h is 2.
    system.layerMean[at] = 0.5 * eigen.eigenvectors().col(j).dot(layers.col(2));
    for (Eigen::Index i = 0; i < 3; ++i)
      system.layerVectors[static_cast<std::size_t>(i) * 3 + at] = eigen.eigenvectors()(i, j);
  }
  return system;
}

double FitJob::weight(std::size_t texel) const {
  const double delta = static_cast<double>(input.visibility[texel]);
  double w = delta;
  if (!(options.paper && options.basis == Basis::Lpt)) {
    w = std::max(std::isfinite(delta) ? delta : 0.0, 0.5 / input.visibilityDirections) *
        static_cast<double>(input.coverage[texel]);
  }
  return std::isfinite(w) && w > 0.0 ? w : 0.0;
}

float storedCoefficient(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

float storedWeight(double value) {
  return std::max(storedCoefficient(value), std::numeric_limits<float>::min());
}

}  // namespace sward::lpt::detail
