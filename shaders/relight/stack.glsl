// A LayerStack's bytes as 32-bit words (core/lpt/layer_stack.h), and its response to one light.
// Defines: SWARD_LPT (1: coefficients belong to columns; 0: to texels), SWARD_COMMON (1: an LPT's columns share a
// lpt::CommonResponse), SWARD_PER_ITEM (how many), SWARD_CHANNELS, SWARD_BITS, SWARD_TRANSMISSION.

uniform usamplerBuffer t_coefficients;
uniform usamplerBuffer t_surface;
uniform usamplerBuffer t_sky;
#if SWARD_TRANSMISSION
uniform usamplerBuffer t_transmission;
#endif

#if SWARD_COMMON
uniform samplerBuffer t_common;  // lpt::CommonAtLight: [layer][channel][response, coordinate][feature]
const float kLargestCoordinate = 4.0;
#endif

// The light's functions times the quantisation step, and what the bases add: f = constant + sum weight_j q_j.
uniform float u_weights[20];     // [channel][coefficient]
uniform float u_constants[6];    // [channel][A, B, C]
uniform vec3 u_sun;              // sun irradiance / pi / relight scale
uniform vec3 u_skyLight;         // mean sky radiance / relight scale

const int kPerItem = SWARD_PER_ITEM;
const int kPerWord = 32 / SWARD_BITS;
const int kValues = kPerItem * SWARD_CHANNELS;
const uint kMask = SWARD_BITS == 8 ? 0xffu : 0xffffu;

// All coefficients of one column (LPT) or texel (PTM), still quantised.
void loadCoefficients(int item, out float q[kValues]) {
#if SWARD_PER_ITEM * SWARD_CHANNELS * SWARD_BITS % 32 == 0
  const int kWords = kValues / kPerWord;
  for (int word = 0; word < kWords; ++word) {
    uint bits = texelFetch(t_coefficients, item * kWords + word).r;
    for (int i = 0; i < kPerWord; ++i) q[word * kPerWord + i] = float((bits >> uint(i * SWARD_BITS)) & kMask);
  }
#else
  for (int j = 0; j < kValues; ++j) {
    int at = item * kValues + j;
    uint bits = texelFetch(t_coefficients, at / kPerWord).r;
    q[j] = float((bits >> uint(at % kPerWord * SWARD_BITS)) & kMask);
  }
#endif
}

vec2 skyOf(int texel) {
  uint pair = texelFetch(t_sky, texel >> 1).r >> uint((texel & 1) * 16);
  return vec2(float(pair & 0xffu), float((pair >> 8) & 0xffu)) / 255.0;
}

#if SWARD_LPT
// f = A + B u + C u^2 for the light (equation 5 of the paper), per channel; with a common response, of the coordinate g.
struct Response {
  vec3 abc[SWARD_CHANNELS];
};
Response columnResponse(int column) {
  float q[kValues];
  loadCoefficients(column, q);
  Response response;
  for (int c = 0; c < SWARD_CHANNELS; ++c) {
    int k = c * 10;
#if SWARD_QUANTITY == SWARD_COEFFICIENT
    // All weights but one are 0: the coefficient itself, the same in every layer.
    float only = u_constants[c * 3];
    for (int j = 0; j < kPerItem; ++j) only += u_weights[k + j] * q[k + j];
    response.abc[c] = vec3(only, 0.0, 0.0);
#else
#if SWARD_COMMON
    float a = u_constants[c * 3] + u_weights[k + 6] * q[k + 6] + u_weights[k + 7] * q[k + 7] +
              u_weights[k + 9] * q[k + 9];
    float cc = u_constants[c * 3 + 2] + u_weights[k] * q[k] + u_weights[k + 1] * q[k + 1] +
               u_weights[k + 2] * q[k + 2];
#else
    float a = u_constants[c * 3] + u_weights[k] * q[k] + u_weights[k + 1] * q[k + 1] + u_weights[k + 3] * q[k + 3] +
              u_weights[k + 6] * q[k + 6] + u_weights[k + 7] * q[k + 7] + u_weights[k + 9] * q[k + 9];
    float cc = u_constants[c * 3 + 2] + u_weights[k + 2] * q[k + 2];
#endif
    float b = u_constants[c * 3 + 1] + u_weights[k + 4] * q[k + 4] + u_weights[k + 5] * q[k + 5] +
              u_weights[k + 8] * q[k + 8];
    response.abc[c] = vec3(a, b, cc);
#endif
  }
  return response;
}
#endif

#if SWARD_COMMON
// What a layer's texels share, for the light.
struct CommonLayer {
  float w[SWARD_CHANNELS * 10];
};
CommonLayer commonLayer(int layer) {
  CommonLayer terms;
  int first = layer * SWARD_CHANNELS * 10;
  for (int i = 0; i < SWARD_CHANNELS * 10; ++i) terms.w[i] = texelFetch(t_common, first + i).r;
  return terms;
}

// `open`: the part that the layers before let through; after, with this one.
vec2 texelResponse(Response response, CommonLayer terms, int texel, inout float open) {
  vec2 sky = skyOf(texel);
  float coverage = unpackUnorm4x8(texelFetch(t_surface, texel).r).a;
  vec2 f = vec2(0.0);
  for (int c = 0; c < SWARD_CHANNELS; ++c) {
    int k = c * 10;
    float together = terms.w[k] + terms.w[k + 1] * sky.x + terms.w[k + 2] * sky.y + terms.w[k + 3] * coverage +
                     terms.w[k + 4] * open;
    float g = terms.w[k + 5] + terms.w[k + 6] * sky.x + terms.w[k + 7] * sky.y + terms.w[k + 8] * coverage +
              terms.w[k + 9] * open;
    g = clamp(g, 0.0, kLargestCoordinate);
    f[c] = response.abc[c].x + (response.abc[c].y + response.abc[c].z * g) * g + together;
  }
  open *= 1.0 - coverage;
  return max(f, vec2(0.0));
}
#else
vec2 texelResponse(
#if SWARD_LPT
    Response response, float u
#else
    int texel
#endif
) {
  vec2 f = vec2(0.0);
#if SWARD_LPT
  for (int c = 0; c < SWARD_CHANNELS; ++c)
    f[c] = response.abc[c].x + (response.abc[c].y + response.abc[c].z * u) * u;
#else
  float q[kValues];
  loadCoefficients(texel, q);
  for (int c = 0; c < SWARD_CHANNELS; ++c) {
    f[c] = u_constants[c * 3];
    for (int j = 0; j < kPerItem; ++j) f[c] += u_weights[c * 10 + j] * q[c * kPerItem + j];
  }
#endif
  return max(f, vec2(0.0));
}
#endif

// Radiance over the relight scale (straight) and coverage of one texel.
vec4 relitTexel(int texel, vec2 f) {
  vec4 surface = unpackUnorm4x8(texelFetch(t_surface, texel).r);
  vec2 sky = skyOf(texel);
  vec3 radiance = surface.rgb * surface.rgb * (f.x * u_sun + sky.x * u_skyLight);
#if SWARD_TRANSMISSION
  vec3 through = unpackUnorm4x8(texelFetch(t_transmission, texel).r).rgb;
  radiance += through * through * (f.y * u_sun + sky.y * u_skyLight);
#endif
  return vec4(radiance, surface.a);
}
