#include "bake/inspection.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace sward::bake {
namespace {

/// Writes columns of the patch, or means of several, into a stack's arrangement.
class InspectionBuilder {
 public:
  InspectionBuilder(const InspectedLayers& layers, const ConditionRange& conditions, int width, int height, int images)
      : m_layers(layers),
        m_conditions(conditions),
        m_width(static_cast<std::size_t>(width)),
        m_height(static_cast<std::size_t>(height)) {
    const std::size_t columns = m_width * m_height * static_cast<std::size_t>(images);
    m_out.condition.assign(columns, 0);
    m_out.rank.assign(columns, 0);
    m_out.weight.assign(columns, 0.0f);
    m_out.visibility.assign(columns * layerCount(), 0);
  }

  /// `sources` weights sum to 1.
  void place(std::size_t image, std::size_t x, std::size_t y, std::span<const tiles::WeightedColumn> sources) {
    const std::size_t column = (image * m_height + y) * m_width + x;
    placeFit(column, sources);
    placeVisibility(image, y * m_width + x, sources);
  }

  StackInspection take() { return std::move(m_out); }

 private:
  std::size_t layerCount() const { return static_cast<std::size_t>(m_layers.fit.layers); }

  void placeFit(std::size_t column, std::span<const tiles::WeightedColumn> sources) {
    const lpt::Fit& fit = m_layers.fit;
    double logarithms = 0.0, total = 0.0;
    int rank = 255;
    for (const tiles::WeightedColumn& source : sources) {
      m_out.weight[column] += source.weight * fit.weight[source.column];
      if (!(fit.condition[source.column] > 0.0f)) continue;
      total += static_cast<double>(source.weight);
      logarithms += static_cast<double>(source.weight) * std::log10(static_cast<double>(fit.condition[source.column]));
      rank = std::min(rank, static_cast<int>(fit.rank[source.column]));
    }
    if (!(total > 0.0)) return;
    m_out.condition[column] = m_conditions.byteOf(static_cast<float>(std::pow(10.0, logarithms / total)));
    m_out.rank[column] = static_cast<std::uint8_t>(rank);
  }

  void placeVisibility(std::size_t image, std::size_t within, std::span<const tiles::WeightedColumn> sources) {
    const trace::LayerHits& hits = m_layers.hits;
    std::array<float, 256> sum{}, coverage{};  // layers are counted in bytes
    for (const tiles::WeightedColumn& source : sources) {
      for (std::uint32_t t = hits.columnStart[source.column]; t < hits.columnStart[source.column + 1]; ++t) {
        const float weight = source.weight * hits.coverage(t);
        sum[hits.layer[t]] += weight * m_layers.visibility.visibility[t];
        coverage[hits.layer[t]] += weight;
      }
    }
    for (std::size_t layer = 0; layer < layerCount(); ++layer) {
      if (!(coverage[layer] > 0.0f)) continue;
      const float mean = std::clamp(sum[layer] / coverage[layer], 0.0f, 1.0f);
      m_out.visibility[(image * layerCount() + layer) * m_width * m_height + within] =
          static_cast<std::uint8_t>(std::lround(mean * 255.0f));
    }
  }

  const InspectedLayers& m_layers;
  ConditionRange m_conditions;
  std::size_t m_width, m_height;
  StackInspection m_out;
};

}  // namespace

std::uint8_t ConditionRange::byteOf(float condition) const {
  if (!(condition > 0.0f)) return 0;
  const double share = (std::log10(static_cast<double>(condition)) - low) / (high - low);
  return static_cast<std::uint8_t>(1 + std::lround(254.0 * std::clamp(share, 0.0, 1.0)));
}

ConditionRange conditionRange(std::span<const lpt::Fit* const> fits) {
  constexpr double kOutliers = 0.01, kLeastDecades = 0.05;
  std::vector<float> conditions;
  for (const lpt::Fit* fit : fits)
    for (const float condition : fit->condition)
      if (condition > 0.0f && std::isfinite(condition)) conditions.push_back(condition);
  if (conditions.empty()) return {};
  std::sort(conditions.begin(), conditions.end());
  const auto last = static_cast<double>(conditions.size() - 1);
  const auto at = [&](double share) {
    return std::log10(static_cast<double>(conditions[static_cast<std::size_t>(std::lround(share * last))]));
  };
  const double low = at(kOutliers), high = at(1.0 - kOutliers);
  const double widen = std::max(0.0, 0.5 * (kLeastDecades - (high - low)));
  return {low - widen, high + widen};
}

StackInspection inspectPatch(const InspectedLayers& layers, const ConditionRange& conditions, const JobContext& job) {
  const trace::LayerShape& shape = layers.hits.shape;
  InspectionBuilder builder(layers, conditions, shape.width, shape.height, 1);
  const auto width = static_cast<std::size_t>(shape.width);
  base::parallelFor(job, static_cast<std::size_t>(shape.height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const tiles::WeightedColumn source{static_cast<std::uint32_t>(y * width + x), 1.0f};
        builder.place(0, x, y, std::span(&source, 1));
      }
    }
  });
  return builder.take();
}

StackInspection inspectTiles(const InspectedLayers& layers, const ConditionRange& conditions, const tiles::TileSet& set,
                             const JobContext& job) {
  const int side = set.side();
  const auto images = static_cast<int>(set.tiles.size());
  InspectionBuilder builder(layers, conditions, side, side, images);
  const auto rows = static_cast<std::size_t>(images) * static_cast<std::size_t>(side);
  base::parallelFor(job, rows, 8, [&](std::size_t begin, std::size_t end) {
    for (auto row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      const int tile = row / side, y = row % side;
      for (int x = 0; x < side; ++x) {
        const auto sources = tiles::texelSources(set, tile, x - set.apron, y - set.apron);
        builder.place(static_cast<std::size_t>(tile), static_cast<std::size_t>(x), static_cast<std::size_t>(y),
                      sources);
      }
    }
  });
  return builder.take();
}

}  // namespace sward::bake
