#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt::detail {
namespace {

std::array<double, kPtmCoefficients> ptmRidge(const FitOptions& options) {
  if (options.paper) return {};
  const double r = options.lightRidge;
  return {r, r, r, r, r, 0.0};
}

/// One texel from the rows whose samples are there in every channel; rank 0 when there is none.
RowSolution fitTexelByRows(const FitJob& job, std::size_t texel, RowScratch& scratch) {
  const auto channels = static_cast<std::size_t>(job.input.channels);
  scratch.rows.clear();
  scratch.samples.clear();
  for (std::size_t k = 0; k < job.lights(); ++k) {
    bool complete = true;
    for (std::size_t c = 0; c < channels; ++c) complete = complete && std::isfinite(job.sample(c, k)[texel]);
    if (!complete) continue;
    scratch.rows.insert(scratch.rows.end(), job.system.functions[k].begin(), job.system.functions[k].end());
    for (std::size_t c = 0; c < channels; ++c) {
      scratch.samples.push_back(static_cast<double>(job.sample(c, k)[texel]));
    }
  }
  if (scratch.samples.empty()) return {};
  const double root = std::sqrt(static_cast<double>(channels) / static_cast<double>(scratch.samples.size()));
  for (double& value : scratch.rows) value *= root;
  for (double& value : scratch.samples) value *= root;
  return solveRows({scratch.rows, scratch.samples, ptmRidge(job.options), job.input.channels});
}

class PtmBlock {
 public:
  PtmBlock(const FitJob& job, const PtmSystem& ptm, int begin, int end) : m_job(job), m_ptm(ptm) {
    m_channels = static_cast<std::size_t>(job.input.channels);
    m_layers = static_cast<std::size_t>(job.input.layers);
    m_first = job.input.columnStart[static_cast<std::size_t>(begin)];
    m_texels = job.input.columnStart[static_cast<std::size_t>(end)] - m_first;
    m_values.resize(m_channels * 6 * m_texels);
    for (std::size_t c = 0; c < m_channels; ++c) {
      lightMoments(job, c, ptm.inverse, m_first, m_first + m_texels,
                   std::span(m_values).subspan(c * 6 * m_texels, 6 * m_texels));
    }
  }

  void column(int c) {
    const auto at = static_cast<std::size_t>(c);
    double weight = 0.0;
    for (std::size_t t = m_job.input.columnStart[at]; t < m_job.input.columnStart[at + 1]; ++t) {
      const double w = m_job.weight(t);
      if (w > 0.0 && texel(at, t)) {
        weight += w;
        m_job.fit.layerWeight[at * m_layers + m_job.input.layer[t]] = storedWeight(w);
      }
    }
    if (weight > 0.0) m_job.fit.weight[at] = storedWeight(weight);
  }

 private:
  /// False when the texel has no sample at all.
  bool texel(std::size_t column, std::size_t t) {
    const std::size_t local = t - m_first;
    bool complete = true;
    for (std::size_t c = 0; c < m_channels && complete; ++c) {
      for (std::size_t k = 0; k < m_job.lights() && complete; ++k) complete = std::isfinite(m_job.sample(c, k)[t]);
    }
    if (complete) {
      for (std::size_t c = 0; c < m_channels; ++c) {
        for (std::size_t j = 0; j < 6; ++j) {
          store(column, c, m_job.input.layer[t], j, m_values[(c * 6 + j) * m_texels + local]);
        }
      }
      note(column, m_ptm.rank, m_ptm.condition, m_ptm.path);
      return true;
    }
    const RowSolution solution = fitTexelByRows(m_job, t, m_scratch);
    if (solution.rank == 0) return false;
    for (std::size_t c = 0; c < m_channels; ++c) {
      for (std::size_t j = 0; j < 6; ++j) store(column, c, m_job.input.layer[t], j, solution.x[c * 6 + j]);
    }
    note(column, solution.rank, solution.condition, FitPath::Orthogonal);
    return true;
  }

  void store(std::size_t column, std::size_t channel, std::size_t layer, std::size_t j, double value) {
    m_job.fit.coefficients[((column * m_channels + channel) * m_layers + layer) * 6 + j] = storedCoefficient(value);
  }

  void note(std::size_t column, int rank, double condition, FitPath path) {
    Fit& fit = m_job.fit;
    const auto value = static_cast<std::uint8_t>(rank);
    fit.rank[column] = fit.path[column] == FitPath::Empty ? value : std::min(fit.rank[column], value);
    fit.condition[column] = std::max(fit.condition[column], static_cast<float>(condition));
    fit.path[column] = std::max(fit.path[column], path);
  }

  const FitJob& m_job;
  const PtmSystem& m_ptm;
  std::size_t m_channels = 1, m_layers = 1, m_first = 0, m_texels = 0;
  std::vector<double> m_values;  ///< [channel][6][texel of the block]
  RowScratch m_scratch;
};

}  // namespace

PtmSystem makePtmSystem(const LightSystem& system, const FitOptions& options) {
  const std::size_t count = system.functions.size();
  const double root = 1.0 / std::sqrt(static_cast<double>(count));
  std::vector<double> rows, samples(count * count, 0.0);
  for (std::size_t k = 0; k < count; ++k) {
    for (const double g : system.functions[k]) rows.push_back(root * g);
    samples[k * count + k] = root;  // a unit sample of light k, one channel each
  }
  const RowSolution solution = solveRows({rows, samples, ptmRidge(options), static_cast<int>(count)});
  PtmSystem ptm;
  ptm.inverse.assign(count, {});
  for (std::size_t k = 0; k < count; ++k) std::copy_n(&solution.x[k * 6], 6, ptm.inverse[k].begin());
  ptm.rank = solution.rank;
  ptm.condition = solution.condition;
  ptm.path = options.paper || !system.wellConditioned ? FitPath::Orthogonal : FitPath::Moments;
  return ptm;
}

void fitPtmBlock(const FitJob& job, const PtmSystem& ptm, int begin, int end) {
  PtmBlock block(job, ptm, begin, end);
  for (int c = begin; c < end; ++c) block.column(c);
}

}  // namespace sward::lpt::detail
