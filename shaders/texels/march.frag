// A meadow of texels (science.md section 4): from the shell's top front to back through the voxels of a block that
// repeats over the ground, past empty bricks in one step, until the ray is opaque; then the soil. The light came on the
// processor (core/wither/texel_light.h); leaves show the side that faces the eye, tangents a highlight.
#ifndef SWARD_TERRAIN
#define SWARD_TERRAIN 0
#endif
// Of the layers' shaders the ray, the grid's bend, the macro variation and the haze serve here too: a texel is a tile.
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

uniform isamplerBuffer t_bricks;   // of all levels: where a brick's voxels start in t_voxels; -1: empty
uniform usamplerBuffer t_voxels;   // 512 a brick: index into t_leaves, from 1; 0: empty
uniform usamplerBuffer t_leaves;   // four words a voxel, render/texel_set.h
uniform usamplerBuffer t_soil;     // lit soil of the finest level's columns, as colour30()

uniform int u_levels;
uniform uint u_levelStart[8];       // in t_bricks
uniform int u_columns;             // of level 0
uniform int u_layers;
uniform float u_densityRange;      // 1/m, of a stored density of 1
uniform float u_radianceRange;
uniform float u_highlight;         // its radiance over the sun's irradiance at full gloss

out vec4 o_radiance;

const int kBrick = 8;
const int kMaxVoxels = 900;         // that a ray may look at
const float kLevelBiasTexels = 0.8;

vec3 g_sum = vec3(0.0);  // over the range of radiances
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

void shade(uint index, vec3 d, float lengthM) {
  uvec4 leaf = texelFetch(t_leaves, int(index) - 1);
  vec3 normal = direction16(leaf.x & 0xffffu);
  vec3 tangent = direction16(leaf.x >> 16);
  float root = float(leaf.w & 0xffu) / 255.0;
  float share = float((leaf.w >> 8) & 0xffu) / 255.0;
  float facing = dot(normal, d);
  // wither/extinction.h of S = share n n^T + (1 - share) I / 3: a spheroid about the normal.
  vec2 eigen = (vec2(1.0 - share) + vec2(3.0 * share, 0.0)) / 3.0;
  vec2 area = eigen * (5.0 + 3.0 * eigen) / 8.0;
  float extinction = root * root * u_densityRange * sqrt(mix(area.y, area.x, facing * facing));
  float opacity = 1.0 - transmitted(extinction * lengthM);
  vec3 colour = colour30(facing <= 0.0 ? leaf.y : leaf.z);
  // Kajiya and Kay: the cone about the tangent on which the sun's light is reflected.
  vec2 along = vec2(dot(tangent, -d), dot(tangent, u_sunDirection));
  vec2 across = sqrt(max(1.0 - along * along, 0.0));
  float cone = across.x * across.y - along.x * along.y;
  float gloss = float((leaf.w >> 16) & 0xffu) / 255.0;
  if (gloss > 0.0 && tangent != vec3(0.0)) {
    float c = max(cone, 0.0);
    c *= c * c;  // to the power 24
    c *= c;
    c *= c;
    c *= c;
    colour += u_sunIrradiance * (gloss * u_highlight * c / u_radianceRange);
  }
  g_sum += g_left * opacity * colour;
  g_left *= 1.0 - opacity;
}

void marchVoxels(vec3 p, vec3 d, vec3 dv, float tEnd, int level, int columns, int layers) {
  int start = int(u_levelStart[level]);
  int row = columns / kBrick;
  vec3 inverse = 1.0 / dv;
  vec3 ahead = step(0.0, dv);
  // Just over a face that was met, so that the next cell is found whatever rounding did.
  float nudge = 1e-3 / max(abs(dv.x), max(abs(dv.y), abs(dv.z)));
  float t = 0.0;
  for (int i = 0; i < kMaxVoxels && t < tEnd && g_left > kTransmittanceEnd; ++i) {
    vec3 cell = floor(p + dv * (t + nudge));
    ivec3 at = ivec3(cell);
    if (at.z < 0 || at.z >= layers) break;  // a shifted ray is out of the block a little early
    ivec3 brick = at >> 3;
    brick.xy -= row * ivec2(floor(vec2(brick.xy) / float(row)));
    int first = texelFetch(t_bricks, start + (brick.z * row + brick.y) * row + brick.x).r;
    vec3 exits;
    if (first < 0) {
      exits = (floor(cell / 8.0) * 8.0 + 8.0 * ahead - p) * inverse;
    } else {
      exits = (cell + ahead - p) * inverse;
    }
    float next = min(min(exits.x, min(exits.y, exits.z)), tEnd);
    next = max(next, t + nudge);
    if (first >= 0) {
      ivec3 within = at & 7;
      uint index = texelFetch(t_voxels, first + (within.z * kBrick + within.y) * kBrick + within.x).r;
      if (index != 0u) shade(index, d, next - t);
    }
    t = next;
  }
}

// What a walk through the shell gathers, and the soil where it ends on it: radiance before the macro variation.
vec3 marchShell(Walk walk, vec3 d, float tEnd, bool soilSeen, vec3 random) {
  float before = g_left;
  g_sum = vec3(0.0);
  float voxels = walk.footprint * float(u_columns) * v_tilesPerM;
  int level = clamp(mipLevel(voxels, (1.0 + random.z) * kLevelBiasTexels), 0, u_levels - 1);
  int columns = u_columns >> level;
  int layers = u_layers >> level;
  vec2 place = fract(walk.place + vec2(gridBend(walk.bend.x), gridBend(walk.bend.y)));
  vec3 perM = vec3(vec2(float(columns)) * v_tilesPerM, float(layers) / v_heightM);
  // A voxel's box, shifted anew for every sample: their mean has no blocks.
  vec3 p = vec3(place * float(columns), walk.heightM * perM.z) + random - 0.5;
  p.z = clamp(p.z, 0.0, float(layers));
  vec3 along = vec3(d.xy, walk.slopeZ);
  if (tEnd > 0.0) marchVoxels(p, d, along * perM, tEnd, level, columns, layers);
  vec3 radiance = g_sum;
  if (soilSeen && g_left > kTransmittanceEnd) {
    vec2 foot = fract(place + d.xy * (max(tEnd, 0.0) * v_tilesPerM));
    ivec2 column = clamp(ivec2(foot * float(u_columns)), ivec2(0), ivec2(u_columns - 1));
    radiance += g_left * colour30(texelFetch(t_soil, column.y * u_columns + column.x).r);
    g_left = 0.0;
  }
  // What little an opaque ray has left is given to what it saw.
  if (g_left <= kTransmittanceEnd) {
    radiance *= before / max(before - g_left, 1e-6);
    g_left = 0.0;
  }
  return radiance * u_radianceRange * macroTint(walk.place, walk.tEnter, random);
}

#if SWARD_TERRAIN
vec3 marchTerrain(vec3 d, float enterM, bool last, vec3 random, out bool soilSeen) {
  TerrainWalk w = startTerrain(d, enterM, last);
  soilSeen = w.soilSeen;
  float before = g_left;
  vec3 radiance = marchShell(w.walk, d, w.walk.tEnd, soilSeen, random) * terrainLight(w);
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
    for (int i = 0; i < 2; ++i) {
      bool soilSeen;
      seen += marchTerrain(d, enter, last, random, soilSeen);
      if (soilSeen || g_left <= 0.0 || next <= 0.0) break;
      enter = next;
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
  vec3 radiance = marchShell(walk, d, walk.tEnd, soilSeen, random);
  vec3 seen = soilSeen ? throughHaze(radiance, d, walk.tEnter, random.x)
                       : radiance + g_left * (skyRadiance(d) + sunDisc(d));
  o_radiance = vec4(seen * v_exposure, 1.0);
}
#endif
