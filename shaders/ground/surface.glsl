// What march and blending share: the ray in the shell's coordinates, weights of the families, macro variation, haze.
#ifndef SWARD_TERRAIN
#define SWARD_TERRAIN 0
#endif
uniform samplerBuffer t_horizon;  // sky radiance at the horizon by the azimuth's diamond angle

// A ray's way through the shell. Distances count from where it starts to look, places from the stored map's corner.
struct Walk {
  vec2 place;       // in tiles, where it starts
  vec2 slope;       // tiles a metre
  vec2 bend;        // phases of the waves that shift x and y, where it starts
  float slopeZ;     // of the height, within the shell, at least kLeastSlope
  float path;       // 1 / |slopeZ|
  float heightM;    // where it starts
  float tEnter;     // from the eye to the shell; 0 inside
  float tStart;     // from the eye to where it starts
  float tEnd;       // to the soil or the shell's top; negative for rays that miss the shell
  float footprint;  // of a pixel, a little way into the shell, metres
};

// A wave that shifts tiles along an axis by their place on the other, so that rows of tiles do not run straight to a
// vanishing point; a smoothed triangle stands for the sine.
float gridBend(float turns) {
  float triangle = abs(fract(turns) - 0.5) * 4.0 - 1.0;
  return v_gridBendTiles * triangle * (1.5 - 0.5 * triangle * triangle);
}

Walk startWalk(vec3 d) {
  Walk walk;
#if SWARD_SKY
  walk.slopeZ = d.z < 0.0 ? min(d.z, -1e-5) : max(d.z, 1e-5);
#else
  walk.slopeZ = min(d.z, -1e-5);
#endif
  bool above = v_eyeM > v_heightM;
  bool down = walk.slopeZ < 0.0;
  walk.slope = d.xy * v_tilesPerM;
  walk.tEnter = above && down ? (v_heightM - v_eyeM) / walk.slopeZ : 0.0;
  walk.tStart = max(walk.tEnter, kNearestM);
  walk.heightM = v_eyeM + walk.slopeZ * walk.tStart;
  walk.slopeZ = down ? min(walk.slopeZ, -kLeastSlope) : max(walk.slopeZ, kLeastSlope);
  walk.path = 1.0 / abs(walk.slopeZ);
  walk.tEnd = above && !down ? -1.0 : (down ? walk.heightM : v_heightM - walk.heightM) * walk.path;
  vec2 tiles = v_eyeTiles + walk.slope * walk.tStart;
  walk.place = mapPlace(tiles);
  walk.bend = tiles.yx * v_bendTurns + v_bendPhase;
  walk.footprint = (walk.tEnter + min(kLevelShare * max(walk.tEnd, 0.0), kLevelReachM)) * v_pixelAngle;
  return walk;
}

// Slices (x = 0) or blades (x = 1), and those normal to x (y = 0) or to y (y = 1): drawn by lot with the weights.
ivec2 chooseFamily(vec3 d, float lot) {
  float steep = smoothstep(v_slicesFrom, v_slicesAll, abs(d.z));
  float towardX = abs(d.x) / max(abs(d.x) + abs(d.y), 1e-6);
  float x = smoothstep(0.5 - kDiagonalFade, 0.5 + kDiagonalFade, towardX);
#if !(SWARD_FAMILIES & 1)
  steep = 0.0;
#endif
#if (SWARD_FAMILIES & 6) == 2
  x = 1.0;
#elif (SWARD_FAMILIES & 6) == 4
  x = 0.0;
#endif
  bool slices = lot < steep;
  float rest = (lot - steep) / max(1.0 - steep, 1e-6);
  return ivec2(slices ? 0 : 1, rest < x ? 0 : 1);
}

// Planes of a family along a walk: distance of the next and between two, its place on the normal and the step to the
// one after it (slices: layers; blades: tiles), and what turns a stored texel to optical depth: path over slab
// thickness, times slabs in a step.
struct Planes {
  float t;
  float stride;
  float place;
  float step;
  float depthUnit;
};

// `random` says where within their slabs the planes lie.
Planes slicePlanes(Walk walk, float random) {
  float spacing = v_heightM / float(v_sliceLayers - 1);
  float under = (v_heightM - walk.heightM) / spacing;  // slabs under the top
  float depth = 0.5 + clamp(kSlabSpreadM / spacing, kLeastSlabSpread, 1.0) * (random - 0.5);
  bool down = walk.slopeZ < 0.0;
  Planes planes;
  planes.stride = spacing * walk.path;
  planes.step = down ? 1.0 : -1.0;
  planes.place = down ? ceil(under - depth) : floor(under - depth);
  planes.t = (planes.place + depth - under) * planes.step * planes.stride;
  planes.depthUnit = walk.path * kDepthUnit;
  return planes;
}

#if SWARD_TERRAIN
float g_rowBend = 0.0;  // of the height over the ground, 1 / metres, while blades are marched
#endif

// A walk through blades: its planes, where along them it starts and its slopes, the first texel of their level.
struct BladeWalk {
  Planes planes;
  float place;
  float slope;
  float row;
  float rowSlope;
  float bend;      // phase of the wave that shifts the planes along themselves, each plane as a whole
  float bendSlope;
  int start;
};


// Where slices and soil are read: nearly straight below where the ray enters, one shift serves the whole ray.
vec2 slicePlace(Walk walk, Level level) {
  return walk.place + level.jitter + vec2(gridBend(walk.bend.x), gridBend(walk.bend.y));
}

BladeWalk startBlades(Walk walk, Level level, bool axisX, float random) {
  float slope = axisX ? walk.slope.x : walk.slope.y;  // along the normal
  float place = axisX ? walk.place.x : walk.place.y;
  bool backward = slope < 0.0;
  float rate = max(abs(slope), 1e-6) * float(v_slabs);  // slabs a metre
  // Where the ray sinks by less than a few pixels between two slabs, it may skip some.
  float wanted = min(kStridePixels * v_pixelAngle * walk.tEnter, v_heightM / kHeightSteps) * walk.path;
  float slabs = max(1.0, floor(wanted * rate));
  float at = place * float(v_slabs);
  float ahead = backward ? at - floor(at - 0.5) - 0.5 : ceil(at - 0.5) + 0.5 - at;
  ahead += floor(random * slabs);
  BladeWalk blades;
  blades.planes.step = (backward ? -slabs : slabs) / float(v_slabs);
  blades.planes.stride = slabs / rate;
  blades.planes.t = ahead / rate;
  // The middle of a slab, found anew so that no rounding pushes it over a slab's border.
  blades.planes.place = (floor(backward ? at - ahead : at + ahead) + 0.5) / float(v_slabs);
  blades.planes.depthUnit = blades.planes.stride * v_slabsPerM * kDepthUnit;
  blades.place = (axisX ? walk.place.y : walk.place.x) + level.jitter.x;
  blades.slope = axisX ? walk.slope.y : walk.slope.x;
  blades.bend = axisX ? walk.bend.y : walk.bend.x;
  blades.bendSlope = slope * v_bendTurns;
  float rowsPerM = level.rows / v_heightM;
  blades.row = walk.heightM * rowsPerM + level.jitter.y;
  blades.rowSlope = walk.slopeZ * rowsPerM;
  uint first = axisX ? (backward ? v_bladeBase[0] : v_bladeBase[1]) : (backward ? v_bladeBase[2] : v_bladeBase[3]);
  blades.start = level.start + int(first);
  return blades;
}

// What a ray meets at `t` in the plane through `across`.
uint fetchAlong(BladeWalk blades, Level level, bool axisX, float across, float t) {
  float along = blades.place + blades.slope * t + gridBend(blades.bend + blades.bendSlope * t);
  float row = blades.row + blades.rowSlope * t;
#if SWARD_TERRAIN
  row = clamp(row + 0.5 * g_rowBend * (level.rows / v_heightM) * t * t, -0.5, level.rows - 0.5);
#endif
  return fetchBlade(level, blades.start, axisX, across, along, row);
}

Level soilLevelOf(Walk walk, vec3 random, float levelJitter) {
  float slant = mix(1.0, walk.path, kSoilLevelSlant);
  return sliceLevel((walk.tStart + walk.tEnd) * v_pixelAngle * slant, random, levelJitter);
}

// Smooth brightness and hue over metres, from the upper bytes of the map's cells (render/macro_map.h), 128 the mean;
// fading where a pixel covers its waves. Cells differ little, a jittered place blends them.
vec3 macroTint(vec2 place, float distanceM, vec3 random) {
  uint word = mapWord(floor(place + random.yx - 0.5));
  float fade = max(1.0 - distanceM * v_macroFadePerM, 0.0) / 128.0;
  vec2 v = (vec2(float((word >> 8) & 0xffu), float((word >> 16) & 0xffu)) - 128.0) * fade;
  return (1.0 + v.x) * vec3(1.0 + kHueVariation * v.y, 1.0, 1.0 - 2.0 * kHueVariation * v.y);
}

vec3 throughHaze(vec3 radiance, vec3 d, float distanceM, float random) {
  float clear = exp(-v_hazePerM * distanceM);
  vec3 horizon = texelFetch(t_horizon, int((diamondAngle(d.xy) + 0.25) * kHorizonTexels + random)).rgb;
  return mix(horizon, radiance, clear);
}

#if SWARD_MODE
#include "ground/finish_mode.glsl"
#else
// The picture of a ray that gathered `radiance` (over the relight scale) in the shell and has `left` of its
// transmittance: soil or sky behind, macro variation, haze, exposure.
vec4 finishGround(Walk walk, vec3 d, vec3 radiance, float left, Level soilLevel, vec3 random) {
  vec2 foot = slicePlace(walk, soilLevel) + walk.slope * max(walk.tEnd, 0.0);
  vec3 soil = storedColour(fetchSlice(soilLevel, layerStart(soilLevel, v_sliceLayers - 1), foot));
#if SWARD_SKY
  bool soilSeen = walk.slopeZ < 0.0;
#else
  const bool soilSeen = true;
#endif
  radiance += soilSeen ? left * kColourUnit * soil : vec3(0.0);
  vec3 grass = radiance * macroTint(walk.place, walk.tEnter, random) * v_relightScale;
#if SWARD_SKY
  // Rays that reach the sky start in the shell: what they crossed of it is too near for haze.
  vec3 seen = soilSeen ? throughHaze(grass, d, walk.tEnter, random.x) : grass + left * (skyRadiance(d) + sunDisc(d));
#else
  vec3 seen = throughHaze(grass, d, walk.tEnter, random.x);
#endif
  return vec4(seen * v_exposure, 1.0);
}
#endif
