#include "lpt/texel_fit.h"

#include "base/parallel.h"
#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt::detail {
namespace {

class TexelFitter {
 public:
  TexelFitter(const FitInput& input, const FitOptions& options, LightFunctions functions, std::size_t constant,
              Fit& fit)
      : m_input(input), m_job{input, options, m_noSystem, fit}, m_fit(fit) {
    for (const glm::dvec3& light : input.lights) m_functions.push_back(functions(light));
    m_count = m_functions.front().size();
    m_ridge.assign(m_count, options.paper ? 0.0 : options.lightRidge);
    m_ridge[constant] = 0.0;
    invert();
  }

  void column(std::size_t c) {
    double weight = 0.0;
    for (std::size_t t = m_input.columnStart[c]; t < m_input.columnStart[c + 1]; ++t) {
      const double w = m_job.weight(t);
      if (!(w > 0.0) || !texel(c, t)) continue;
      weight += w;
      m_fit.layerWeight[c * layers() + m_input.layer[t]] = storedWeight(w);
    }
    if (weight > 0.0) m_fit.weight[c] = storedWeight(weight);
  }

 private:
  std::size_t lights() const { return m_input.lights.size(); }
  std::size_t layers() const { return static_cast<std::size_t>(m_input.layers); }
  std::size_t channels() const { return static_cast<std::size_t>(m_input.channels); }

  bool complete(std::size_t light, std::size_t texel) const {
    for (std::size_t c = 0; c < channels(); ++c) {
      if (!std::isfinite(m_job.sample(c, light)[texel])) return false;
    }
    return true;
  }

  /// Solves for a unit sample of each light: the pseudo-inverse that all complete texels share.
  void invert() {
    const double root = 1.0 / std::sqrt(static_cast<double>(lights()));
    std::vector<double> rows, samples(lights() * lights(), 0.0);
    for (std::size_t k = 0; k < lights(); ++k) {
      for (const double g : m_functions[k]) rows.push_back(root * g);
      samples[k * lights() + k] = root;
    }
    m_inverse = solveRows({rows, samples, m_ridge, static_cast<int>(lights())}).x;
  }

  float* set(std::size_t column, std::size_t channel, std::size_t texel) {
    return &m_fit.coefficients[((column * channels() + channel) * layers() + m_input.layer[texel]) * m_count];
  }

  /// False when the texel has no sample at all.
  bool texel(std::size_t column, std::size_t t) {
    std::size_t rows = 0;
    for (std::size_t k = 0; k < lights(); ++k) rows += complete(k, t) ? 1 : 0;
    if (rows == 0) return false;
    if (rows < lights()) {
      solveTexel(column, t, rows);
      return true;
    }
    for (std::size_t c = 0; c < channels(); ++c) {
      float* out = set(column, c, t);
      std::vector<double> sums(m_count, 0.0);
      for (std::size_t k = 0; k < lights(); ++k) {
        const auto y = static_cast<double>(m_job.sample(c, k)[t]);
        for (std::size_t j = 0; j < m_count; ++j) sums[j] += m_inverse[k * m_count + j] * y;
      }
      for (std::size_t j = 0; j < m_count; ++j) out[j] = storedCoefficient(sums[j]);
    }
    return true;
  }

  /// From the rows that have a sample in every channel.
  void solveTexel(std::size_t column, std::size_t t, std::size_t count) {
    const double root = 1.0 / std::sqrt(static_cast<double>(count));
    std::vector<double> rows, samples;
    for (std::size_t k = 0; k < lights(); ++k) {
      if (!complete(k, t)) continue;
      for (const double g : m_functions[k]) rows.push_back(root * g);
      for (std::size_t c = 0; c < channels(); ++c) {
        samples.push_back(root * static_cast<double>(m_job.sample(c, k)[t]));
      }
    }
    const RowSolution solution = solveRows({rows, samples, m_ridge, m_input.channels});
    for (std::size_t c = 0; c < channels(); ++c) {
      float* out = set(column, c, t);
      for (std::size_t j = 0; j < m_count; ++j) out[j] = storedCoefficient(solution.x[c * m_count + j]);
    }
  }

  const FitInput& m_input;
  const LightSystem m_noSystem{};  ///< FitJob asks for one; weights and samples do not read it
  FitJob m_job;
  Fit& m_fit;
  std::vector<std::vector<double>> m_functions;  ///< [light][function]
  std::size_t m_count = 0;
  std::vector<double> m_ridge;
  std::vector<double> m_inverse;  ///< [light][function]
};

Fit emptyTexelFit(const FitInput& in, const FitOptions& options, std::size_t functions) {
  Fit fit;
  fit.basis = options.basis;
  fit.columns = in.columns;
  fit.layers = in.layers;
  fit.channels = in.channels;
  fit.perColumn = static_cast<int>(functions) * in.layers;
  const auto columns = static_cast<std::size_t>(in.columns);
  fit.coefficients.assign(columns * static_cast<std::size_t>(in.channels) * static_cast<std::size_t>(fit.perColumn),
                          0.0f);
  fit.weight.assign(columns, 0.0f);
  fit.layerWeight.assign(columns * static_cast<std::size_t>(in.layers), 0.0f);
  return fit;
}

}  // namespace

Result<Fit> fitTexels(const FitInput& input, const FitOptions& options, LightFunctions functions, std::size_t constant,
                      const JobContext& job) {
  SWARD_TRY(checkFit(input, options));
  Fit result = emptyTexelFit(input, options, functions(input.lights.front()).size());
  TexelFitter fitter(input, options, functions, constant, result);
  base::ProgressCounter progress(job, "Fitting light", static_cast<std::uint64_t>(input.columns));
  base::parallelFor(job, static_cast<std::size_t>(input.columns), 128, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) fitter.column(c);
    progress.add(end - begin);
  });
  if (job.cancelled()) return Error::cancelled();
  return result;
}

}  // namespace sward::lpt::detail
