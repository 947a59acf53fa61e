// How relit texels lie in the one buffer that all passes share. Must match core/render/relit_layout.h.
//
// A set (the slices with the soil as their last layer, or one of the four blade sets) holds, level by level,
// image (tile, and after the last tile the mean of all) x layer x row x column. Columns halve at every level, rows only
// a number of times (blades keep their height profile). Level l starts at 2 planes (area - (area >> l)) texels, which
// leaves gaps but costs a shift: areas at least halve from level to level.

int levelOffset(int level, int area, int planes) { return 2 * planes * (area - (area >> level)); }

// Texels hold the square root of the straight radiance over the relight scale, and linear coverage.
vec4 decodeRelit(uint stored) {
  vec4 value = unpackUnorm4x8(stored);
  return vec4(value.rgb * value.rgb, value.a);
}
uint encodeRelit(vec3 radiance, float coverage) {
  return packUnorm4x8(vec4(sqrt(clamp(radiance, 0.0, 1.0)), coverage));
}
