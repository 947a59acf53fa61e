#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace sward::lpt::detail {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using SmallSvd = Eigen::JacobiSVD<Eigen::MatrixXd>;

int countAbove(const Eigen::VectorXd& values) {
  return static_cast<int>((values.array() > kRankTolerance * values(0)).count());
}

/// Triangle of the rows and the samples in its frame; rows are padded with zeros up to n of them.
void triangulate(const Rows& problem, Eigen::Index n, Eigen::MatrixXd& triangle, Eigen::MatrixXd& samples) {
  const auto rows = static_cast<Eigen::Index>(problem.rows.size()) / n;
  const auto channels = static_cast<Eigen::Index>(problem.channels);
  const Eigen::Index padded = std::max(rows, n);
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(padded, n), y = Eigen::MatrixXd::Zero(padded, channels);
  m.topRows(rows) = Eigen::Map<const RowMatrix>(problem.rows.data(), rows, n);
  y.topRows(rows) = Eigen::Map<const RowMatrix>(problem.samples.data(), rows, channels);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(m);
  triangle = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  samples = (qr.householderQ().transpose() * y).topRows(n);
}

}  // namespace

RowSolution solveRows(const Rows& problem) {
  const auto n = static_cast<Eigen::Index>(problem.ridge.size());
  const auto channels = static_cast<Eigen::Index>(problem.channels);
  Eigen::MatrixXd triangle, samples;
  triangulate(problem, n, triangle, samples);
  const bool ridged = std::any_of(problem.ridge.begin(), problem.ridge.end(), [](double r) { return r > 0.0; });
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(ridged ? 2 * n : n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(stacked.rows(), channels);
  stacked.topRows(n) = triangle;
  right.topRows(n) = samples;
  if (ridged) {
    for (Eigen::Index j = 0; j < n; ++j) stacked(n + j, j) = std::sqrt(problem.ridge[static_cast<std::size_t>(j)]);
  }
  const SmallSvd svd(stacked, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& values = svd.singularValues();
  RowSolution solution;
  solution.x.assign(static_cast<std::size_t>(n * channels), 0.0);
  if (!(values(0) > 0.0)) return solution;
  const Eigen::Index kept = countAbove(values);
  Eigen::Map<Eigen::MatrixXd>(solution.x.data(), n, channels) = svd.matrixV().leftCols(kept) *
                                                                values.head(kept).cwiseInverse().asDiagonal() *
                                                                (svd.matrixU().leftCols(kept).transpose() * right);
  solution.condition = values(0) / values(kept - 1);
  solution.rank = ridged ? countAbove(SmallSvd(triangle).singularValues()) : static_cast<int>(kept);
  return solution;
}

namespace {

/// Rows of one column that have samples in every channel, weighted but not normalised yet.
struct ColumnRows {
  double weight = 0.0;     ///< summed over the texels that have a row
  double rowWeight = 0.0;  ///< summed over the rows
  double mean = 0.0;       ///< of u over the rows
};

bool rowComplete(const FitJob& job, std::size_t texel, std::size_t light) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(job.input.channels); ++c) {
    if (!std::isfinite(job.sample(c, light)[texel])) return false;
  }
  return true;
}

ColumnRows measureColumn(const FitJob& job, std::size_t begin, std::size_t end) {
  ColumnRows column;
  for (std::size_t t = begin; t < end; ++t) {
    const double w = job.weight(t);
    int rows = 0;
    for (std::size_t k = 0; k < job.lights() && w > 0.0; ++k) rows += rowComplete(job, t, k) ? 1 : 0;
    if (rows == 0) continue;
    column.weight += w;
    column.rowWeight += w * rows;
    column.mean += w * rows * job.u(t);
  }
  if (column.rowWeight > 0.0) column.mean /= column.rowWeight;
  return column;
}

void appendRows(const FitJob& job, std::size_t texel, const ColumnRows& column, double origin, RowScratch& scratch) {
  const double w = job.weight(texel);
  if (!(w > 0.0)) return;
  const double root = std::sqrt(w / column.rowWeight);
  for (std::size_t k = 0; k < job.lights(); ++k) {
    if (!rowComplete(job, texel, k)) continue;
    const glm::dvec3& light = job.input.lights[k];
    for (const double phi : lptBasis(light.x, light.y, job.u(texel) - origin)) scratch.rows.push_back(root * phi);
    for (std::size_t c = 0; c < static_cast<std::size_t>(job.input.channels); ++c) {
      scratch.samples.push_back(root * static_cast<double>(job.sample(c, k)[texel]));
    }
  }
}

/// In place: coefficients of lptBasis in v = u - mean to those in u.
void expandInPlace(double* b, double mean) {
  b[9] += mean * (b[2] * mean - 2.0 * b[8]);
  b[8] -= b[2] * mean;
  b[6] -= b[4] * mean;
  b[7] -= b[5] * mean;
}

std::array<double, kLptCoefficients> lptRidge(const FitOptions& options) {
  if (options.paper) return {};
  const double r = options.lightRidge, v = options.layerRidge;
  return {r, r, v, r, v, v, r, r, v, 0.0};
}

}  // namespace

void fitLptColumnByRows(const FitJob& job, int column, RowScratch& scratch) {
  const auto at = static_cast<std::size_t>(column);
  const std::size_t begin = job.input.columnStart[at], end = job.input.columnStart[at + 1];
  const ColumnRows measured = measureColumn(job, begin, end);
  if (!(measured.rowWeight > 0.0)) return;
  const double origin = job.options.paper ? 0.0 : measured.mean;
  scratch.rows.clear();
  scratch.samples.clear();
  for (std::size_t t = begin; t < end; ++t) appendRows(job, t, measured, origin, scratch);
  const auto ridge = lptRidge(job.options);
  RowSolution solution = solveRows({scratch.rows, scratch.samples, ridge, job.input.channels});
  Fit& fit = job.fit;
  fit.weight[at] = storedWeight(measured.weight);
  fit.condition[at] = static_cast<float>(solution.condition);
  fit.rank[at] = static_cast<std::uint8_t>(solution.rank);
  fit.path[at] = FitPath::Orthogonal;
  for (std::size_t c = 0; c < static_cast<std::size_t>(job.input.channels); ++c) {
    double* b = &solution.x[c * kLptCoefficients];
    expandInPlace(b, origin);
    float* out = &fit.coefficients[(at * static_cast<std::size_t>(job.input.channels) + c) * kLptCoefficients];
    for (std::size_t j = 0; j < kLptCoefficients; ++j) out[j] = storedCoefficient(b[j]);
  }
}

}  // namespace sward::lpt::detail
