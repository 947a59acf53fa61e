// The layer march (science.md section 3, ours): from the shell's top front to back through the planes of up to three
// families, in the order in which the ray meets them, until it is opaque; then the soil.
//
// A slab of family f crossed by a ray of direction d takes the texel's optical depth times w_f / |d_f|: its path is
// 1/|d_f| longer than the perpendicular one the texel was sampled with, and the weights share the medium out among the
// families. In a uniform medium the sum over all planes is then extinction times path, whatever the weights.
//
// SWARD_FAMILIES: 1 slices, 2 blades normal to x, 4 normal to y; SWARD_SKY: some rays end in the sky. Blocks of the
// screen are drawn by the variant that has what they need.
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
  float levelJitter = (1.0 + random.z) * kLevelBias;
#if SWARD_SKY
  float slopeZ = d.z < 0.0 ? min(d.z, -1e-5) : max(d.z, 1e-5);
#else
  float slopeZ = min(d.z, -1e-5);
#endif

  bool above = u_eyeM > u_heightM;
  bool hits = slopeZ < 0.0 || !above;
  float inverseSlope = 1.0 / slopeZ;
  float tEnter = above ? (u_heightM - u_eyeM) * inverseSlope : 0.0;
  float tExit = ((slopeZ < 0.0 ? 0.0 : u_heightM) - u_eyeM) * inverseSlope;
  float tEnd = hits ? tExit : -1.0;
  float path = abs(inverseSlope);
  vec2 slope = d.xy * u_tilesPerM;
  float footprintEnter = tEnter * u_pixelAngle;
  float footprint = footprintEnter + min(kLevelShare * (tExit - tEnter), kLevelReachM) * u_pixelAngle;
  #if SWARD_FAMILIES == 1 || SWARD_FAMILIES == 2 || SWARD_FAMILIES == 4
  const vec3 weights = vec3(1.0);
#else
  vec3 weights = familyWeights(d);
#endif

#if SWARD_FAMILIES & 1
  Level layered = sliceLevel(footprint, random, levelJitter);
  int layers = u_sliceLayers - 1;
  float spacing = u_heightM / float(layers);
  Planes slices;
  slices.stride = spacing * path;
  slices.step = slopeZ < 0.0 ? 1.0 : -1.0;
  float heightEnter = (u_heightM - (u_eyeM + slopeZ * tEnter)) / spacing;  // slabs under the top
  slices.number = slopeZ < 0.0 ? ceil(heightEnter - 0.5) : floor(heightEnter - 0.5);
  slices.t = tEnter + (slices.number + 0.5 - heightEnter) * slices.step * slices.stride;
  slices.power = weights.x * path;
#endif
#if SWARD_FAMILIES & 6
  Level blades = bladeLevel(footprint, random, levelJitter);
  // Where the ray sinks by less than a pixel between two slabs, it may skip some.
  float wantedStride = min(footprintEnter, u_heightM / kHeightSteps) * path;
  float tBlades = max(tEnter, kNearestBladeM);
#endif
#if SWARD_FAMILIES & 2
  Planes bladesX = bladePlanes(u_eyeTiles.x, slope.x, tBlades, wantedStride, weights.y, random.y);
  int startX = blades.start + int(slope.x < 0.0 ? u_bladeBase[0] : u_bladeBase[1]);
#endif
#if SWARD_FAMILIES & 4
  Planes bladesY = bladePlanes(u_eyeTiles.y, slope.y, tBlades, wantedStride, weights.z, random.x);
  int startY = blades.start + int(slope.y < 0.0 ? u_bladeBase[2] : u_bladeBase[3]);
#endif

  float transmittance = 1.0;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < kMaxSteps; ++i) {
    float t = 1e30;
    bool slice = false;
    bool axisX = false;
#if SWARD_FAMILIES & 1
    t = slices.t;
    slice = true;
#endif
#if SWARD_FAMILIES & 2
    axisX = bladesX.t < t;
    t = min(t, bladesX.t);
#endif
#if SWARD_FAMILIES & 4
    bool axisY = bladesY.t < t;
    axisX = axisX && !axisY;
    t = min(t, bladesY.t);
    slice = slice && !axisY;
#endif
    slice = slice && !axisX;
    if (t >= tEnd || transmittance <= kTransmittanceEnd) break;
    vec2 xy = u_eyeTiles + slope * t;

    // One map and one texel are fetched, whatever the family: the families' places are computed and one is chosen.
    Site site;
    int start, planesPerTile, area;
    bool mean;
    float power;
#if SWARD_FAMILIES & 6
    float height = (u_eyeM + slopeZ * t) / u_heightM;
#if (SWARD_FAMILIES & 6) == 2
    const bool onX = true;
    float number = bladesX.number;
    start = startX;
    power = bladesX.power;
#elif (SWARD_FAMILIES & 6) == 4
    const bool onX = false;
    float number = bladesY.number;
    start = startY;
    power = bladesY.power;
#else
    bool onX = axisX;
    float number = axisX ? bladesX.number : bladesY.number;
    start = axisX ? startX : startY;
    power = axisX ? bladesX.power : bladesY.power;
#endif
    site = bladeSite(blades, onX, number, onX ? xy.y : xy.x, height);
    planesPerTile = u_slabs;
    area = blades.area;
    mean = blades.mean;
#endif
#if SWARD_FAMILIES & 1
    Site sliced = sliceSite(layered, int(slices.number), xy);
#if SWARD_FAMILIES == 1
    site = sliced;
    start = layered.start;
    planesPerTile = u_sliceLayers;
    area = layered.area;
    mean = layered.mean;
    power = slices.power;
#else
    site.cell = slice ? sliced.cell : site.cell;
    site.plane = slice ? sliced.plane : site.plane;
    site.within = slice ? sliced.within : site.within;
    start = slice ? layered.start : start;
    planesPerTile = slice ? u_sliceLayers : planesPerTile;
    area = slice ? layered.area : area;
    mean = slice ? layered.mean : mean;
    power = slice ? slices.power : power;
#endif
    slices.t += slice ? slices.stride : 0.0;
    slices.number += slice ? slices.step : 0.0;
#endif
#if SWARD_FAMILIES & 2
    bladesX.t += axisX ? bladesX.stride : 0.0;
    bladesX.number += axisX ? bladesX.step : 0.0;
#endif
#if SWARD_FAMILIES & 4
    bladesY.t += axisY ? bladesY.stride : 0.0;
    bladesY.number += axisY ? bladesY.step : 0.0;
#endif
    uint stored = fetchSite(site, start, planesPerTile, area, mean);
    float through = fastPower(1.0 - kOpaque * kCoverageUnit * storedCoverage(stored), power);
    sum += transmittance * (1.0 - through) * storedColour(stored);
    transmittance *= through;
  }

  // What little an opaque ray has left is given to what it saw.
  bool opaque = transmittance <= kTransmittanceEnd;
  vec3 radiance = sum * (kColourUnit / (opaque ? 1.0 - transmittance : 1.0));
  float left = opaque ? 0.0 : transmittance;
#if SWARD_SKY
  bool soilSeen = slopeZ < 0.0;
#else
  const bool soilSeen = true;
#endif
#if SWARD_FAMILIES == 1
  Level soilLevel = layered;
#else
  Level soilLevel = sliceLevel(tExit * u_pixelAngle * mix(1.0, path, kSoilLevelSlant), random, levelJitter);
#endif
  Site soilSite = sliceSite(soilLevel, u_sliceLayers - 1, u_eyeTiles + slope * tExit);
  vec3 soil = storedColour(fetchSite(soilSite, soilLevel.start, u_sliceLayers, soilLevel.area, soilLevel.mean));
  radiance += soilSeen ? left * kColourUnit * soil : vec3(0.0);

  float depth = hits ? tEnter : 0.0;
  vec3 grass = radiance * macroTint(u_eyeTiles + slope * depth, depth, random) * u_relightScale;
#if SWARD_SKY
  // Rays that reach the sky start in the shell: what they crossed of it is too near for haze.
  left = soilSeen ? 0.0 : left;
  vec3 seen = soilSeen ? throughHaze(grass, d, depth, random.x) : grass + left * (skyRadiance(d) + sunDisc(d));
#else
  vec3 seen = throughHaze(grass, d, depth, random.x);
#endif
  o_radiance = vec4(seen * u_exposure, 1.0);
}
