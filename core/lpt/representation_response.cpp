#include "lpt/representation_kinds.h"

#include "base/check.h"
#include "base/parallel.h"
#include "lpt/polynomial.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt::detail {
namespace {

/// As LayerStack stores it.
float stored(float value, bool quantised) {
  const float unit = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
  return quantised ? std::floor(unit * 255.0f + 0.5f) / 255.0f : unit;
}

std::vector<TexelFeatures> featuresOf(const FitInput& in, bool quantised) {
  std::vector<TexelFeatures> features(in.layer.size());
  for (std::size_t column = 0; column < static_cast<std::size_t>(in.columns); ++column) {
    ColumnFeatures above;
    for (std::size_t t = in.columnStart[column]; t < in.columnStart[column + 1]; ++t) {
      features[t] = above.next(stored(in.sky[0][t], quantised), stored(in.sky[1][t], quantised),
                               stored(in.coverage[t], quantised));
    }
  }
  return features;
}

/// responseBasis by its powers of g.
struct Powers {
  std::array<double, kLptCoefficients> none, first, second;

  explicit Powers(const glm::dvec3& l)
      : none{0, 0, 0, 0, 0, 0, 2 * l.x, 2 * l.y, 0, 1},
        first{0, 0, 0, 0, 2 * l.x, 2 * l.y, 0, 0, 2, 0},
        second{2 * l.x, 2 * l.y, 1, 0, 0, 0, 0, 0, 0, 0} {}
};

struct ResponseWeights {
  StoredSets::Folded a, b, c;

  ResponseWeights(const StoredSets& sets, std::size_t channel, const Powers& powers)
      : a(sets.fold(channel, powers.none)), b(sets.fold(channel, powers.first)), c(sets.fold(channel, powers.second)) {}

  template <typename Stored>
  std::array<float, 3> at(const Stored* stored) const {
    const auto s = [&](std::size_t j) { return static_cast<float>(stored[j]); };
    return {a.constant + a.weights[6] * s(6) + a.weights[7] * s(7) + a.weights[9] * s(9),
            b.constant + b.weights[4] * s(4) + b.weights[5] * s(5) + b.weights[8] * s(8),
            c.constant + c.weights[0] * s(0) + c.weights[1] * s(1) + c.weights[2] * s(2)};
  }
};

}  // namespace

ResponsePolynomials::ResponsePolynomials(Texels texels, StoredSets sets, CommonResponse common,
                                         std::vector<TexelFeatures> features)
    : m_texels(std::move(texels)),
      m_sets(std::move(sets)),
      m_common(std::move(common)),
      m_features(std::move(features)),
      m_sky(static_cast<std::size_t>(m_texels.layers)) {
  std::vector<std::array<double, 3>> sums(m_sky.size());
  for (std::size_t t = 0; t < m_features.size(); ++t) {
    const auto f = [&](std::size_t i) { return static_cast<double>(m_features[t][i]); };
    std::array<double, 3>& sum = sums[m_texels.layer[t]];
    sum[0] += f(3) * f(1);
    sum[1] += f(3) * f(2);
    sum[2] += f(3);
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i][2] > 0.0)
      m_sky[i] = {static_cast<float>(sums[i][0] / sums[i][2]), static_cast<float>(sums[i][1] / sums[i][2])};
  }
}

Result<void> ResponsePolynomials::relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                                          const JobContext& job) const {
  const std::size_t channels = m_sets.channels();
  checkRelight(m_texels, channels, out);
  const Powers powers(light);
  std::vector<ResponseWeights> weights;
  for (std::size_t c = 0; c < channels; ++c) weights.emplace_back(m_sets, c, powers);
  const CommonAtLight common(m_common, light);
  m_sets.visit([&](const auto* values) {
    base::parallelFor(job, static_cast<std::size_t>(m_texels.columns), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t column = begin; column < end; ++column) {
        const std::size_t first = m_texels.columnStart[column], last = m_texels.columnStart[column + 1];
        for (std::size_t c = 0; c < channels && first < last; ++c) {
          const auto [a, b, square] = weights[c].at(values + (column * channels + c) * kLptCoefficients);
          const auto channel = static_cast<int>(c);
          for (std::size_t t = first; t < last; ++t) {
            const int layer = m_texels.layer[t];
            const float g = common.coordinate(layer, channel, m_features[t]);
            out[c][t] = a + g * (b + g * square) + common.response(layer, channel, m_features[t]);
          }
        }
      }
    });
  });
  if (job.cancelled()) return Error::cancelled();
  return {};
}

TexelFeatures ResponsePolynomials::featuresAt(std::size_t column, std::size_t layer) const {
  TexelFeatures features{1.0f, m_sky[layer][0], m_sky[layer][1], 0.0f, 1.0f};
  for (std::size_t t = m_texels.columnStart[column]; t < m_texels.columnStart[column + 1]; ++t) {
    if (m_texels.layer[t] == layer) return m_features[t];
    if (m_texels.layer[t] > layer) break;
    features[4] = m_features[t][4] * (1.0f - m_features[t][3]);
  }
  return features;
}

double ResponsePolynomials::evaluate(int column, int layer, int channel, const glm::dvec3& light) const {
  SWARD_CHECK(column >= 0 && column < m_texels.columns && layer >= 0 && layer < m_texels.layers);
  const TexelFeatures features = featuresAt(static_cast<std::size_t>(column), static_cast<std::size_t>(layer));
  const CommonAtLight common(m_common, light, layer);
  std::array<float, kLptCoefficients> b;
  m_sets.read(static_cast<std::size_t>(column), static_cast<std::size_t>(channel), b);
  const auto basis = responseBasis(light.x, light.y, static_cast<double>(common.coordinate(layer, channel, features)));
  double sum = static_cast<double>(common.response(layer, channel, features));
  for (std::size_t j = 0; j < basis.size(); ++j) sum += static_cast<double>(b[j]) * basis[j];
  return sum;
}

Represented storeResponse(const RepresentationInput& input, Fit fit, const FitOptions& options, bool quantised,
                          const JobContext& job) {
  StoredSets sets(std::move(fit.coefficients), static_cast<std::size_t>(fit.channels), kLptCoefficients, options,
                  quantised, job);
  if (job.cancelled()) return Error::cancelled();
  return Represented(std::make_unique<ResponsePolynomials>(Texels(input.fit), std::move(sets), std::move(fit.common),
                                                           featuresOf(input.fit, quantised)));
}

}  // namespace sward::lpt::detail
