// What march and blending share: the ray in the shell's coordinates, weights of the families, macro variation, haze.
uniform vec2 u_eyeTiles;       // eye in tiles from the local cell
uniform float u_eyeM;          // height over the ground
uniform float u_tilesPerM;
uniform float u_heightM;       // of the shell
uniform float u_relightScale;
uniform float u_cosTheta0;
uniform float u_exposure;
uniform float u_hazePerM;      // extinction of aerial perspective
uniform sampler2D t_noise;
uniform vec2 u_noiseOffset;    // lattice points at the local cell
uniform float u_noisePerM;     // noise lattice points a metre
uniform float u_macroVariation;

const float kFamilySlices = 0.0, kFamilyX = 1.0, kFamilyY = 2.0;

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

// Smooth brightness and hue over metres, fading where a pixel covers a lattice cell.
vec3 macroTint(vec2 xyM, float footprintM) {
  vec2 place = xyM * u_noisePerM + u_noiseOffset;
  float fade = clamp(1.5 - footprintM * u_noisePerM, 0.0, 1.0);
  const float kPeriod = 256.0;
  vec2 f = fract(place);
  vec2 smoothed = floor(place) + f * f * (3.0 - 2.0 * f);
  vec2 n = textureLod(t_noise, (smoothed + 0.5) / kPeriod, 0.0).rg;
  float amount = 2.0 * u_macroVariation * fade;
  vec2 v = (n - 0.5) * amount;
  return (1.0 + v.x) * vec3(1.0 + kHueVariation * v.y, 1.0, 1.0 - 2.0 * kHueVariation * v.y);
}

vec3 throughHaze(vec3 radiance, vec3 d, float distanceM) {
  float clear = exp2(-u_hazePerM * distanceM * 1.44269504);
  return mix(horizonRadiance(d), radiance, clear);
}
