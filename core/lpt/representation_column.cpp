#include "lpt/representation_kinds.h"

#include "base/check.h"
#include "base/parallel.h"
#include "lpt/polynomial.h"

#include <algorithm>
#include <array>

namespace sward::lpt::detail {
namespace {

constexpr std::size_t kFunctions = kLptCoefficients;

std::size_t groupOf(std::span<const std::uint16_t> start, std::size_t layer) {
  std::size_t group = 0;
  while (group < start.size() && layer >= start[group]) ++group;
  return group;
}

/// Stored values to f = a + (b + c u) u at one light, for one channel.
struct ColumnWeights {
  StoredSets::Folded a, b, c;

  ColumnWeights(const StoredSets& sets, std::size_t channel, const glm::dvec3& l) {
    // lptBasis' functions apart by their power of u.
    const std::array<double, kFunctions> none{l.x * l.x, l.y * l.y, 0, 2 * l.x * l.y, 0, 0, 2 * l.x, 2 * l.y, 0, 1};
    const std::array<double, kFunctions> first{0, 0, 0, 0, 2 * l.x, 2 * l.y, 0, 0, 2, 0};
    const std::array<double, kFunctions> second{0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
    a = sets.fold(channel, none);
    b = sets.fold(channel, first);
    c = sets.fold(channel, second);
  }

  /// Only the functions that the power has.
  template <typename Stored>
  std::array<float, 3> at(const Stored* stored) const {
    const auto s = [&](std::size_t j) { return static_cast<float>(stored[j]); };
    const auto& w = a.weights;
    const float constant =
        a.constant + w[0] * s(0) + w[1] * s(1) + w[3] * s(3) + w[6] * s(6) + w[7] * s(7) + w[9] * s(9);
    const float slope = b.constant + b.weights[4] * s(4) + b.weights[5] * s(5) + b.weights[8] * s(8);
    return {constant, slope, c.constant + c.weights[2] * s(2)};
  }
};

/// A group without a texel takes the coefficients of its whole column, which are filled where that is empty, too.
void fillGroups(Fit& grouped, const Fit& whole, std::size_t groups) {
  const std::size_t perColumn = static_cast<std::size_t>(whole.channels) * kFunctions;
  for (std::size_t i = 0; i < grouped.weight.size(); ++i) {
    if (grouped.weight[i] > 0.0f) continue;
    std::copy_n(&whole.coefficients[i / groups * perColumn], perColumn, &grouped.coefficients[i * perColumn]);
  }
}

/// Texels of every (column, group): columnStart of a set whose columns are the groups.
std::vector<std::uint32_t> groupTexels(const FitInput& in, std::size_t groups,
                                       std::span<const std::uint16_t> groupStart) {
  const std::size_t inner = groups - 1;
  const bool shared = groupStart.size() == inner;
  std::vector<std::uint32_t> start{0};
  for (std::size_t column = 0; column < static_cast<std::size_t>(in.columns); ++column) {
    const auto first = in.layer.begin() + in.columnStart[column], last = in.layer.begin() + in.columnStart[column + 1];
    for (std::size_t g = 0; g < inner; ++g) {
      const std::uint16_t layer = groupStart[shared ? g : column * inner + g];
      start.push_back(static_cast<std::uint32_t>(std::lower_bound(first, last, layer) - in.layer.begin()));
    }
    start.push_back(in.columnStart[column + 1]);
  }
  return start;
}

Result<Fit> fitWhole(const RepresentationInput& input, FitOptions options, const JobContext& job) {
  options.basis = Basis::Lpt;
  SWARD_ASSIGN(Fit whole, fit(input.fit, options, job));
  fillEmpty(whole, input.hits->shape.width, input.hits->shape.height, true);
  return whole;
}

}  // namespace

std::span<const std::uint16_t> ColumnPolynomials::groupStart(std::size_t column) const {
  const std::size_t inner = m_groups - 1;
  return std::span(m_groupStart).subspan(m_groupStart.size() == inner ? 0 : column * inner, inner);
}

Result<void> ColumnPolynomials::relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                                        const JobContext& job) const {
  const std::size_t channels = m_sets.channels();
  checkRelight(m_texels, channels, out);
  std::vector<ColumnWeights> weights;
  for (std::size_t c = 0; c < channels; ++c) weights.emplace_back(m_sets, c, light);
  const float perLayer = 1.0f / static_cast<float>(m_texels.layers);
  m_sets.visit([&](const auto* values) {
    base::parallelFor(job, static_cast<std::size_t>(m_texels.columns), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t column = begin; column < end; ++column) {
        const std::size_t last = m_texels.columnStart[column + 1];
        const std::span<const std::uint16_t> start = groupStart(column);
        std::size_t t = m_texels.columnStart[column];
        for (std::size_t group = 0; group < m_groups && t < last; ++group) {
          std::size_t stop = t;
          while (stop < last && (group == start.size() || m_texels.layer[stop] < start[group])) ++stop;
          if (stop == t) continue;
          for (std::size_t c = 0; c < channels; ++c) {
            const auto* stored = values + ((column * m_groups + group) * channels + c) * kFunctions;
            const auto [a, b, square] = weights[c].at(stored);
            for (std::size_t i = t; i < stop; ++i) {
              const float u = static_cast<float>(m_texels.layer[i]) * perLayer;
              out[c][i] = a + u * (b + u * square);
            }
          }
          t = stop;
        }
      }
    });
  });
  if (job.cancelled()) return Error::cancelled();
  return {};
}

double ColumnPolynomials::evaluate(int column, int layer, int channel, const glm::dvec3& light) const {
  SWARD_CHECK(column >= 0 && column < m_texels.columns && layer >= 0 && layer < m_texels.layers);
  const auto at = static_cast<std::size_t>(column);
  std::array<float, kFunctions> b;
  m_sets.read(at * m_groups + groupOf(groupStart(at), static_cast<std::size_t>(layer)),
              static_cast<std::size_t>(channel), b);
  return evaluateLpt(b, light.x, light.y, static_cast<double>(layer) / m_texels.layers);
}

Represented representLpt(const RepresentationInput& input, const FitOptions& options, bool quantised,
                         const JobContext& job) {
  SWARD_ASSIGN(Fit whole, fitWhole(input, options, job));
  if (!whole.common.empty()) return storeResponse(input, std::move(whole), options, quantised, job);
  StoredSets sets(std::move(whole.coefficients), static_cast<std::size_t>(whole.channels), kFunctions, options,
                  quantised, job);
  if (job.cancelled()) return Error::cancelled();
  return Represented(
      std::make_unique<ColumnPolynomials>(Texels(input.fit), std::move(sets), 1, std::vector<std::uint16_t>{}, 0));
}

Represented representClustered(const RepresentationInput& input, const FitOptions& options, LayerGroups groups,
                               bool quantised, const JobContext& job) {
  SWARD_CHECK(options.clusters >= 1);
  FitOptions lpt = options;
  lpt.basis = Basis::Lpt;
  lpt.coordinate = LayerCoordinate::Depth;
  SWARD_ASSIGN(const Fit whole, fitWhole(input, lpt, job));
  const auto count = static_cast<std::size_t>(options.clusters);
  std::vector<std::uint16_t> start = groups == LayerGroups::Equal
                                         ? equalGroups(input.fit.layers, options.clusters)
                                         : bestGroups(input.fit, options, options.clusters, job);
  if (job.cancelled()) return Error::cancelled();
  const std::vector<std::uint32_t> texels = groupTexels(input.fit, count, start);
  FitInput grouped = input.fit;
  grouped.columns *= options.clusters;
  grouped.columnStart = texels;
  SWARD_ASSIGN(Fit fitted, fit(grouped, lpt, job));
  fillGroups(fitted, whole, count);
  StoredSets sets(std::move(fitted.coefficients), static_cast<std::size_t>(fitted.channels), kFunctions, options,
                  quantised, job);
  if (job.cancelled()) return Error::cancelled();
  const std::uint64_t indexBytes =
      groups == LayerGroups::Equal ? 0 : static_cast<std::uint64_t>(whole.columns) * (count - 1);
  return Represented(std::make_unique<ColumnPolynomials>(Texels(input.fit), std::move(sets), options.clusters,
                                                         std::move(start), indexBytes));
}

}  // namespace sward::lpt::detail
