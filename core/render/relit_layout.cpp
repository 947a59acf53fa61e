#include "render/relit_layout.h"

#include <algorithm>

namespace sward::render {

LevelShape SetLayout::level(int level) const {
  const auto area = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t offset = 2 * static_cast<std::size_t>(planes()) * (area - (area >> level));
  return {width >> level, height >> std::min(level, verticalLevels), offset};
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
