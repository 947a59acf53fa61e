#pragma once

#include "trace/layers.h"

#include <cstdint>
#include <vector>

namespace sward::trace {

/// The image of a layer set cut into squares of kTileSide columns: what one thread works on at a time. Texels of
/// different tiles are different, so tiles may run in any order.
class TileOrder {
 public:
  static constexpr int kTileSide = 32;
  explicit TileOrder(const LayerShape& shape);

  std::size_t tiles() const { return static_cast<std::size_t>(m_across) * static_cast<std::size_t>(m_down); }
  /// The texels of a tile, layer by layer and there in blocks of 4 x 4 columns: neighbours in the list are neighbours
  /// in space, so that packets of rays stay together (measured: a fifth faster than column order). Replaces `texels`;
  /// `columns` receives the column of each.
  void texelsOf(std::size_t tile, const LayerHits& hits, std::vector<std::uint32_t>& texels,
                std::vector<std::uint32_t>& columns);

 private:
  struct Entry {
    std::uint32_t texel, column;
  };
  LayerShape m_shape;
  int m_across = 0, m_down = 0;
  std::vector<std::vector<Entry>> m_byLayer;  ///< scratch
};

}  // namespace sward::trace
