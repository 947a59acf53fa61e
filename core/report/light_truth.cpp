#include "report/light_truth.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace sward::report {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr std::uint64_t kHalfSeeds[] = {0x7472757468'41, 0x7472757468'42};  // "truth"

std::vector<float> coverageOf(const trace::LayerHits& hits) {
  std::vector<float> coverage(hits.texels());
  for (std::size_t t = 0; t < coverage.size(); ++t) coverage[t] = hits.coverage(t);
  return coverage;
}

/// Where each of `texels` is in other hits of the same shape, or kNone.
std::vector<std::size_t> placesIn(const trace::LayerHits& other, const trace::LayerHits& texels) {
  std::vector<std::size_t> places(texels.texels(), kNone);
  for (std::size_t column = 0; column + 1 < texels.columnStart.size(); ++column) {
    std::size_t j = other.columnStart[column];
    const std::size_t end = other.columnStart[column + 1];
    for (std::size_t i = texels.columnStart[column]; i < texels.columnStart[column + 1]; ++i) {
      while (j < end && other.layer[j] < texels.layer[i]) ++j;
      if (j < end && other.layer[j] == texels.layer[i]) places[i] = j;
    }
  }
  return places;
}

/// The hits of the columns that have a truth.
trace::LayerHits withTruth(const trace::LayerHits& hits) {
  trace::LayerHits kept;
  kept.set = hits.set;
  kept.shape = hits.shape;
  kept.subSamples = hits.subSamples;
  kept.columnStart.assign(1, 0);
  kept.hitStart.assign(1, 0);
  for (int column = 0; column < hits.shape.columns(); ++column) {
    const auto c = static_cast<std::size_t>(column);
    for (std::uint32_t t = hits.columnStart[c]; t < hits.columnStart[c + 1] && hasTruth(column, hits.shape); ++t) {
      kept.layer.push_back(hits.layer[t]);
      for (std::uint32_t h = hits.hitStart[t]; h < hits.hitStart[t + 1]; ++h) kept.hits.push_back(hits.hits[h]);
      kept.hitStart.push_back(static_cast<std::uint32_t>(kept.hits.size()));
    }
    kept.columnStart.push_back(static_cast<std::uint32_t>(kept.layer.size()));
  }
  return kept;
}

struct Half {
  SampledLight sampled;
  std::vector<std::size_t> places;
  double hits(std::size_t texel) const {
    const std::size_t at = places[texel];
    return at == kNone ? 0.0 : static_cast<double>(sampled.hits.hitStart[at + 1] - sampled.hits.hitStart[at]);
  }
};

/// Means over the hits of both halves, and the weighted variance that they show.
class Union {
 public:
  Union(const Half& a, const Half& b, std::size_t texels) : m_a(a), m_b(b), m_texels(texels) {}

  std::vector<float> merged(std::vector<float> trace::LayerLuminance::*channel, std::size_t light) {
    const std::vector<float>& a = m_a.sampled.response[light].*channel;
    const std::vector<float>& b = m_b.sampled.response[light].*channel;
    std::vector<float> out(m_texels, 0.0f);
    for (std::size_t t = 0; t < m_texels; ++t) {
      const double n = m_a.hits(t), m = m_b.hits(t);
      if (n + m == 0.0) continue;
      const double first = n > 0.0 ? double{a[m_a.places[t]]} : 0.0, second = m > 0.0 ? double{b[m_b.places[t]]} : 0.0;
      out[t] = static_cast<float>((n * first + m * second) / (n + m));
      if (n == 0.0 || m == 0.0) continue;
      const double weight = n + m, difference = first - second;
      m_weights += weight;
      m_squares += weight * difference * difference * n * m / (weight * weight);
    }
    return out;
  }
  double variance() const { return m_weights > 0.0 ? m_squares / m_weights : 0.0; }

 private:
  const Half &m_a, &m_b;
  std::size_t m_texels;
  double m_weights = 0.0, m_squares = 0.0;
};

}  // namespace

bool hasTruth(int column, const trace::LayerShape& shape) {
  return (column % shape.width / kTruthBlock + column / shape.width / kTruthBlock) % 2 == 0;
}

Result<SampledLight> sampleLayers(const trace::PatchScene& scene, const trace::SamplingOptions& options,
                                  Columns columns, std::span<const glm::dvec3> lights, const JobContext& job) {
  SampledLight out;
  SWARD_ASSIGN(out.hits, trace::sampleHits(scene, trace::LayerSet::Slices, options, job));
  if (columns == Columns::WithTruth) out.hits = withTruth(out.hits);
  out.coverage = coverageOf(out.hits);
  for (const glm::dvec3& light : lights) {
    SWARD_ASSIGN(trace::LayerLuminance one, trace::sampleLuminance(scene, out.hits, light, job));
    out.response.push_back(std::move(one));
  }
  return out;
}

Result<HeldOutTruth> sampleTruth(const trace::PatchScene& scene, trace::SamplingOptions options,
                                 const trace::LayerHits& texels, std::span<const glm::dvec3> lights,
                                 const JobContext& job) {
  static_assert(kTruthFactor % 2 == 0);
  options.sliceSubSamples *= kTruthFactor / 2;
  const std::uint64_t seed = options.seed;
  Half halves[2];
  for (std::size_t i = 0; i < 2; ++i) {
    options.seed = seed ^ kHalfSeeds[i];
    SWARD_ASSIGN(halves[i].sampled, sampleLayers(scene, options, Columns::WithTruth, lights, job));
    halves[i].places = placesIn(halves[i].sampled.hits, texels);
  }
  HeldOutTruth truth;
  Union both(halves[0], halves[1], texels.texels());
  for (std::size_t k = 0; k < lights.size(); ++k) {
    truth.response.push_back(
        {both.merged(&trace::LayerLuminance::reflected, k), both.merged(&trace::LayerLuminance::transmitted, k)});
  }
  truth.coverage.assign(texels.texels(), 0.0f);
  for (std::size_t t = 0; t < truth.coverage.size(); ++t) {
    truth.coverage[t] = static_cast<float>((halves[0].hits(t) + halves[1].hits(t)) / (2.0 * options.sliceSubSamples));
  }
  truth.noiseVariance = both.variance();
  return truth;
}

}  // namespace sward::report
