#include "render/light_terms.h"

#include "lpt/polynomial.h"

namespace sward::render {

LightTerms lightTerms(lpt::Basis basis, lpt::LayerCoordinate coordinate, int channels,
                      std::span<const lpt::CoefficientRange> ranges, const glm::dvec3& light) {
  const double x = light.x, y = light.y;
  const bool depth = coordinate == lpt::LayerCoordinate::Depth;
  const std::array<double, 10> lptFunctions = depth ? lpt::lptBasis(x, y, 1.0) : lpt::responseBasis(x, y, 1.0);
  // Which of A, B, C a coefficient goes to: b2 is C, b4, b5, b8 make B; of a response b0 and b1 are C too.
  const std::array<int, 10> lptTerm =
      depth ? std::array{0, 0, 2, 0, 1, 1, 0, 0, 1, 0} : std::array{2, 2, 2, 0, 1, 1, 0, 0, 1, 0};
  const std::array<double, 6> ptmFunctions{x * x, y * y, 2.0 * x * y, 2.0 * x, 2.0 * y, 1.0};
  const int count = lpt::stackCoefficients(basis);
  LightTerms terms;
  std::array<double, 6> constants{};
  for (int c = 0; c < channels; ++c) {
    for (int j = 0; j < count; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const lpt::CoefficientRange& range = ranges[static_cast<std::size_t>(c * count + j)];
      const double function = basis == lpt::Basis::Lpt   ? lptFunctions[at]
                              : basis == lpt::Basis::Ptm ? ptmFunctions[at]
                                                         : 1.0;
      const int term = basis == lpt::Basis::Lpt ? lptTerm[at] : 0;
      if (range.scale > 0.0f)
        terms.weights[static_cast<std::size_t>(c * 10 + j)] =
            static_cast<float>(function / static_cast<double>(range.scale));
      constants[static_cast<std::size_t>(c * 3 + term)] -= function * static_cast<double>(range.base);
    }
  }
  for (std::size_t i = 0; i < constants.size(); ++i) terms.constants[i] = static_cast<float>(constants[i]);
  return terms;
}

LightTerms coefficientTerms(lpt::Basis basis, std::span<const lpt::CoefficientRange> ranges, int channel,
                            int coefficient, double range) {
  const int count = lpt::stackCoefficients(basis);
  const lpt::CoefficientRange& stored = ranges[static_cast<std::size_t>(channel * count + coefficient)];
  LightTerms terms;
  const double half = 0.5 / range;
  if (stored.scale > 0.0f)
    terms.weights[static_cast<std::size_t>(channel * 10 + coefficient)] =
        static_cast<float>(half / static_cast<double>(stored.scale));
  terms.constants[static_cast<std::size_t>(channel * 3)] =
      static_cast<float>(0.5 - half * static_cast<double>(stored.base));
  return terms;
}

}  // namespace sward::render
