// What relit texels hold: SWARD_QUANTITY is render::ViewQuantity (core/render/view_mode.h), or kShadedLayer for the
// picture itself with one slice layer alone. 0 and undefined: radiance.
#ifndef SWARD_QUANTITY
#define SWARD_QUANTITY 0
#endif
#define SWARD_ALBEDO 1
#define SWARD_LUMINANCE 2
#define SWARD_COVERAGE 3
#define SWARD_COEFFICIENT 4
#define SWARD_VISIBILITY 5
#define SWARD_CONDITION 6
#define SWARD_TILES 7
#define SWARD_SHADED_LAYER 8

#if SWARD_QUANTITY == SWARD_TILES
// A tile's colour, linear: hues a golden angle apart, so that neighbours in number differ. Also tileColour() of
// core/render/view_mode.cpp.
vec3 tileColour(int tile) {
  const float kGolden = 0.61803399;
  const float kPale = 0.12;
  vec3 turn = fract(float(tile) * kGolden + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0;
  return mix(vec3(kPale), vec3(1.0), clamp(abs(turn - 3.0) - 1.0, 0.0, 1.0));
}
#endif
