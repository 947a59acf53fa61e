#include "lpt/stored_sets.h"

#include "base/check.h"

namespace sward::lpt::detail {

StoredSets::StoredSets(std::vector<float> sets, std::size_t channels, std::size_t functions, const FitOptions& options,
                       bool quantised, const JobContext& job)
    : m_channels(channels), m_functions(functions) {
  if (!quantised) {
    m_values = std::move(sets);
    return;
  }
  QuantisedSets stored = quantiseSets(sets, channels * functions, options, job);
  m_ranges = std::move(stored.ranges);
  if (options.bits == 8) {
    m_values = std::move(stored.bytes);
    return;
  }
  std::vector<std::uint16_t> words(stored.bytes.size() / 2);
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = static_cast<std::uint16_t>(stored.bytes[i * 2] + 256u * stored.bytes[i * 2 + 1]);
  }
  m_values = std::move(words);
}

std::uint64_t StoredSets::bytes() const {
  return std::visit([](const auto& values) { return values.size() * sizeof(values[0]); }, m_values);
}

void StoredSets::read(std::size_t set, std::size_t channel, std::span<float> out) const {
  SWARD_CHECK_EQ(out.size(), m_functions);
  const std::size_t first = (set * m_channels + channel) * m_functions;
  std::visit(
      [&](const auto& values) {
        SWARD_CHECK_LE(first + m_functions, values.size());
        for (std::size_t j = 0; j < m_functions; ++j) {
          if (m_ranges.empty()) {
            out[j] = static_cast<float>(values[first + j]);
          } else {
            out[j] = m_ranges[channel * m_functions + j].value(static_cast<std::uint32_t>(values[first + j]));
          }
        }
      },
      m_values);
}

StoredSets::Folded StoredSets::fold(std::size_t channel, std::span<const double> weights) const {
  SWARD_CHECK_EQ(weights.size(), m_functions);
  Folded folded;
  double constant = 0.0;
  for (std::size_t j = 0; j < m_functions; ++j) {
    double weight = weights[j];
    if (!m_ranges.empty()) {
      const CoefficientRange& range = m_ranges[channel * m_functions + j];
      constant -= weight * static_cast<double>(range.base);
      weight = range.scale == 0.0f ? 0.0 : weight / static_cast<double>(range.scale);
    }
    folded.weights.push_back(static_cast<float>(weight));
  }
  folded.constant = static_cast<float>(constant);
  return folded;
}

}  // namespace sward::lpt::detail
