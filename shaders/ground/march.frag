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
#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"
#include "ground/texels.glsl"
#include "ground/surface.glsl"

#define SWARD_SLICES (SWARD_FAMILIES & 1)
#define SWARD_BLADES (SWARD_FAMILIES & 6)

out vec4 o_radiance;

float g_transmittance = 1.0;
vec3 g_sum = vec3(0.0);  // in kColourUnit

void composite(uint stored, float depthUnit) {
  float through = transmitted(storedDepth(stored, depthUnit));
  g_sum += g_transmittance * (1.0 - through) * storedColour(stored);
  g_transmittance *= through;
}

#if SWARD_SLICES
void marchSlices(Walk walk, Level level, float tEnd, float random) {
  Planes planes = slicePlanes(walk, random);
  vec2 place = slicePlace(walk, level);
  for (int i = 0; i < kMaxSteps; ++i) {
    if (planes.t >= tEnd || g_transmittance <= kTransmittanceEnd) break;
    Site site = sliceSite(level, int(planes.place), place + walk.slope * planes.t);
    uint stored = fetchSite(site, level.start, v_sliceLayers, level.area, level.mean);
    composite(stored, planes.depthUnit);
    planes.t += planes.stride;
    planes.place += planes.step;
  }
}
#endif

#if SWARD_BLADES
void marchBlades(Walk walk, Level level, bool axisX, float tEnd, float random) {
  BladeWalk blades = startBlades(walk, level, axisX, random);
  Planes planes = blades.planes;
  for (int i = 0; i < kMaxSteps; ++i) {
    if (planes.t >= tEnd || g_transmittance <= kTransmittanceEnd) break;
    Site site = bladeSite(level, axisX, planes.place, alongAt(blades, planes.t), blades.row + blades.rowSlope * planes.t);
    uint stored = fetchSite(site, blades.start, v_slabs, level.area, level.mean);
    composite(stored, planes.depthUnit);
    planes.t += planes.stride;
    planes.place += planes.step;
  }
}
#endif

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
