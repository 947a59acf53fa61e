#include "report/fit_oracle.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace sward::report {
namespace {

using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

constexpr Real kTolerance = 1e-6L;

/// f of science.md section 1 as a row: ten functions of (l, v), or the six of (l) alone.
std::vector<Real> functions(const glm::dvec3& light, Real v, bool layered) {
  const Real x = light.x, y = light.y;
  if (!layered) return {x * x, y * y, 2 * x * y, 2 * x, 2 * y, 1};
  return {x * x, y * y, v * v, 2 * x * y, 2 * x * v, 2 * y * v, 2 * x, 2 * y, 2 * v, 1};
}

std::vector<Real> ridges(const lpt::FitOptions& options, bool layered) {
  const Real light = options.paper ? 0.0 : options.lightRidge, layer = options.paper ? 0.0 : options.layerRidge;
  if (!layered) return {light, light, light, light, light, 0};
  return {light, light, layer, light, layer, layer, light, light, layer, 0};
}

/// max(delta, 1/(2m)) alpha, or delta alone for a paper's LPT; 0 for what counts as absent.
Real weightOf(const lpt::FitInput& in, const lpt::FitOptions& options, std::size_t texel) {
  const Real delta = in.visibility[texel], floor = Real(0.5) / in.visibilityDirections;
  const bool paper = options.paper && options.basis == lpt::Basis::Lpt;
  const Real w = paper ? delta : (std::isfinite(delta) ? std::max(delta, floor) : floor) * Real(in.coverage[texel]);
  return std::isfinite(w) && w > 0 ? w : 0;
}

struct DataRow {
  std::size_t texel, light;
  Real weight;
};

std::vector<DataRow> dataRows(const lpt::FitInput& in, const lpt::FitOptions& options, std::size_t begin,
                              std::size_t end) {
  std::vector<DataRow> rows;
  for (std::size_t t = begin; t < end; ++t) {
    const Real w = weightOf(in, options, t);
    for (std::size_t k = 0; k < in.lights.size() && w > 0; ++k) {
      bool finite = true;
      for (std::size_t s = k; s < in.samples.size(); s += in.lights.size()) {
        finite = finite && std::isfinite(in.samples[s][t]);
      }
      if (finite) rows.push_back({t, k, w});
    }
  }
  return rows;
}

struct System {
  Matrix left, right;  ///< data rows, then the ridge's; right: one column a channel
};

System assemble(const lpt::FitInput& in, const lpt::FitOptions& options, const std::vector<DataRow>& rows,
                OracleSolution& out) {
  const bool layered = options.basis == lpt::Basis::Lpt;
  Real total = 0, first = 0;
  const auto u = [&](const DataRow& row) { return Real(in.layer[row.texel]) / in.layers; };
  for (const DataRow& row : rows) {
    total += row.weight;
    first += row.weight * u(row);
  }
  out.mean = layered && !options.paper ? first / total : 0;
  const std::vector<Real> ridge = ridges(options, layered);
  out.unknowns = static_cast<int>(ridge.size());
  out.rows = static_cast<int>(rows.size());
  const auto n = static_cast<Eigen::Index>(ridge.size()), m = static_cast<Eigen::Index>(rows.size());
  System system{Matrix::Zero(m + n, n), Matrix::Zero(m + n, in.channels)};
  out.channels.resize(static_cast<std::size_t>(in.channels));
  for (Eigen::Index i = 0; i < m; ++i) {
    const DataRow& row = rows[static_cast<std::size_t>(i)];
    const Real share = row.weight / total, root = std::sqrt(share);
    const std::vector<Real> phi = functions(in.lights[row.light], u(row) - out.mean, layered);
    for (Eigen::Index j = 0; j < n; ++j) system.left(i, j) = root * phi[static_cast<std::size_t>(j)];
    for (Eigen::Index c = 0; c < in.channels; ++c) {
      const auto channel = static_cast<std::size_t>(c);
      const Real y = in.samples[channel * in.lights.size() + row.light][row.texel];
      system.right(i, c) = root * y;
      out.channels[channel].mean += share * y;
    }
  }
  for (Eigen::Index j = 0; j < n; ++j) system.left(m + j, j) = std::sqrt(ridge[static_cast<std::size_t>(j)]);
  return system;
}

int rankOf(const Vector& values, OracleSolution& out) {
  int rank = 0;
  for (const Real value : values) {
    const Real ratio = value / (kTolerance * values(0));
    rank += ratio > 1 ? 1 : 0;
    if (ratio > 0) out.rankMargin = std::min(out.rankMargin, std::max(ratio, 1 / ratio));
  }
  return rank;
}

void solve(const System& system, OracleSolution& out) {
  const auto n = static_cast<Eigen::Index>(out.unknowns);
  const Eigen::HouseholderQR<Matrix> qr(system.left);
  const Matrix triangle = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::JacobiSVD<Matrix> svd(triangle, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector values = svd.singularValues();
  out.rankMargin = 1 / kTolerance;
  out.rank = rankOf(values, out);
  out.dataRank = rankOf(Eigen::JacobiSVD<Matrix>(system.left.topRows(out.rows)).singularValues(), out);
  const Eigen::Index r = out.rank;
  out.largest = values(0);
  out.condition = values(0) / values(r - 1);
  out.gapCondition = values(0) / (values(r - 1) - (r < n ? values(r) : Real(0)));
  const Matrix rotated = (qr.householderQ().transpose() * system.right).topRows(n);
  const Matrix x = out.determined() ? Matrix(triangle.triangularView<Eigen::Upper>().solve(rotated))
                                    : Matrix(svd.matrixV().leftCols(r) * values.head(r).cwiseInverse().asDiagonal() *
                                             (svd.matrixU().leftCols(r).transpose() * rotated));
  for (std::size_t c = 0; c < out.channels.size(); ++c) {
    const auto column = static_cast<Eigen::Index>(c);
    OracleSolution::Channel& channel = out.channels[c];
    channel.x.assign(x.col(column).begin(), x.col(column).end());
    channel.rightHandSide = system.right.col(column).norm();
    channel.residual = (system.left * x.col(column) - system.right.col(column)).norm();
  }
}

}  // namespace

long double OracleSolution::norm(std::size_t channel) const {
  Real sum = 0;
  for (const Real x : channels[channel].x) sum += x * x;
  return std::sqrt(sum);
}

long double OracleSolution::value(std::size_t channel, const glm::dvec3& light, long double u) const {
  const std::vector<Real> phi = functions(light, u - mean, unknowns == 10);
  Real sum = 0;
  for (std::size_t j = 0; j < phi.size(); ++j) sum += channels[channel].x[j] * phi[j];
  return sum;
}

std::vector<long double> OracleSolution::expanded(std::size_t channel) const {
  std::vector<Real> b = channels[channel].x;
  if (unknowns != 10) return b;
  // c2 (u - m)^2 + 2 (c4 lx + c5 ly + c8) (u - m), sorted by powers of u.
  b[9] += b[2] * mean * mean - 2 * b[8] * mean;
  b[8] -= b[2] * mean;
  b[6] -= b[4] * mean;
  b[7] -= b[5] * mean;
  return b;
}

OracleSolution solveOracle(const lpt::FitInput& input, const lpt::FitOptions& options, std::size_t begin,
                           std::size_t end) {
  OracleSolution out;
  const std::vector<DataRow> rows = dataRows(input, options, begin, end);
  if (!rows.empty()) solve(assemble(input, options, rows, out), out);
  return out;
}

}  // namespace sward::report
