#include "lpt/fit.h"

#include "base/check.h"
#include "image/pull_push.h"

#include <cstddef>
#include <vector>

namespace sward::lpt {
namespace {

/// Fills the coefficients of one layer image; they lie in the fit's own order, channels apart.
void fillLayer(Fit& fit, std::size_t layer, int width, int height, bool periodic) {
  const auto channels = static_cast<std::size_t>(fit.channels);
  const auto layers = static_cast<std::size_t>(fit.layers);
  const auto columns = static_cast<std::size_t>(fit.columns);
  const int perTexel = fit.perColumn / fit.layers;
  const auto n = static_cast<std::size_t>(perTexel);
  std::vector<float> values(columns * channels * n), weight(columns);
  const auto forEach = [&](const auto& body) {
    for (std::size_t i = 0; i < columns; ++i) {
      for (std::size_t c = 0; c < channels; ++c) {
        for (std::size_t j = 0; j < n; ++j) {
          body(values[(i * channels + c) * n + j], fit.coefficients[((i * channels + c) * layers + layer) * n + j]);
        }
      }
    }
  };
  for (std::size_t i = 0; i < columns; ++i) weight[i] = fit.layerWeight[i * layers + layer];
  forEach([](float& mine, float& theirs) { mine = theirs; });
  image::pullPush(values, weight, width, height, fit.channels * perTexel, periodic);
  forEach([](float& mine, float& theirs) { theirs = mine; });
}

}  // namespace

void fillEmpty(Fit& fit, int width, int height, bool periodic) {
  SWARD_CHECK_EQ(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 static_cast<std::size_t>(fit.columns));
  if (fit.columns == 0) return;
  if (fit.basis == Basis::Lpt) {
    image::pullPush(fit.coefficients, fit.weight, width, height, fit.channels * fit.perColumn, periodic);
    return;
  }
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(fit.layers); ++layer) {
    fillLayer(fit, layer, width, height, periodic);
  }
}

}  // namespace sward::lpt
