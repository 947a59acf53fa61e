// The layer march (science.md section 3, ours): from the shell's top front to back through the planes of one family
// until the ray is opaque; then the soil.
//
// A slab of a family crossed by a ray of direction d takes the texel's optical depth times 1 / |d . normal|: its path is
// so much longer than the perpendicular one the texel was sampled with. In a uniform medium the sum over the planes is
// then extinction times path, whatever the family. Between families a ray draws lots by their weights, so that pictures
// of several samples dissolve from one to the other with the right mean opacity, and a ray pays for one family alone.
//
// SWARD_FAMILIES: 1 slices, 2 blades normal to x, 4 normal to y; SWARD_SKY: some rays end in the sky. Blocks of the
// screen are drawn by the variant that has what they need.
// SWARD_TERRAIN: the shell lies over a terrain (ground/terrain.glsl).
#ifndef SWARD_TERRAIN
#define SWARD_TERRAIN 0
#endif
#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"
#include "ground/texels.glsl"
#include "ground/surface.glsl"
#if SWARD_TERRAIN
#include "ground/terrain.glsl"
#endif

#define SWARD_SLICES (SWARD_FAMILIES & 1)
#define SWARD_BLADES (SWARD_FAMILIES & 6)

out vec4 o_radiance;

float g_transmittance = 1.0;
vec3 g_sum = vec3(0.0);  // in kColourUnit

void composite(uint stored, float depthUnit) {
  float through = transmitted(storedDepth(stored, depthUnit));
  float opacity = g_transmittance > kTransmittanceEnd ? 1.0 - through : 0.0;
  g_sum += g_transmittance * opacity * storedColour(stored);
  g_transmittance -= g_transmittance * opacity;
}

// Where the march ends: rays cross at most kMaxSteps planes.
float marchEnd(Planes planes, float tEnd) { return min(tEnd, planes.t + planes.stride * (float(kMaxSteps) - 0.5)); }

// Both marches take two planes at a time, so that the second's fetches need not wait to hear whether the first ended
// the ray. A second plane beyond tEnd has no depth. Slices look up one tile for both: a second plane that is met on
// another cell waits for the next step.

#if SWARD_SLICES
void marchSlices(Walk walk, Level level, float tEnd, float random) {
  Planes planes = slicePlanes(walk, random);
  vec2 place = slicePlace(walk, level);
  int start = layerStart(level, int(planes.place));
  int step = int(planes.step) * level.area;
  float t = planes.t;
  float tMarch = marchEnd(planes, tEnd);
  while (t < tMarch && g_transmittance > kTransmittanceEnd) {
    float tNext = t + planes.stride;
    vec2 here = place + walk.slope * t;
    vec2 next = place + walk.slope * tNext;
    vec2 cell = floor(here);
    bool near = floor(next) == cell;
    bool both = near && tNext < tEnd;
    int tile = start + tileStart(level, cell);
    int first = tile + sliceTexel(level, here - cell);
    int second = both ? tile + step + sliceTexel(level, next - cell) : first;
    uint firstStored = texelFetch(t_relit, first).r;
    uint secondStored = texelFetch(t_relit, second).r;
    composite(firstStored, planes.depthUnit);
    composite(secondStored, both ? planes.depthUnit : 0.0);
    t = near ? tNext + planes.stride : tNext;
    start += near ? 2 * step : step;
  }
}
#endif

#if SWARD_BLADES
void marchBlades(Walk walk, Level level, bool axisX, float tEnd, float random) {
  BladeWalk blades = startBlades(walk, level, axisX, random);
  Planes planes = blades.planes;
  float t = planes.t;
  float across = planes.place;
  float tMarch = marchEnd(planes, tEnd);
  while (t < tMarch && g_transmittance > kTransmittanceEnd) {
    float tNext = t + planes.stride;
    uint first = fetchAlong(blades, level, axisX, across, t);
    uint second = fetchAlong(blades, level, axisX, across + planes.step, min(tNext, tEnd));
    composite(first, planes.depthUnit);
    composite(second, tNext < tEnd ? planes.depthUnit : 0.0);
    t = tNext + planes.stride;
    across += 2.0 * planes.step;
  }
}
#endif

#if SWARD_TERRAIN
// One way through the shell: radiance over exposure, premultiplied by what was in front of it.
vec3 marchTerrain(vec3 d, float enterM, bool last, vec3 random, float levelJitter, float lot, out bool soilSeen) {
  TerrainWalk w = startTerrain(d, enterM, last);
  Walk walk = w.walk;
  float before = g_transmittance;
  g_sum = vec3(0.0);
  ivec2 family = chooseFamily(normalize(vec3(d.xy, walk.slopeZ)), lot);
  if (family.x == 0) {
    // Steep enough to go straight.
    walk.tEnd = walk.slopeZ < 0.0 ? walk.heightM * walk.path : (v_heightM - walk.heightM) * walk.path;
    w.soilSeen = walk.slopeZ < 0.0;
    marchSlices(walk, sliceLevel(walk.footprint, random, levelJitter), walk.tEnd, fourthRandom(random));
  }
#if SWARD_BLADES
  if (family.x == 1) {
    g_rowBend = w.bend;
    marchBlades(walk, bladeLevel(walk.footprint, random, levelJitter), family.y == 0, walk.tEnd, random.y);
  }
#endif
  soilSeen = w.soilSeen;
  vec3 radiance = g_sum * kColourUnit;
  if (soilSeen && g_transmittance > kTransmittanceEnd) {
    Level level = soilLevelOf(walk, random, levelJitter);
    vec2 foot = slicePlace(walk, level) + walk.slope * max(walk.tEnd, 0.0);
    radiance += g_transmittance * kColourUnit * storedColour(fetchSlice(level, layerStart(level, v_sliceLayers - 1), foot));
    g_transmittance = 0.0;
  }
  // What little an opaque ray has left is given to what it saw.
  if (g_transmittance <= kTransmittanceEnd) {
    radiance *= before / max(before - g_transmittance, 1e-6);
    g_transmittance = 0.0;
  }
#if SWARD_MODE
  return radiance * v_relightScale;
#else
  radiance *= macroTint(walk.place, walk.tEnter, random) * terrainLight(w) * v_relightScale;
  float clear = exp(-v_hazePerM * walk.tEnter);
  vec3 horizon = texelFetch(t_horizon, int((diamondAngle(d.xy) + 0.25) * kHorizonTexels + random.x)).rgb;
  return mix(horizon * (before - g_transmittance), radiance, clear);
#endif
}

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float first = texelFetch(t_first, pixel, 0).r;
  bool inside = u_eyeOverGroundM < v_heightM;
  vec3 seen = vec3(0.0);
  if (inside || first > 0.0) {
    vec3 random = pixelRandom(pixel);
    float levelJitter = (1.0 + random.z) * kLevelBias;
    float lot = pixelRandom(pixel / kLotPixels).x;
    float next = inside ? first : texelFetch(t_second, pixel, 0).r;
    // Without a next entry that is far enough behind to be told apart, the first is the last.
    bool last = next <= 0.0 && d.z < -kMeshHorizon;
    float enter = inside ? 0.0 : first;
    for (int i = 0; i < 2; ++i) {
      bool soilSeen;
      seen += marchTerrain(d, enter, last, random, levelJitter, lot, soilSeen);
      if (soilSeen || g_transmittance <= 0.0 || next <= 0.0) break;
      enter = next;
      last = true;
    }
  }
#if SWARD_MODE
  o_radiance = vec4(seen * v_exposure, (1.0 - g_transmittance) * u_sampleWeight);
#else
  if (g_transmittance > 0.0) seen += g_transmittance * (skyRadiance(d) + sunDisc(d));
  o_radiance = vec4(seen * v_exposure, 1.0);
#endif
}
#else
void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 random = pixelRandom(pixel);
  float levelJitter = (1.0 + random.z) * kLevelBias;
  Walk walk = startWalk(d);
#if SWARD_FAMILIES == 1 || SWARD_FAMILIES == 2 || SWARD_FAMILIES == 4
  ivec2 family = ivec2(SWARD_FAMILIES == 1 ? 0 : 1, SWARD_FAMILIES == 2 ? 0 : 1);
#else
  // One lot for a few pixels: processors that run these together then walk through one family.
  ivec2 family = chooseFamily(d, pixelRandom(pixel / kLotPixels).x);
#endif

#if SWARD_SLICES
  Level layered = sliceLevel(walk.footprint, random, levelJitter);
  marchSlices(walk, layered, family.x == 0 ? walk.tEnd : -1.0, fourthRandom(random));
#endif
#if SWARD_BLADES
  Level bladed = bladeLevel(walk.footprint, random, levelJitter);
  marchBlades(walk, bladed, family.y == 0, family.x == 1 ? walk.tEnd : -1.0, random.y);
#endif

  // What little an opaque ray has left is given to what it saw.
  bool opaque = g_transmittance <= kTransmittanceEnd;
  vec3 radiance = g_sum * (kColourUnit / (opaque ? 1.0 - g_transmittance : 1.0));
  float left = opaque ? 0.0 : g_transmittance;
#if SWARD_FAMILIES == 1
  Level soilLevel = layered;
#else
  Level soilLevel = soilLevelOf(walk, random, levelJitter);
#endif
  o_radiance = finishGround(walk, d, radiance, left, soilLevel, random);
}
#endif
