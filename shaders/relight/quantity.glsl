// Texels of the view modes: a quantity instead of radiance, coverage as ever. Scalars go to the first channel, in [0, 1].
uniform int u_onlyLayer;  // coverage of all others is 0; -1: all are shown
uniform bool u_soil;      // the stack is the soil, which covers nothing
uniform int u_channel;    // kReflected or kTransmitted of core/lpt/layer_stack.h
#if SWARD_QUANTITY == SWARD_VISIBILITY || SWARD_QUANTITY == SWARD_CONDITION
uniform usamplerBuffer t_inspection;  // bytes, one a texel (visibility) or one a column (condition)

float inspected(int at) {
  return float((texelFetch(t_inspection, at >> 2).r >> uint((at & 3) * 8)) & 0xffu) / 255.0;
}
#endif

// `column` counts over all images, f is the response (or the coefficient) of the texel.
vec4 quantityTexel(int texel, int column, vec2 f, int layer, int image) {
  vec4 lit = relitTexel(texel, f);
#if SWARD_QUANTITY == SWARD_ALBEDO
  vec3 root = unpackUnorm4x8(texelFetch(t_surface, texel).r).rgb;
  vec3 value = root * root;
#elif SWARD_QUANTITY == SWARD_LUMINANCE || SWARD_QUANTITY == SWARD_COEFFICIENT
  vec3 value = vec3(f[u_channel], 0.0, 0.0);
#elif SWARD_QUANTITY == SWARD_COVERAGE
  vec3 value = vec3(u_soil ? 0.0 : 1.0, 0.0, 0.0);
#elif SWARD_QUANTITY == SWARD_VISIBILITY
  vec3 value = vec3(inspected(texel), 0.0, 0.0);
#elif SWARD_QUANTITY == SWARD_CONDITION
  vec3 value = vec3(inspected(column), 0.0, 0.0);
#elif SWARD_QUANTITY == SWARD_TILES
  // Shaded, but lighter than in truth, so that hues are told apart in the shade too. Blades of the patch belong to no
  // tile yet: relight/bind_blades.comp tints them.
  vec3 value = vec3(sqrt(dot(lit.rgb, vec3(0.2126, 0.7152, 0.0722))));
#if SWARD_TINT
  value *= tileColour(image);
#endif
#else
  vec3 value = lit.rgb;
#endif
  return vec4(value, u_onlyLayer < 0 || layer == u_onlyLayer ? lit.a : 0.0);
}
