#include "lpt/representation_kinds.h"

#include "base/check.h"
#include "base/parallel.h"
#include "lpt/hemispherical_harmonics.h"
#include "lpt/polynomial.h"
#include "lpt/texel_fit.h"

namespace sward::lpt::detail {
namespace {

std::vector<double> one(const glm::dvec3&) {
  return {1.0};
}
std::vector<double> ptmFunctions(const glm::dvec3& light) {
  const auto g = ptmBasis(light.x, light.y);
  return {g.begin(), g.end()};
}
template <int Bands>
std::vector<double> harmonics(const glm::dvec3& light) {
  return hemisphericalHarmonics(light, Bands);
}

/// The fit's coefficients in the order of StoredSets: from [column][channel][layer] to [column][layer][channel].
std::vector<float> byTexel(const Fit& fit, std::size_t functions) {
  const auto channels = static_cast<std::size_t>(fit.channels), layers = static_cast<std::size_t>(fit.layers);
  std::vector<float> sets(fit.coefficients.size());
  for (std::size_t column = 0; column < static_cast<std::size_t>(fit.columns); ++column) {
    for (std::size_t channel = 0; channel < channels; ++channel) {
      for (std::size_t layer = 0; layer < layers; ++layer) {
        const float* from = &fit.coefficients[((column * channels + channel) * layers + layer) * functions];
        std::copy_n(from, functions, &sets[((column * layers + layer) * channels + channel) * functions]);
      }
    }
  }
  return sets;
}

Represented store(const RepresentationInput& input, Fit fit, const FitOptions& options, LightFunctions functions,
                  bool quantised, const JobContext& job) {
  fillEmpty(fit, input.hits->shape.width, input.hits->shape.height, true);
  const auto count = static_cast<std::size_t>(fit.perColumn / fit.layers);
  StoredSets sets(byTexel(fit, count), static_cast<std::size_t>(fit.channels), count, options, quantised, job);
  if (job.cancelled()) return Error::cancelled();
  return Represented(std::make_unique<TexelFunctions>(Texels(input.fit), std::move(sets), functions));
}

}  // namespace

Result<void> TexelFunctions::relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                                     const JobContext& job) const {
  const std::size_t channels = m_sets.channels(), functions = m_sets.functions();
  checkRelight(m_texels, channels, out);
  const std::vector<double> g = m_functions(light);
  std::vector<StoredSets::Folded> folded;
  for (std::size_t c = 0; c < channels; ++c) folded.push_back(m_sets.fold(c, g));
  m_sets.visit([&](const auto* values) {
    base::parallelFor(job, static_cast<std::size_t>(m_texels.columns), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t column = begin; column < end; ++column) {
        for (std::size_t t = m_texels.columnStart[column]; t < m_texels.columnStart[column + 1]; ++t) {
          const std::size_t set = column * static_cast<std::size_t>(m_texels.layers) + m_texels.layer[t];
          const auto* b = values + set * channels * functions;
          for (std::size_t c = 0; c < channels; ++c, b += functions) {
            float sum = folded[c].constant;
            for (std::size_t j = 0; j < functions; ++j) sum += folded[c].weights[j] * static_cast<float>(b[j]);
            out[c][t] = sum;
          }
        }
      }
    });
  });
  if (job.cancelled()) return Error::cancelled();
  return {};
}

double TexelFunctions::evaluate(int column, int layer, int channel, const glm::dvec3& light) const {
  SWARD_CHECK(column >= 0 && column < m_texels.columns && layer >= 0 && layer < m_texels.layers);
  const std::vector<double> g = m_functions(light);
  std::vector<float> b(m_sets.functions());
  const std::size_t set =
      static_cast<std::size_t>(column) * static_cast<std::size_t>(m_texels.layers) + static_cast<std::size_t>(layer);
  m_sets.read(set, static_cast<std::size_t>(channel), b);
  double sum = 0.0;
  for (std::size_t j = 0; j < b.size(); ++j) sum += static_cast<double>(b[j]) * g[j];
  return sum;
}

Represented representPtm(const RepresentationInput& input, const FitOptions& options, bool quantised,
                         const JobContext& job) {
  SWARD_ASSIGN(Fit fitted, fit(input.fit, options, job));
  return store(input, std::move(fitted), options, &ptmFunctions, quantised, job);
}

Represented representConstant(const RepresentationInput& input, const FitOptions& options, bool quantised,
                              const JobContext& job) {
  SWARD_ASSIGN(Fit fitted, fitTexels(input.fit, options, &one, 0, job));
  return store(input, std::move(fitted), options, &one, quantised, job);
}

Represented representHsh(const RepresentationInput& input, const FitOptions& options, int bands, bool quantised,
                         const JobContext& job) {
  SWARD_CHECK(bands >= 1 && bands <= 3);
  const LightFunctions functions = bands == 1 ? &harmonics<1> : bands == 2 ? &harmonics<2> : &harmonics<3>;
  SWARD_ASSIGN(Fit fitted, fitTexels(input.fit, options, functions, 0, job));
  return store(input, std::move(fitted), options, functions, quantised, job);
}

}  // namespace sward::lpt::detail
