// A meadow of texels (science.md section 4): from the shell's top front to back through the voxels of a block that
// repeats over the ground, past empty bricks in one step, until the ray is opaque; then the soil. The light came on the
// processor (core/wither/texel_light.h); leaves show the side that faces the eye, tangents a highlight.
#ifndef SWARD_TERRAIN
#define SWARD_TERRAIN 0
#endif
// Of the layers' shaders the ray, the macro variation and the haze serve here too: a texel is a tile.
#define SWARD_FAMILIES 1
#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"
#include "ground/texels.glsl"
#include "ground/surface.glsl"
#if SWARD_TERRAIN
#include "ground/terrain.glsl"
#else
uniform vec3 u_sunIrradiance;
#endif

// Of all levels, as render/texel_set.h describes them.
uniform isamplerBuffer t_bricks;
uniform usamplerBuffer t_voxels;
uniform usamplerBuffer t_glosses;
uniform usamplerBuffer t_soil;

uniform int u_levels;
uniform uint u_levelStart[8];       // in t_bricks
uniform int u_columns;             // of level 0
uniform int u_layers;
uniform float u_extinctionRange;   // 1/m, of a stored extinction of 1
uniform float u_radianceRange;
// Means over the leaves, by wither/leaf_phase.h: of each level those that face every way; of all what they let through
// over what they reflect, and the sun's part of their radiance.
uniform float u_unordered[8];
uniform vec3 u_passed;
uniform vec3 u_sunPart;
uniform float u_highlight;         // its radiance over the sun's irradiance at full gloss

out vec4 o_radiance;

const float kPi = 3.14159265;
const float kLevelBiasTexels = 0.8;
const float kCellJitter = 0.7;     // tiles, of the places that cells are round
const float kCellBlurM = 0.06;     // width of the borders between cells
const float kCellReachM = 0.3;     // how far into the shell a ray is likely to end, at most
const float kBendReach = 2.0;      // how many times as far as it is looked for a bend of the ground may lead
const float kStride = 1.0;         // voxels between two places that a ray looks at
const float kStrideGrowth = 1.5;   // and so many more where it is nearly opaque

vec3 g_sum = vec3(0.0);   // over the range of radiances
float g_left = 1.0;

// Unit vector of two bytes (octahedral); zero for 0.
vec3 direction16(uint bits) {
  if (bits == 0u) return vec3(0.0);
  vec2 p = (vec2(float(bits & 0xffu), float((bits >> 8) & 0xffu)) - 128.0) / 127.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

// Ten bits a channel, the square root over the range.
vec3 colour30(uint bits) {
  vec3 root = vec3(float(bits & 0x3ffu), float((bits >> 10) & 0x3ffu), float((bits >> 20) & 0x3ffu)) / 1023.0;
  return root * root;
}

// A medium's normal, times 127 and of any length.
vec3 mediumNormal(uint word) {
  vec2 p = vec2(float(word & 0xffu), float((word >> 8) & 0xffu)) - 128.0;
  return vec3(p, 127.0 - abs(p.x) - abs(p.y));
}

// Five, six and five bits, the square root over the range.
vec3 colour16(uint bits) {
  vec3 root = vec3(float(bits & 31u), float((bits >> 5) & 63u), float((bits >> 11) & 31u));
  root *= vec3(1.0 / 31.0, 1.0 / 63.0, 1.0 / 31.0);
  return root * root;
}

// Highlight of the leaf at a place, over the range of radiances. Kajiya and Kay: the cone about the tangent on which the
// sun's light is reflected.
vec3 highlight(int place, vec3 d) {
  uint word = texelFetch(t_glosses, place).r;
  vec3 tangent = direction16(word & 0xffffu);
  vec2 along = vec2(dot(tangent, -d), dot(tangent, u_sunDirection));
  vec2 across = sqrt(max(1.0 - along * along, 0.0));
  float gloss = tangent == vec3(0.0) ? 0.0 : float(word >> 16) / 255.0;
  float c = max(across.x * across.y - along.x * along.y, 0.0);
  c *= c * c;  // to the power 24
  c *= c;
  c *= c;
  c *= c;
  return u_sunIrradiance * (gloss * u_highlight * c / u_radianceRange);
}

// By how much leaves that face every way are brighter than in the mean over all eyes (wither/leaf_phase.h).
vec3 leafPhase(vec3 d, int level) {
  float c = clamp(-dot(d, u_sunDirection), -1.0, 1.0);
  float b = acos(c);
  float s = sqrt(1.0 - c * c);
  vec2 seen = vec2((kPi - b) * c + s, s - b * c) * (8.0 / (3.0 * kPi));
  vec3 phase = (seen.x + u_passed * seen.y) / (1.0 + u_passed);
  return 1.0 + u_unordered[level] * u_sunPart * (phase - 1.0);
}

// A level's voxels along a ray.
struct Grid {
  int start;     // in t_bricks
  int row;       // bricks
  float columns;
  vec3 p;        // where t is 0, voxels
  vec3 dv;       // voxels a metre
  float bend;    // of the height, half the second derivative, voxels a squared metre
  float top;     // highest place in the block
};

// From 0 to tEnd in strides, each of the length of a voxel or some, until the ray is opaque: `lot` in [0, 1) says where
// in its stride the ray looks, so that the mean of many samples sees every voxel by the length that lies in it.
// Highlights cost as much as all the rest: those of eight leaves alone are looked at, drawn by the shares that they have
// in the picture.
void marchVoxels(Grid grid, vec3 d, float tEnd, float lot, float otherLot, vec3 phase) {
  float perColumn = 1.0 / grid.columns;
  float range = u_extinctionRange;
  float unit = kStride / length(grid.dv);
  float t = 0.0;
  float before = g_left;
  vec4 firstPicks = before * (1.0 - 0.125 * (vec4(0.0, 1.0, 2.0, 3.0) + otherLot));
  vec4 lastPicks = firstPicks - 0.5 * before;
  ivec4 firstPicked = ivec4(0), lastPicked = ivec4(0);
  while (t < tEnd && g_left > kTransmittanceEnd) {
    float stride = unit * (1.0 + kStrideGrowth * (1.0 - g_left));
    float look = t + lot * stride;
    vec3 at = grid.p + grid.dv * look;
    at.z = clamp(at.z + grid.bend * look * look, 0.0, grid.top);
    vec3 cell = floor(at);
    vec2 wrapped = cell.xy - grid.columns * floor((cell.xy + 0.5) * perColumn);
    ivec3 voxel = ivec3(wrapped, cell.z);
    ivec3 brick = voxel >> 3;
    int first = texelFetch(t_bricks, grid.start + (brick.z * grid.row + brick.y) * grid.row + brick.x).r;
    ivec3 cube = (voxel & 6) << ivec3(2, 4, 6);
    ivec3 corner = (voxel & 1) << ivec3(0, 1, 2);
    int place = max(first, 0) + cube.x + cube.y + cube.z + corner.x + corner.y + corner.z;
    uint word = first < 0 ? 0u : texelFetch(t_voxels, 2 * place).r;
    // wither/extinction.h: a spheroid about the normal.
    vec3 normal = mediumNormal(word);
    float facing = dot(normal, d);
    float across = float((word >> 16) & 0xffu) * (1.0 / 255.0);
    float root = float(word >> 24) * (1.0 / 255.0);
    across *= across;
    float extinction = root * root * range * sqrt(across + (1.0 - across) * facing * facing / dot(normal, normal));
    uint leaf = texelFetch(t_voxels, 2 * place + 1).r >> (facing <= 0.0 ? 0 : 16);
    float left = g_left * transmitted(look < tEnd ? extinction * stride : 0.0);
    g_sum += (g_left - left) * colour16(leaf);
    firstPicked = mix(firstPicked, ivec4(place), greaterThanEqual(vec4(g_left), firstPicks));
    lastPicked = mix(lastPicked, ivec4(place), greaterThanEqual(vec4(g_left), lastPicks));
    g_left = left;
    // Over an empty cube of bricks in whole strides: the places that a ray looks at stay even.
    int power = -min(first + 1, 0);
    vec3 along = vec3(grid.dv.xy, grid.dv.z + 2.0 * grid.bend * look);
    vec3 face = floor(cell * intBitsToFloat((127 - power) << 23)) + step(0.0, along);
    vec3 exits = (face * intBitsToFloat((127 + power) << 23) - at) / along;
    float way = first < 0 ? min(exits.x, min(exits.y, exits.z)) : 0.0;
    t += stride * max(ceil(way / stride), 1.0);
  }
  // What little an opaque ray has left is given to what it saw.
  if (g_left <= kTransmittanceEnd) {
    g_sum *= before / max(before - g_left, 1e-6);
    g_left = 0.0;
  }
  g_sum *= phase;
  for (int i = 0; i < 4; ++i) {
    if (g_left < firstPicks[i]) g_sum += 0.125 * before * highlight(firstPicked[i], d);
    if (g_left < lastPicks[i]) g_sum += 0.125 * before * highlight(lastPicked[i], d);
  }
}

// The texel alone repeats at its side, which shows far away as rows. So the ground is cut into cells of about a texel,
// around places that are shifted at random (Worley 1996), and each cell shows another part of the texel (in the spirit of
// Heitz and Neyret 2018, who blend). A ray has one cell, that over which it is likely to end; blurring its place by the
// sample's lot lets leaves of both sides mix on borders. Only the nearest four places are looked at: what lies outside
// them shifts a border. The light is that of the texel, hence no turns. `place` in tiles; gives a shift in tiles.
vec2 cellShift(vec2 place) {
  vec2 corner = floor(place - 0.5);
  float nearest = 1e9;
  uvec2 chosen = uvec2(0u);
  for (int i = 0; i < 4; ++i) {
    vec2 cell = corner + vec2(float(i & 1), float(i >> 1));
    vec2 wrapped = cell - v_mapSize * floor((cell + 0.5) * v_mapInverse);
    uvec2 v = uvec2(wrapped) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    vec2 off = cell + 0.5 + kCellJitter * (vec2(v & 0xffffu) / 65536.0 - 0.5) - place;
    float far = dot(off, off);
    chosen = far < nearest ? v : chosen;
    nearest = min(nearest, far);
  }
  return vec2(chosen >> 16u) / 65536.0;
}

// What a walk through the shell gathers, and the soil where it ends on it: radiance before the macro variation.
// `bend`: second derivative of its height, 1 / metres.
vec3 marchShell(Walk walk, vec3 d, float bend, bool soilSeen, vec3 random) {
  float tEnd = walk.tEnd;
  float before = g_left;
  g_sum = vec3(0.0);
  float voxels = walk.footprint * float(u_columns) * v_tilesPerM;
  int level = clamp(mipLevel(voxels, (1.0 + random.z) * kLevelBiasTexels), 0, u_levels - 1);
  int columns = u_columns >> level;
  float layers = float(u_layers >> level);
  vec2 place = walk.place;
  if (v_gridBendTiles > 0.0) {
    float reach = min(0.5 * max(tEnd, 0.0), kCellReachM);
    vec2 blur = vec2(fourthRandom(random), fract(random.y + random.z)) - 0.5;
    place += cellShift(place + (d.xy * reach + blur * kCellBlurM) * v_tilesPerM);
  }
  place = fract(place);
  if (tEnd > 0.0) {
    vec3 perM = vec3(vec2(float(columns)) * v_tilesPerM, layers / v_heightM);
    Grid grid;
    grid.start = int(u_levelStart[level]);
    grid.row = columns >> 3;
    grid.columns = float(columns);
    // A voxel's box, shifted anew for every sample: their mean has no blocks.
    grid.p = vec3(place * grid.columns, walk.heightM * perM.z) + random - 0.5;
    grid.dv = vec3(d.xy, walk.slopeZ) * perM;
    grid.bend = 0.5 * bend * perM.z;
    grid.top = layers - 1e-3;
    marchVoxels(grid, d, tEnd, fourthRandom(random), fract(random.x + random.y), leafPhase(d, level));
  }
  vec3 radiance = g_sum;
  if (soilSeen && g_left > kTransmittanceEnd) {
    vec2 foot = fract(place + d.xy * (max(tEnd, 0.0) * v_tilesPerM));
    ivec2 column = clamp(ivec2(foot * float(u_columns)), ivec2(0), ivec2(u_columns - 1));
    radiance += g_left * colour30(texelFetch(t_soil, column.y * u_columns + column.x).r);
    g_left = 0.0;
  }
  return radiance * u_radianceRange * macroTint(walk.place, walk.tEnter, random);
}

#if SWARD_TERRAIN
// `within`: it is in the shell there, at a height that is not known: the middle stands for it.
// `leaveM`: where it comes out of the shell's top, as far as the ground's bend tells.
vec3 marchTerrain(vec3 d, float enterM, bool last, bool within, vec3 random, out bool soilSeen,
                  out float leaveM) {
  TerrainWalk w = startTerrain(d, enterM, last);
  if (within) w.walk.heightM *= 0.5;
  if (within) w.walk.tEnd *= 0.5;
  soilSeen = w.soilSeen;
  // The bend is that of the next metres: farther on it says nothing.
  if (!soilSeen) w.walk.tEnd = min(w.walk.tEnd, kBendReach * max(v_heightM * w.walk.path, u_lookAheadM));
  leaveM = w.walk.tStart + w.walk.tEnd;
  float before = g_left;
  vec3 radiance = marchShell(w.walk, d, w.bend, soilSeen, random) * terrainLight(w);
  float clear = exp(-v_hazePerM * w.walk.tEnter);
  vec3 horizon = texelFetch(t_horizon, int((diamondAngle(d.xy) + 0.25) * kHorizonTexels + random.x)).rgb;
  return mix(horizon * (before - g_left), radiance, clear);
}

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 random = pixelRandom(pixel);
  float first = texelFetch(t_first, pixel, 0).r;
  bool inside = u_eyeOverGroundM < v_heightM;
  vec3 seen = vec3(0.0);
  if (inside || first > 0.0) {
    float next = inside ? first : texelFetch(t_second, pixel, 0).r;
    bool last = next <= 0.0 && d.z < -kMeshHorizon;
    float enter = inside ? 0.0 : first;
    bool within = false;
    for (int i = 0; i < 2; ++i) {
      bool soilSeen;
      float leave;
      seen += marchTerrain(d, enter, last, within, random, soilSeen, leave);
      if (soilSeen || g_left <= 0.0) break;
      // A ray that still sinks toward the ground where it seemed to leave, or as far again beyond by more than it rises
      // there, and does not enter before, has never left the shell.
      float beyond = 2.0 * leave - enter;
      vec2 slopes = d.z - vec2(dot(terrainAt(d.xy, leave).xy, d.xy), dot(terrainAt(d.xy, beyond).xy, d.xy));
      leave = slopes.x < 0.0 ? leave : beyond;
      within = min(slopes.x, slopes.x + slopes.y) < 0.0 && !last && (next <= 0.0 || next > leave);
      enter = within ? leave : next;
      if (enter <= 0.0) break;
      last = true;
    }
  }
  if (g_left > 0.0) seen += g_left * (skyRadiance(d) + sunDisc(d));
  o_radiance = vec4(seen * v_exposure, 1.0);
}
#else
void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  vec3 random = pixelRandom(ivec2(gl_FragCoord.xy));
  Walk walk = startWalk(d);
  if (walk.tEnd < 0.0) {
    o_radiance = vec4((skyRadiance(d) + sunDisc(d)) * v_exposure, 1.0);
    return;
  }
  bool soilSeen = walk.slopeZ < 0.0;
  vec3 radiance = marchShell(walk, d, 0.0, soilSeen, random);
  vec3 seen = soilSeen ? throughHaze(radiance, d, walk.tEnter, random.x)
                       : radiance + g_left * (skyRadiance(d) + sunDisc(d));
  o_radiance = vec4(seen * v_exposure, 1.0);
}
#endif
