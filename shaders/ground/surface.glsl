// What march and blending share: the ray in the shell's coordinates, weights of the families, macro variation, haze.
uniform vec2 u_eyeTiles;       // eye in tiles from the local cell
uniform float u_eyeM;          // height over the ground
uniform float u_tilesPerM;
uniform float u_heightM;       // of the shell
uniform float u_relightScale;
uniform float u_cosTheta0;
uniform float u_exposure;
uniform float u_hazePerM;      // extinction of aerial perspective
uniform float u_macroFadePerM;  // 1 / distance at which a pixel covers the macro variation
uniform samplerBuffer t_horizon;  // sky radiance at the horizon by the azimuth's diamond angle

// Weights of slices, blades normal to x and to y; they sum to 1 over the families that this variant draws.
vec3 familyWeights(vec3 d) {
  float steep = smoothstep(kSlicesFrom * u_cosTheta0, kSlicesAll * u_cosTheta0, abs(d.z));
  float towardX = abs(d.x) / max(abs(d.x) + abs(d.y), 1e-6);
  float x = smoothstep(0.5 - kDiagonalFade, 0.5 + kDiagonalFade, towardX);
  vec3 w = vec3(steep, (1.0 - steep) * x, (1.0 - steep) * (1.0 - x));
#if !(SWARD_FAMILIES & 1)
  w.x = 0.0;
#endif
#if !(SWARD_FAMILIES & 2)
  w.y = 0.0;
#endif
#if !(SWARD_FAMILIES & 4)
  w.z = 0.0;
#endif
  return w / max(w.x + w.y + w.z, 1e-6);
}

// Smooth brightness and hue over metres, from the upper bytes of the map's cells (render/macro_map.h), 128 the mean;
// fading where a pixel covers its waves. Cells differ little, a jittered place blends them.
vec3 macroTint(vec2 tiles, float distanceM, vec3 random) {
  uint word = mapWord(floor(tiles + random.yx - 0.5));
  float fade = max(1.0 - distanceM * u_macroFadePerM, 0.0) / 128.0;
  vec2 v = (vec2(float((word >> 8) & 0xffu), float((word >> 16) & 0xffu)) - 128.0) * fade;
  return (1.0 + v.x) * vec3(1.0 + kHueVariation * v.y, 1.0, 1.0 - 2.0 * kHueVariation * v.y);
}

vec3 throughHaze(vec3 radiance, vec3 d, float distanceM, float random) {
  float clear = fastPower(kHalf, u_hazePerM * distanceM);
  vec3 horizon = texelFetch(t_horizon, int((diamondAngle(d.xy) + 0.25) * kHorizonTexels + random)).rgb;
  return mix(horizon, radiance, clear);
}
