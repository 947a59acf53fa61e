// How relit texels lie in the one buffer that all passes share. Must match core/render/relit_layout.h.
//
// A set (the slices with the soil as their last layer, or one of the four blade sets) holds, level by level,
// image (tile, and after the last tile the mean of all) x layer x row x column. Rows halve from level to level only
// `verticalLevels` times (blades keep their height profile), columns at every level.

struct LevelShape {
  int width;
  int height;
  int offset;  // in texels from the set's start
};

LevelShape levelShape(int level, int width, int height, int verticalLevels, int planes) {
  LevelShape shape;
  int vertical = min(level, verticalLevels);
  shape.width = width >> level;
  shape.height = height >> vertical;
  int area = shape.width * shape.height;
  int areaAtTurn = (width >> vertical) * shape.height;
  // Areas fall by 4 a level down to `vertical`, then by 2: sums of geometric series, exact in integers.
  shape.offset = planes * ((width * height - areaAtTurn) / 3 * 4 + (areaAtTurn - area) * 2);
  return shape;
}

// Texels hold the square root of the straight radiance over the relight scale, and linear coverage.
vec4 decodeRelit(vec4 stored) { return vec4(stored.rgb * stored.rgb, stored.a); }
uint encodeRelit(vec3 radiance, float coverage) {
  return packUnorm4x8(vec4(sqrt(clamp(radiance, 0.0, 1.0)), coverage));
}
