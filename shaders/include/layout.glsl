// How relit texels lie in the one buffer that all passes share. Must match core/render/relit_layout.h.
//
// A set (the slices with the soil as their last layer, or one of the four blade sets) holds, level by level,
// image (tile, and after the last tile the mean of all) x layer x row x column. Columns halve at every level, rows only
// a number of times (blades keep their height profile). Level l starts at 2 planes (area - (area >> l)) texels, which
// leaves gaps but costs a shift: areas at least halve from level to level.

int levelOffset(int level, int area, int planes) { return 2 * planes * (area - (area >> level)); }

// Texels hold, in bytes, the square root of the straight radiance over the relight scale, and the square root of the
// optical depth of their coverage over kDepthRange: finer than coverage itself where grass is sparse, and ready to be
// multiplied by a path. A texel of full coverage lets 1 - kOpaque through.
const float kOpaque = 0.985;
const float kDepthRange = 4.19970508;  // -ln(1 - kOpaque)

vec4 decodeRelit(uint stored) {
  vec4 value = unpackUnorm4x8(stored);
  return vec4(value.rgb * value.rgb, (1.0 - exp(-kDepthRange * value.a * value.a)) / kOpaque);
}
uint encodeRelit(vec3 radiance, float coverage) {
  float depth = -log(1.0 - kOpaque * clamp(coverage, 0.0, 1.0)) / kDepthRange;
  return packUnorm4x8(sqrt(clamp(vec4(radiance, depth), 0.0, 1.0)));
}
