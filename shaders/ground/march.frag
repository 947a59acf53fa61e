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

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  vec3 random = pixelRandom(ivec2(gl_FragCoord.xy));
  float levelJitter = (1.0 + random.z) * kLevelBias;
  Walk walk = startWalk(d);
  // Independent of each of the three alone.
  ivec2 family = chooseFamily(d, fract(random.x + random.z));

  Planes planes;
#if SWARD_SLICES
  Level layered = sliceLevel(walk.footprint, random, levelJitter);
  vec2 slicePlace = walk.place + layered.jitter;
  planes = slicePlanes(walk);
#endif
#if SWARD_BLADES
  Level blades = bladeLevel(walk.footprint, random, levelJitter);
  bool axisX = family.y == 0;
  BladeWalk along = startBlades(walk, blades, axisX, random.y);
#if SWARD_SLICES
  bool sliced = family.x == 0;
  planes.t = sliced ? planes.t : along.planes.t;
  planes.stride = sliced ? planes.stride : along.planes.stride;
  planes.number = sliced ? planes.number : along.planes.number;
  planes.step = sliced ? planes.step : along.planes.step;
  planes.power = sliced ? planes.power : along.planes.power;
#else
  planes = along.planes;
#endif
#endif

  float transmittance = 1.0;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kMaxSteps; ++i) {
    if (planes.t >= walk.tEnd || transmittance <= kTransmittanceEnd) break;
    // One map word and one texel are fetched, whatever the family.
#if SWARD_BLADES
    Site site = bladeSite(blades, axisX, planes.number, along.place + along.slope * planes.t,
                          along.row + along.rowSlope * planes.t);
    int start = along.start;
    int planesPerTile = u_slabs;
    int area = blades.area;
    bool mean = blades.mean;
#endif
#if SWARD_SLICES
    Site sliceAt = sliceSite(layered, int(planes.number), slicePlace + walk.slope * planes.t);
#if SWARD_BLADES
    site.cell = sliced ? sliceAt.cell : site.cell;
    site.plane = sliced ? sliceAt.plane : site.plane;
    site.within = sliced ? sliceAt.within : site.within;
    start = sliced ? layered.start : start;
    planesPerTile = sliced ? u_sliceLayers : planesPerTile;
    area = sliced ? layered.area : area;
    mean = sliced ? layered.mean : mean;
#else
    Site site = sliceAt;
    int start = layered.start;
    int planesPerTile = u_sliceLayers;
    int area = layered.area;
    bool mean = layered.mean;
#endif
#endif
    uint stored = fetchSite(site, start, planesPerTile, area, mean);
    float opacity = kOpaque * kCoverageUnit * storedCoverage(stored);
#if SWARD_FAMILIES == 1
    float through = nearUnitPower(opacity, planes.power);
#else
    float through = fastPower(1.0 - opacity, planes.power);
#endif
    sum += transmittance * (1.0 - through) * storedColour(stored);
    transmittance *= through;
    planes.t += planes.stride;
    planes.number += planes.step;
  }

  // What little an opaque ray has left is given to what it saw.
  bool opaque = transmittance <= kTransmittanceEnd;
  vec3 radiance = sum * (kColourUnit / (opaque ? 1.0 - transmittance : 1.0));
  float left = opaque ? 0.0 : transmittance;
#if SWARD_FAMILIES == 1
  Level soilLevel = layered;
#else
  Level soilLevel = soilLevelOf(walk, random, levelJitter);
#endif
  o_radiance = finishGround(walk, d, radiance, left, soilLevel, random);
}
