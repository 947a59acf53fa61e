#include "trace/tile_order.h"

#include <algorithm>

namespace sward::trace {
namespace {
constexpr int kBlockSide = 4;
}

TileOrder::TileOrder(const LayerShape& shape)
    : m_shape(shape),
      m_across((shape.width + kTileSide - 1) / kTileSide),
      m_down((shape.height + kTileSide - 1) / kTileSide),
      m_byLayer(static_cast<std::size_t>(shape.layers)) {}

void TileOrder::texelsOf(std::size_t tile, const LayerHits& hits, std::vector<std::uint32_t>& texels,
                         std::vector<std::uint32_t>& columns) {
  for (auto& layer : m_byLayer) layer.clear();
  constexpr int kBlocks = kTileSide / kBlockSide;
  const int tileX = static_cast<int>(tile % static_cast<std::size_t>(m_across)) * kTileSide;
  const int tileY = static_cast<int>(tile / static_cast<std::size_t>(m_across)) * kTileSide;
  for (int block = 0; block < kBlocks * kBlocks; ++block) {
    const int blockX = tileX + block % kBlocks * kBlockSide;
    const int blockY = tileY + block / kBlocks * kBlockSide;
    for (int y = blockY; y < std::min(blockY + kBlockSide, m_shape.height); ++y) {
      for (int x = blockX; x < std::min(blockX + kBlockSide, m_shape.width); ++x) {
        const auto column = static_cast<std::uint32_t>(y * m_shape.width + x);
        for (std::uint32_t t = hits.columnStart[column]; t < hits.columnStart[column + 1]; ++t) {
          m_byLayer[hits.layer[t]].push_back({t, column});
        }
      }
    }
  }
  texels.clear();
  columns.clear();
  for (const auto& layer : m_byLayer) {
    for (const Entry& entry : layer) {
      texels.push_back(entry.texel);
      columns.push_back(entry.column);
    }
  }
}

}  // namespace sward::trace
