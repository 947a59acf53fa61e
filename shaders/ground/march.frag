// The layer march (science.md section 3, ours): from the shell's top front to back through the planes of up to three
// families, in the order in which the ray meets them, until it is opaque; then the soil.
//
// A slab of family f crossed by a ray of direction d takes the texel's optical depth times w_f / |d_f|: its path is
// 1/|d_f| longer than the perpendicular one the texel was sampled with, and the weights share the medium out among the
// families. In a uniform medium the sum over all planes is then extinction times path, whatever the weights.
//
// SWARD_FAMILIES: 1 slices, 2 blades normal to x, 4 normal to y; blocks of the screen are drawn by the variant that
// has the families they need.
#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"
#include "ground/texels.glsl"
#include "ground/surface.glsl"

out vec4 o_radiance;

// Planes of one family along the ray: distance of the next, distance between two, number of the next and its step.
struct Planes {
  float t;
  float stride;
  float number;
  float step;
  float power;  // of the transmittance: weight times path, times slabs in a step
};

Planes bladePlanes(float eye, float slope, float tEnter, float wantedStride, float weight, float random) {
  Planes planes;
  float rate = max(abs(slope), 1e-6) * float(u_slabs);  // slabs a metre
  float slabs = max(1.0, floor(wantedStride * rate));
  planes.step = slope < 0.0 ? -slabs : slabs;
  planes.stride = slabs / rate;
  float at = (eye + slope * tEnter) * float(u_slabs);
  float ahead = slope < 0.0 ? at - floor(at - 0.5) - 0.5 : ceil(at - 0.5) + 0.5 - at;
  ahead += floor(random * slabs);
  planes.t = tEnter + ahead / rate;
  planes.number = floor(slope < 0.0 ? at - ahead : at + ahead);
  planes.power = weight * slabs * u_tilesPerM / (rate / float(u_slabs));
  return planes;
}

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  vec3 random = pixelRandom(ivec2(gl_FragCoord.xy));
  float levelJitter = exp2(random.z + kLevelBias);
  float down = min(d.z, 0.0);
  float slopeZ = d.z < 0.0 ? min(d.z, -1e-5) : max(d.z, 1e-5);

  bool above = u_eyeM > u_heightM;
  bool hits = slopeZ < 0.0 || !above;
  float tEnter = above ? (u_heightM - u_eyeM) / slopeZ : 0.0;
  float tExit = ((slopeZ < 0.0 ? 0.0 : u_heightM) - u_eyeM) / slopeZ;
  vec2 slope = d.xy * u_tilesPerM;
  float footprintEnter = tEnter * u_pixelAngle;
  // Where the ray sinks by less than a pixel between two slabs, it may skip some.
  float wantedStride = clamp(footprintEnter, 0.0, u_heightM / kHeightSteps) / abs(slopeZ);

  vec3 weights = familyWeights(d);
  float transmittance = hits ? 1.0 : 0.0;
  vec3 radiance = vec3(0.0);

#if SWARD_FAMILIES & 1
  int layers = u_sliceLayers - 1;
  float spacing = u_heightM / float(layers);
  Planes slices;
  slices.stride = spacing / abs(slopeZ);
  slices.step = slopeZ < 0.0 ? 1.0 : -1.0;
  float heightEnter = (u_heightM - (u_eyeM + slopeZ * tEnter)) / spacing;  // slabs under the top
  float first = slopeZ < 0.0 ? ceil(heightEnter - 0.5) : floor(heightEnter - 0.5);
  slices.t = tEnter + (first + 0.5 - heightEnter) * slices.step * slices.stride;
  slices.number = first;
  slices.power = weights.x / abs(slopeZ);
#endif
#if SWARD_FAMILIES & 2
  Planes bladesX = bladePlanes(u_eyeTiles.x, slope.x, max(tEnter, kNearestBladeM), wantedStride, weights.y, random.y);
  int baseX = int(slope.x < 0.0 ? u_bladeBase[0] : u_bladeBase[1]);
#endif
#if SWARD_FAMILIES & 4
  Planes bladesY = bladePlanes(u_eyeTiles.y, slope.y, max(tEnter, kNearestBladeM), wantedStride, weights.z, random.x);
  int baseY = int(slope.y < 0.0 ? u_bladeBase[2] : u_bladeBase[3]);
#endif

  for (int i = 0; i < kMaxSteps; ++i) {
    // The family whose plane is next.
    float t = 1e30;
    float family = -1.0;
#if SWARD_FAMILIES & 1
    t = slices.t;
    family = kFamilySlices;
#endif
#if SWARD_FAMILIES & 2
    family = bladesX.t < t ? kFamilyX : family;
    t = min(t, bladesX.t);
#endif
#if SWARD_FAMILIES & 4
    family = bladesY.t < t ? kFamilyY : family;
    t = min(t, bladesY.t);
#endif
    if (!(t < tExit && transmittance > kTransmittanceEnd)) break;

    vec2 xy = u_eyeTiles + slope * t;
    float height = (u_eyeM + slopeZ * t) / u_heightM;
    float footprint = t * u_pixelAngle;
    vec4 texel = vec4(0.0);
    float power = 1.0;
#if SWARD_FAMILIES == 1
    texel = fetchSlice(int(slices.number), xy, footprint, random, levelJitter);
    power = slices.power;
    slices.t += slices.stride;
    slices.number += slices.step;
#elif SWARD_FAMILIES & 1
    if (family == kFamilySlices) {
      texel = fetchSlice(int(slices.number), xy, footprint, random, levelJitter);
      power = slices.power;
      slices.t += slices.stride;
      slices.number += slices.step;
    }
#endif
#if SWARD_FAMILIES & 6
#if (SWARD_FAMILIES & 6) == 2
    bool axisX = true;
#elif (SWARD_FAMILIES & 6) == 4
    bool axisX = false;
#else
    bool axisX = family == kFamilyX;
#endif
#if SWARD_FAMILIES & 1
    if (family != kFamilySlices)
#endif
    {
      float across = 0.0;
      int base = 0;
#if SWARD_FAMILIES & 2
      if (axisX) {
        across = bladesX.number;
        base = baseX;
        power = bladesX.power;
        bladesX.t += bladesX.stride;
        bladesX.number += bladesX.step;
      }
#endif
#if SWARD_FAMILIES & 4
      if (!axisX) {
        across = bladesY.number;
        base = baseY;
        power = bladesY.power;
        bladesY.t += bladesY.stride;
        bladesY.number += bladesY.step;
      }
#endif
      texel = fetchBlade(axisX, base, across, axisX ? xy.y : xy.x, height, footprint, random, levelJitter);
    }
#endif
    vec4 relit = decodeRelit(texel);
    float through = exp2(power * log2(1.0 - kOpaque * relit.a));
    radiance += transmittance * (1.0 - through) * relit.rgb;
    transmittance *= through;
  }

  float opacity = hits ? 1.0 - transmittance : 0.0;
  radiance /= transmittance < kTransmittanceEnd ? max(opacity, 1e-3) : 1.0;
  float left = !hits ? 1.0 : transmittance < kTransmittanceEnd ? 0.0 : transmittance;
  if (down < 0.0) {
    float slant = mix(1.0, 1.0 / abs(slopeZ), kSoilLevelSlant);
    vec3 soil = decodeRelit(fetchSlice(u_sliceLayers - 1, u_eyeTiles + slope * tExit, tExit * u_pixelAngle * slant,
                                       random, levelJitter)).rgb;
    radiance += left * soil;
    left = 0.0;
  }
  float depth = hits ? max(tEnter, 0.0) : 0.0;
  vec3 tint = macroTint((u_eyeTiles + slope * depth) / u_tilesPerM, depth * u_pixelAngle);
  vec3 grass = radiance * u_relightScale * tint;
  // Rays that reach the sky start in the shell: what they crossed of it is too near for haze.
  vec3 seen = left > 0.0 ? grass + left * (skyRadiance(d) + sunDisc(d)) : throughHaze(grass, d, depth);
  o_radiance = vec4(seen * u_exposure, 1.0);
}
