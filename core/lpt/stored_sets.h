#pragma once

#include "lpt/quantisation.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace sward::lpt::detail {

/// Coefficient sets as a representation keeps them, [set][channel][function]: floats, or integers of 8 or 16 bits with
/// a range for each channel and function.
class StoredSets {
 public:
  StoredSets(std::vector<float> sets, std::size_t channels, std::size_t functions, const FitOptions& options,
             bool quantised, const JobContext& job);

  std::size_t channels() const { return m_channels; }
  std::size_t functions() const { return m_functions; }
  std::uint64_t bytes() const;

  /// One set of one channel, as floats again; `functions` values.
  void read(std::size_t set, std::size_t channel, std::span<float> out) const;

  /// Sums over the functions straight from what is stored: sum_j weight_j b_j = sum_j (weight_j / scale_j) b'_j -
  /// sum_j weight_j base_j. In float: its rounding, 6e-8 of the sum's terms, is far below a step of 16 bits.
  struct Folded {
    std::vector<float> weights;  ///< one a function
    float constant = 0.0f;
  };
  Folded fold(std::size_t channel, std::span<const double> weights) const;

  /// Calls body with the first stored value, a pointer to float, 8 or 16 bits.
  template <typename Body>
  void visit(Body&& body) const {
    std::visit([&](const auto& values) { body(values.data()); }, m_values);
  }

 private:
  std::size_t m_channels, m_functions;
  std::vector<CoefficientRange> m_ranges;  ///< [channel][function]; of floats: empty
  std::variant<std::vector<float>, std::vector<std::uint8_t>, std::vector<std::uint16_t>> m_values;
};

}  // namespace sward::lpt::detail
