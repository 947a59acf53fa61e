// A meadow of texels (science.md section 4): from the shell's top front to back through the voxels of a block that
// repeats over the ground, past empty bricks in one step, until the ray is opaque; then the soil. The light came on the
// processor (core/wither/texel_light.h); leaves show the side that faces the eye, tangents a highlight.
#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"

uniform isamplerBuffer t_bricks;   // of all levels: where a brick's voxels start in t_voxels; -1: empty
uniform usamplerBuffer t_voxels;   // 512 a brick: index into t_leaves, from 1; 0: empty
uniform usamplerBuffer t_leaves;   // four words a voxel, render/texel_set.h
uniform usamplerBuffer t_soil;     // lit soil of the finest level's columns, shared exponents
uniform samplerBuffer t_horizon;

uniform int u_levels;
uniform uint u_levelStart[8];       // in t_bricks
uniform int u_columns;             // of level 0
uniform int u_layers;
uniform float u_sideM;
uniform float u_shellM;
uniform float u_densityRange;      // 1/m, of a stored density of 1
uniform float u_radianceRange;
uniform float u_sharpness;         // exponent of the highlight
uniform vec3 u_sunIrradiance;
uniform vec2 u_eyePlace;           // eye in the block, blocks
uniform float u_bendM;             // as the ground's grid is bent
uniform float u_bendTurnsPerM;
uniform vec2 u_bendPhase;

out vec4 o_radiance;

const int kBrick = 8;
const int kMaxVoxels = 900;         // that a ray may look at
const float kLevelBiasTexels = 0.8;

vec3 g_sum = vec3(0.0);
float g_left = 1.0;

float bendWave(float turns) {
  float triangle = abs(fract(turns) - 0.5) * 4.0 - 1.0;
  return triangle * (1.5 - 0.5 * triangle * triangle);
}

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
  float opacity = 1.0 - exp(-extinction * lengthM);
  vec3 colour = colour30(facing <= 0.0 ? leaf.y : leaf.z);
  // Kajiya and Kay: the cone about the tangent on which the sun's light is reflected.
  vec2 along = vec2(dot(tangent, -d), dot(tangent, u_sunDirection));
  vec2 across = sqrt(max(1.0 - along * along, 0.0));
  float cone = across.x * across.y - along.x * along.y;
  float gloss = float((leaf.w >> 16) & 0xffu) / 255.0;
  if (gloss > 0.0 && tangent != vec3(0.0)) {
    colour += u_sunIrradiance * (gloss * pow(max(cone, 0.0), u_sharpness) / u_radianceRange);
  }
  g_sum += g_left * opacity * colour;
  g_left *= 1.0 - opacity;
}

void marchVoxels(vec3 p, vec3 d, vec3 dv, float tEnd, int level, int columns, int layers) {
  int start = int(u_levelStart[level]);
  int row = columns / kBrick;
  ivec3 bricks = ivec3(row, row, layers / kBrick);
  vec3 inverse = 1.0 / dv;
  vec3 ahead = step(0.0, dv);
  // Just over a face that was met, so that the next cell is found whatever rounding did.
  float nudge = 1e-3 / max(abs(dv.x), max(abs(dv.y), abs(dv.z)));
  float t = 0.0;
  for (int i = 0; i < kMaxVoxels && t < tEnd && g_left > kTransmittanceEnd; ++i) {
    vec3 cell = floor(p + dv * (t + nudge));
    ivec3 at = ivec3(cell);
    ivec3 brick = at >> 3;
    brick.xy -= bricks.xy * ivec2(floor(vec2(brick.xy) / float(row)));
    brick.z = clamp(brick.z, 0, bricks.z - 1);
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

vec3 throughHaze(vec3 radiance, vec3 d, float distanceM, float random) {
  float clear = exp(-v_hazePerM * distanceM);
  vec3 horizon = texelFetch(t_horizon, int((diamondAngle(d.xy) + 0.25) * kHorizonTexels + random)).rgb;
  return mix(horizon, radiance, clear);
}

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  vec3 random = pixelRandom(ivec2(gl_FragCoord.xy));
  bool above = v_eyeM > u_shellM;
  if (d.z >= 0.0 && above) {
    o_radiance = vec4((skyRadiance(d) + sunDisc(d)) * v_exposure, 1.0);
    return;
  }
  vec3 steep = d;
  if (abs(steep.z) < 1e-4) steep.z = steep.z < 0.0 ? -1e-4 : 1e-4;
  bool down = steep.z < 0.0;
  float tEnter = above ? (u_shellM - v_eyeM) / steep.z : 0.0;
  float tStart = max(tEnter, kNearestM);
  float heightM = v_eyeM + steep.z * tStart;
  // Within the shell rays sink at least so steeply as the ground's do.
  steep.z = down ? min(steep.z, -kLeastSlope) : max(steep.z, kLeastSlope);
  float tEnd = (down ? heightM : u_shellM - heightM) / abs(steep.z);
  float footprint = (tStart + min(0.3 * tEnd, 1.0)) * v_pixelAngle;
  float voxels = footprint * float(u_columns) / u_sideM * (1.0 + random.z) * kLevelBiasTexels;
  int level = clamp((floatBitsToInt(max(voxels, 1e-6)) >> 23) - 127, 0, u_levels - 1);
  int columns = u_columns >> level;
  int layers = u_layers >> level;

  vec2 place = u_eyePlace + steep.xy * (tStart / u_sideM);
  vec2 bend = u_bendM / u_sideM *
              vec2(bendWave(u_bendPhase.x + steep.y * tStart * u_bendTurnsPerM),
                   bendWave(u_bendPhase.y + steep.x * tStart * u_bendTurnsPerM));
  place = fract(place + bend);
  vec3 perM = vec3(vec2(float(columns)) / u_sideM, float(layers) / u_shellM);
  // A voxel's box, shifted anew for every sample: their mean has no blocks.
  vec3 p = vec3(place * float(columns), heightM * perM.z) + vec3(random.xy - 0.5, (random.z - 0.5));
  p.z = clamp(p.z, 0.0, float(layers));
  if (tEnd > 0.0) marchVoxels(p, steep, steep * perM, tEnd, level, columns, layers);

  float left = g_left > kTransmittanceEnd ? g_left : 0.0;
  vec3 radiance = g_sum / (1.0 - (g_left - left)) * u_radianceRange;
  vec3 seen;
  if (down) {
    vec2 foot = fract(place + steep.xy * (tEnd / u_sideM));
    ivec2 column = clamp(ivec2(foot * float(u_columns)), ivec2(0), ivec2(u_columns - 1));
    vec3 soil = colour30(texelFetch(t_soil, column.y * u_columns + column.x).r) * u_radianceRange;
    seen = throughHaze(radiance + left * soil, d, tEnter, random.x);
  } else {
    seen = radiance + left * (skyRadiance(d) + sunDisc(d));
  }
  o_radiance = vec4(seen * v_exposure, 1.0);
}
