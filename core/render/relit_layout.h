#pragma once

#include <cstddef>

namespace sward::render {

/// Where one mip level of a relit set lies: its texels a plane, and its first texel counted from the set's start.
/// Levels leave gaps, so that a shader finds them with a shift.
struct LevelShape {
  int width = 0, height = 0;
  std::size_t offset = 0;
};

/// A set of relit planes (shaders/include/layout.glsl): `images` tiles, the last of them the mean of all others, of
/// `layers` planes each. Columns halve at every level down to maxLevel, rows only verticalLevels times.
struct SetLayout {
  int width = 0, height = 0;
  int images = 0, layers = 0;
  int maxLevel = 0, verticalLevels = 0;

  int planes() const { return images * layers; }
  LevelShape level(int level) const;
  std::size_t texelCount() const;
};

/// The layout of width x height planes of `tiles` tiles and their mean: as many levels as halve exactly, rows never
/// below leastRows.
SetLayout makeSetLayout(int width, int height, int tiles, int layers, int leastRows);

}  // namespace sward::render
