#include "bake/stacks.h"

#include "base/check.h"
#include "base/parallel.h"

#include <algorithm>
#include <span>

namespace sward::bake {
namespace {

/// Coverage of a whole column, 1 - product of (1 - alpha).
float columnCoverage(const trace::LayerHits& hits, std::uint32_t column) {
  float through = 1.0f;
  for (std::uint32_t t = hits.columnStart[column]; t < hits.columnStart[column + 1]; ++t) {
    through *= 1.0f - hits.coverage(t);
  }
  return 1.0f - through;
}

/// Writes columns of the patch, or means of several, into the dense arrays of a stack.
class StackBuilder {
 public:
  StackBuilder(const SetLayers& layers, int width, int height, int images) : m_layers(layers) {
    const lpt::Fit& fit = layers.fit;
    m_out.basis = fit.basis;
    m_out.width = width;
    m_out.height = height;
    m_out.images = images;
    m_out.layers = fit.layers;
    m_out.channels = fit.channels;
    m_out.common = fit.common;
    m_perSet = fit.basis == lpt::Basis::Lpt ? fit.perColumn : fit.perColumn / fit.layers;
    const std::size_t columns =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(images);
    const std::size_t texels = columns * static_cast<std::size_t>(fit.layers);
    const std::size_t sets = fit.basis == lpt::Basis::Lpt ? columns : texels;
    m_out.coefficients.assign(sets * static_cast<std::size_t>(fit.channels * m_perSet), 0.0f);
    m_out.coverage.assign(texels, 0.0f);
    m_out.reflectance.assign(texels, glm::vec3(0.0f));
    if (fit.channels > lpt::kTransmitted) m_out.transmittance.assign(texels, glm::vec3(0.0f));
    m_out.sky.assign(texels, glm::vec2(0.0f));
  }

  /// `sources` weights sum to 1.
  void place(int image, int x, int y, std::span<const tiles::WeightedColumn> sources) {
    for (const tiles::WeightedColumn& source : sources) addSurface(image, x, y, source);
    for (int layer = 0; layer < m_out.layers; ++layer) finishSurface(texelIndex(image, layer, x, y));
    if (m_out.basis == lpt::Basis::Lpt) {
      placeLpt(columnIndex(image, x, y), sources);
    } else {
      for (int layer = 0; layer < m_out.layers; ++layer) placePtm(texelIndex(image, layer, x, y), layer, sources);
    }
  }

  lpt::LayerStackInput take() { return std::move(m_out); }

 private:
  std::size_t columnIndex(int image, int x, int y) const {
    const auto w = static_cast<std::size_t>(m_out.width), h = static_cast<std::size_t>(m_out.height);
    return (static_cast<std::size_t>(image) * h + static_cast<std::size_t>(y)) * w + static_cast<std::size_t>(x);
  }
  std::size_t texelIndex(int image, int layer, int x, int y) const {
    return columnIndex(image * m_out.layers + layer, x, y);
  }

  /// Sums of weight, weight times alpha, and everything else times both.
  void addSurface(int image, int x, int y, const tiles::WeightedColumn& source) {
    const trace::LayerHits& hits = m_layers.hits;
    for (std::uint32_t t = hits.columnStart[source.column]; t < hits.columnStart[source.column + 1]; ++t) {
      const std::size_t texel = texelIndex(image, hits.layer[t], x, y);
      const float w = source.weight * hits.coverage(t);
      m_out.coverage[texel] += w;
      m_out.reflectance[texel] += w * m_layers.surface.reflectance[t];
      if (!m_out.transmittance.empty()) m_out.transmittance[texel] += w * m_layers.surface.transmittance[t];
      m_out.sky[texel] += w * glm::vec2(m_layers.visibility.skyReflected[t], m_layers.visibility.skyTransmitted[t]);
    }
  }

  void finishSurface(std::size_t texel) {
    const float coverage = m_out.coverage[texel];
    if (!(coverage > 0.0f)) return;
    m_out.reflectance[texel] /= coverage;
    if (!m_out.transmittance.empty()) m_out.transmittance[texel] /= coverage;
    m_out.sky[texel] /= coverage;
  }

  void placeLpt(std::size_t column, std::span<const tiles::WeightedColumn> sources) {
    const auto coverageOf = [&](std::uint32_t c) {
      return sources.size() == 1 ? 1.0f : columnCoverage(m_layers.hits, c);
    };
    for (int channel = 0; channel < m_out.channels; ++channel) {
      const auto set = (column * static_cast<std::size_t>(m_out.channels) + static_cast<std::size_t>(channel));
      mean(set, sources, coverageOf,
           [&](std::uint32_t c) { return m_layers.fit.column(static_cast<int>(c), channel); });
    }
  }

  void placePtm(std::size_t texel, int layer, std::span<const tiles::WeightedColumn> sources) {
    const auto coverageOf = [&](std::uint32_t c) { return sources.size() == 1 ? 1.0f : layerCoverage(c, layer); };
    const auto perSet = static_cast<std::size_t>(m_perSet);
    for (int channel = 0; channel < m_out.channels; ++channel) {
      const auto set = (texel * static_cast<std::size_t>(m_out.channels) + static_cast<std::size_t>(channel));
      mean(set, sources, coverageOf, [&](std::uint32_t c) {
        return m_layers.fit.column(static_cast<int>(c), channel)
            .subspan(static_cast<std::size_t>(layer) * perSet, perSet);
      });
    }
  }

  float layerCoverage(std::uint32_t column, int layer) const {
    const trace::LayerHits& hits = m_layers.hits;
    const auto begin = hits.layer.begin() + hits.columnStart[column];
    const auto end = hits.layer.begin() + hits.columnStart[column + 1];
    const auto found = std::lower_bound(begin, end, static_cast<std::uint8_t>(layer));
    if (found == end || *found != layer) return 0.0f;
    return hits.coverage(static_cast<std::size_t>(found - hits.layer.begin()));
  }

  /// Coverage-weighted mean of coefficient sets; a plain one where nothing is covered (the values are filled ones).
  template <typename CoverageOf, typename SetOf>
  void mean(std::size_t set, std::span<const tiles::WeightedColumn> sources, const CoverageOf& coverageOf,
            const SetOf& setOf) {
    float* out = m_out.coefficients.data() + set * static_cast<std::size_t>(m_perSet);
    float total = 0.0f;
    for (const bool covered : {true, false}) {
      for (const tiles::WeightedColumn& source : sources) {
        const float w = source.weight * (covered ? coverageOf(source.column) : 1.0f);
        if (!(w > 0.0f)) continue;
        total += w;
        const std::span<const float> values = setOf(source.column);
        for (std::size_t j = 0; j < values.size(); ++j) out[j] += w * values[j];
      }
      if (total > 0.0f) break;
    }
    for (int j = 0; j < m_perSet && total > 0.0f; ++j) out[j] /= total;
  }

  const SetLayers& m_layers;
  lpt::LayerStackInput m_out;
  int m_perSet = 0;  ///< coefficients of one channel of a column (LPT) or texel (PTM)
};

}  // namespace

std::vector<tiles::SeamColumn> seamColumns(const SetLayers& slices) {
  SWARD_CHECK(slices.fit.basis == lpt::Basis::Lpt && slices.fit.common.empty());
  SWARD_CHECK_EQ(slices.fit.channels, 2);
  std::vector<tiles::SeamColumn> columns(static_cast<std::size_t>(slices.fit.columns));
  for (std::uint32_t c = 0; c < columns.size(); ++c) {
    tiles::SeamColumn& column = columns[c];
    for (int channel = 0; channel < 2; ++channel) {
      const auto values = slices.fit.column(static_cast<int>(c), channel);
      std::copy(values.begin(), values.end(), column.coefficients[static_cast<std::size_t>(channel)].begin());
    }
    float total = 0.0f;
    for (std::uint32_t t = slices.hits.columnStart[c]; t < slices.hits.columnStart[c + 1]; ++t) {
      const float alpha = slices.hits.coverage(t);
      total += alpha;
      column.meanColour[0] += alpha * slices.surface.reflectance[t];
      column.meanColour[1] += alpha * slices.surface.transmittance[t];
    }
    for (glm::vec3& colour : column.meanColour) colour = total > 0.0f ? colour / total : glm::vec3(0.0f);
    column.coverage = columnCoverage(slices.hits, c);
  }
  return columns;
}

lpt::LayerStackInput patchStack(const SetLayers& layers, const JobContext& job) {
  const trace::LayerShape& shape = layers.hits.shape;
  StackBuilder builder(layers, shape.width, shape.height, 1);
  base::parallelFor(job, static_cast<std::size_t>(shape.height), 8, [&](std::size_t begin, std::size_t end) {
    for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      for (int x = 0; x < shape.width; ++x) {
        const tiles::WeightedColumn source{static_cast<std::uint32_t>(y * shape.width + x), 1.0f};
        builder.place(0, x, y, std::span(&source, 1));
      }
    }
  });
  return builder.take();
}

lpt::LayerStackInput tileStack(const SetLayers& layers, const tiles::TileSet& set, const JobContext& job) {
  const int side = set.side();
  const auto images = static_cast<int>(set.tiles.size());
  StackBuilder builder(layers, side, side, images);
  const auto rows = static_cast<std::size_t>(images) * static_cast<std::size_t>(side);
  base::parallelFor(job, rows, 8, [&](std::size_t begin, std::size_t end) {
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const int tile = row / side, y = row % side;
      for (int x = 0; x < side; ++x) {
        builder.place(tile, x, y, tiles::texelSources(set, tile, x - set.apron, y - set.apron));
      }
    }
  });
  return builder.take();
}

}  // namespace sward::bake
