#pragma once

#include "wither/texel.h"
#include "wither/texel_light.h"

#include <memory>
#include <vector>

#include <glm/glm.hpp>

namespace sward::bake {

/// A sward at one weathering degree as texels, and all that a renderer needs beside the light to draw it.
struct TexelBake {
  struct Level {
    std::shared_ptr<const wither::Texel> texel;
    wither::TexelSky sky;
  };
  std::vector<Level> levels;    ///< finest first, each half of the one before
  std::vector<glm::vec3> soil;  ///< reflectance of the ground under level 0's columns, [y][x]
  double weathering = 0.0;
  std::size_t points = 0;  ///< that the finest level was made from; 0: not known

  const wither::TexelGrid& grid() const { return levels.front().texel->grid(); }
};

}  // namespace sward::bake
