#include "render/relit_layout.h"

#include <algorithm>

namespace sward::render {

LevelShape SetLayout::level(int level) const {
  const int vertical = std::min(level, verticalLevels);
  LevelShape shape{width >> level, height >> vertical, 0};
  const auto area = [&](int l) {
    return static_cast<std::size_t>(width >> l) * static_cast<std::size_t>(height >> std::min(l, verticalLevels));
  };
  for (int l = 0; l < level; ++l) shape.offset += static_cast<std::size_t>(planes()) * area(l);
  return shape;
}

std::size_t SetLayout::texelCount() const {
  const LevelShape last = level(maxLevel);
  return last.offset + static_cast<std::size_t>(planes()) * static_cast<std::size_t>(last.width) *
                           static_cast<std::size_t>(last.height);
}

SetLayout makeSetLayout(int width, int height, int tiles, int layers, int leastRows) {
  SetLayout layout{width, height, tiles + 1, layers, 0, 0};
  while (width % 2 == 0) {
    width /= 2;
    ++layout.maxLevel;
    if (height % 2 == 0 && height / 2 >= leastRows && layout.verticalLevels == layout.maxLevel - 1) {
      height /= 2;
      ++layout.verticalLevels;
    }
  }
  return layout;
}

}  // namespace sward::render
