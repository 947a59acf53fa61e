#include "report/stability.h"

#include "lpt/polynomial.h"
#include "lpt/quantisation.h"
#include "report/stability_bounds.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace sward::report {
namespace {

/// value over bound; 0 for 0 over 0, infinite where either is not a number.
double share(double value, double bound) {
  if (value == 0.0) return 0.0;
  const double quotient = std::abs(value) / bound;
  return std::isnan(quotient) ? std::numeric_limits<double>::infinity() : quotient;
}

void raise(double& largest, double value) {
  if (!(value <= largest)) largest = value;
}

/// The path that lpt::FitPath's contract states, from the rows that a column has and the lights that differ.
lpt::FitPath expectedPath(const HardCase& one, const lpt::FitOptions& options, std::size_t column) {
  std::set<std::pair<double, double>> distinct;
  for (const glm::dvec3& light : one.lights) distinct.insert({light.x, light.y});
  bool any = false, missing = false;
  for (std::size_t t = one.columnStart[column]; t < one.columnStart[column + 1]; ++t) {
    if (options.paper && !(one.visibility[t] > 0.0f)) continue;
    std::size_t rows = 0;
    for (std::size_t k = 0; k < one.lights.size(); ++k) {
      bool finite = true;
      for (std::size_t s = k; s < one.samples.size(); s += one.lights.size())
        finite = finite && std::isfinite(one.samples[s][t]);
      rows += finite ? 1 : 0;
    }
    any = any || rows > 0;
    // A PTM's texel without a sample is merely absent.
    missing = missing || (rows < one.lights.size() && (rows > 0 || options.basis == lpt::Basis::Lpt));
  }
  if (!any) return lpt::FitPath::Empty;
  return options.paper || missing || distinct.size() < 6 ? lpt::FitPath::Orthogonal : lpt::FitPath::Moments;
}

/// Compares one case's fits with the oracle.
class Judge {
 public:
  Judge(const HardCase& one, const lpt::FitOptions& options, const lpt::Fit& fitted, const lpt::Fit& turned)
      : m_case(one),
        m_in(one.input()),
        m_options(options),
        m_layered(options.basis == lpt::Basis::Lpt),
        m_fitted(fitted),
        m_turned(turned) {
    m_lights = one.lights;
    for (const glm::dvec3& light : hemisphereLights(6)) m_lights.push_back(light);
    for (const auto& samples : one.samples) {
      for (const float y : samples) {
        if (std::isfinite(y)) raise(m_out.scale, std::abs(static_cast<double>(y)));
      }
    }
  }

  Stability judged() {
    for (int c = 0; c < m_case.columns; ++c) column(static_cast<std::size_t>(c));
    if (m_points > 0) m_out.rmse = std::sqrt(m_squares / static_cast<double>(m_points));
    return m_out;
  }

 private:
  void column(std::size_t c) {
    const lpt::FitPath path = m_fitted.path[c];
    (path == lpt::FitPath::Moments      ? m_out.moments
     : path == lpt::FitPath::Orthogonal ? m_out.orthogonal
                                        : m_out.empty) += 1;
    if (path != expectedPath(m_case, m_options, c)) ++m_out.wrongPaths;
    m_out.finite = m_out.finite && std::isfinite(m_fitted.condition[c]) && std::isfinite(m_fitted.weight[c]);
    raise(m_out.condition, static_cast<double>(m_fitted.condition[c]));
    for (std::size_t ch = 0; ch < static_cast<std::size_t>(m_case.channels); ++ch) {
      for (const float b : m_fitted.column(static_cast<int>(c), static_cast<int>(ch))) {
        m_out.finite = m_out.finite && std::isfinite(b);
        raise(m_out.largestCoefficient, std::abs(static_cast<double>(b)));
      }
    }
    const std::size_t begin = m_case.columnStart[c], end = m_case.columnStart[c + 1];
    int rank = std::numeric_limits<int>::max();
    double condition = 0.0;
    const auto problem = [&](std::size_t from, std::size_t to) {
      const OracleSolution exact = solveOracle(m_in, m_options, from, to);
      for (std::size_t ch = 0; ch < static_cast<std::size_t>(m_case.channels); ++ch) compareChannel(c, from, ch, exact);
      if (exact.rows == 0) return;
      rank = std::min(rank, exact.dataRank);
      condition = std::max(condition, static_cast<double>(exact.condition));
      m_out.rankMargin = std::min(m_out.rankMargin, static_cast<double>(exact.rankMargin));
    };
    if (m_layered) problem(begin, end);
    for (std::size_t t = begin; t < end && !m_layered; ++t) problem(t, t + 1);
    if (condition == 0.0) return;
    if (rank != m_fitted.rank[c]) ++m_out.wrongRanks;
    const double quotient = static_cast<double>(m_fitted.condition[c]) / condition;
    m_out.conditionLow = std::min(m_out.conditionLow, quotient);
    raise(m_out.conditionHigh, quotient);
  }

  std::span<const float> stored(const lpt::Fit& fit, std::size_t column, std::size_t channel, std::size_t texel) const {
    const auto all = fit.column(static_cast<int>(column), static_cast<int>(channel));
    return !m_layered ? all.subspan(std::size_t{6} * m_case.layer[texel], 6) : all;
  }

  /// Layers at which a column is read: its own, and others.
  std::vector<int> layersOf(std::size_t column, std::size_t texel) const {
    if (!m_layered) return {m_case.layer[texel]};
    std::set<int> layers;
    for (int i = 0; i < m_case.layers; i += std::max(1, m_case.layers / 8)) layers.insert(i);
    for (std::size_t t = m_case.columnStart[column]; t < m_case.columnStart[column + 1]; ++t)
      layers.insert(m_case.layer[t]);
    return {layers.begin(), layers.end()};
  }

  void compareChannel(std::size_t column, std::size_t texel, std::size_t channel, const OracleSolution& exact) {
    const auto b = stored(m_fitted, column, channel, texel), turned = stored(m_turned, column, channel, texel);
    if (exact.rows == 0) {
      // Nothing to fit: zeros.
      for (const float value : b) raise(m_out.errorShare, share(static_cast<double>(value), 0.0));
      return;
    }
    const bool normal = !m_layered || m_fitted.path[column] == lpt::FitPath::Moments;
    const double solver = detail::solverBound(exact, channel, normal);
    const double bound = detail::coefficientBound(exact, channel, m_options);
    const std::vector<long double> expected = exact.expanded(channel);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const auto value = static_cast<double>(b[j]);
      raise(m_out.coefficientShare, share(value, bound));
      // A coefficient of u is a sum of those of v with factors that sum to 4 at most (1 + 2 mean + mean^2).
      if (exact.determined()) {
        raise(m_out.coefficientErrorShare,
              share(static_cast<double>(value - expected[j]), 4.0 * solver + 0x1p-24 * std::abs(value) + 0x1p-150));
      }
    }
    for (const int layer : layersOf(column, texel)) {
      for (const glm::dvec3& light : m_lights) point(b, turned, exact, channel, solver, light, layer);
    }
  }

  void point(std::span<const float> b, std::span<const float> turned, const OracleSolution& exact, std::size_t channel,
             double solver, const glm::dvec3& light, int layer) {
    const double u = static_cast<double>(layer) / m_case.layers;
    const auto all = lpt::lptBasis(light.x, light.y, u),
               about = lpt::lptBasis(light.x, light.y, u - static_cast<double>(exact.mean));
    const auto ptm = lpt::ptmBasis(light.x, light.y);
    const std::span<const double> phi = m_layered ? std::span<const double>(all) : std::span<const double>(ptm);
    const std::span<const double> centred = m_layered ? std::span<const double>(about) : std::span<const double>(ptm);
    const auto value = [&](std::span<const float> of) {
      return m_layered ? lpt::evaluateLpt(of.first<lpt::kLptCoefficients>(), light.x, light.y, u)
                       : lpt::evaluatePtm(of.first<lpt::kPtmCoefficients>(), light.x, light.y);
    };
    const double f = value(b), g = value(turned), scale = m_out.scale > 0.0 ? m_out.scale : 1.0;
    const auto error =
        static_cast<double>(f - exact.value(channel, light, static_cast<long double>(layer) / m_case.layers));
    const double bound = detail::valueBound(solver, b, phi, centred);
    raise(m_out.maxError, std::abs(error) / scale);
    raise(m_out.errorShare, share(error, bound));
    m_squares += error / scale * (error / scale);
    ++m_points;
    raise(m_out.orderDifference, std::abs(f - g) / scale);
    raise(m_out.orderShare, share(f - g, bound + detail::valueBound(solver, turned, phi, centred)));
  }

  const HardCase& m_case;
  lpt::FitInput m_in;
  lpt::FitOptions m_options;
  bool m_layered;
  const lpt::Fit& m_fitted;
  const lpt::Fit& m_turned;
  std::vector<glm::dvec3> m_lights;
  Stability m_out;
  double m_squares = 0.0;
  std::size_t m_points = 0;
};

/// Largest error of reading integers of `bits` back, over half a step and the rounding of reading: of stored / scale,
/// which is no larger than the range, and of what is left when the base is taken off.
double quantisationShare(const lpt::Fit& fit, std::size_t perSet, int bits, const JobContext& job) {
  lpt::FitOptions options;
  options.bits = bits;
  const lpt::QuantisedSets sets = lpt::quantiseSets(fit.coefficients, perSet, options, job);
  const std::size_t bytes = bits == 8 ? 1 : 2;
  const double largest = bits == 8 ? 255.0 : 65535.0;
  double out = 0.0;
  for (std::size_t i = 0; i < fit.coefficients.size(); ++i) {
    const lpt::CoefficientRange& range = sets.ranges[i % perSet];
    const std::uint32_t q = sets.bytes[i * bytes] + (bytes == 2 ? 256u * sets.bytes[i * 2 + 1] : 0u);
    const auto b = static_cast<double>(fit.coefficients[i]), back = static_cast<double>(range.value(q));
    const auto scale = static_cast<double>(range.scale);
    // Where float has no such scale the range counts as one value: narrower than largest / FLT_MAX.
    const double step =
        scale > 0.0 ? 1.0 / scale : 2.0 * largest / static_cast<double>(std::numeric_limits<float>::max());
    raise(out, share(back - b, 0.5 * step + 0x1p-24 * (2.0 * largest * step + std::abs(back)) + 0x1p-149));
  }
  return out;
}

}  // namespace

const char* hardFitName(HardFit fit) {
  return fit == HardFit::Lpt ? "lpt" : fit == HardFit::LptPaper ? "lpt_paper" : "ptm";
}

lpt::FitOptions hardFitOptions(HardFit fit) {
  lpt::FitOptions options;
  options.basis = fit == HardFit::Ptm ? lpt::Basis::Ptm : lpt::Basis::Lpt;
  options.paper = fit == HardFit::LptPaper;
  return options;
}

Result<Stability> measureStability(const HardCase& one, const lpt::FitOptions& options, const JobContext& job) {
  const HardCase turned = reordered(one);
  SWARD_ASSIGN(const lpt::Fit fitted, lpt::fit(one.input(), options, job));
  SWARD_ASSIGN(const lpt::Fit again, lpt::fit(turned.input(), options, job));
  Stability out = Judge(one, options, fitted, again).judged();
  const std::size_t perSet = options.basis == lpt::Basis::Ptm ? 6 : 10;
  for (const int bits : {8, 16}) raise(out.quantisationShare, quantisationShare(fitted, perSet, bits, job));
  return out;
}

}  // namespace sward::report
