// Fetches from the relit sets: nearest texel of a jittered place and level, which averages to the bilinear and
// trilinear filter. A jittered place may fall on the neighbouring tile: the map says which, so no apron is read.
#include "include/layout.glsl"

uniform samplerBuffer t_relit;
uniform usampler2D t_map;
uniform vec2 u_mapSize;
uniform vec2 u_mapOffset;       // map cell of local cell (0, 0)
uniform int u_tiles;

uniform int u_sliceSize;        // texels along a tile
uniform int u_sliceMaxLevel;
uniform int u_slicePlanes;      // images x layers
uniform int u_sliceLayers;      // with the soil, the last
uniform float u_slicesPerM;     // texels a metre

uniform ivec2 u_bladeSize;
uniform int u_bladeMaxLevel;
uniform int u_bladeVerticalLevels;
uniform int u_bladePlanes;
uniform int u_slabs;            // of a tile
uniform float u_bladesPerM;     // texels a metre
uniform uint u_bladeBase[4];    // where the sets seen from +x, -x, +y, -y start

uniform float u_pixelAngle;     // width of a pixel at unit distance

int mapTile(vec2 cell) {
  vec2 place = cell + u_mapOffset;
  place -= u_mapSize * floor((place + 0.5) / u_mapSize);
  return int(texelFetch(t_map, ivec2(place), 0).r);
}

// floor(log2(texels in the footprint) + a number in [0, 1)), from the exponent of a float.
int mipLevel(float footprintTexels, float jitter) {
  return max((floatBitsToInt(footprintTexels * jitter) >> 23) - 127, 0);
}

// The square root-coded slice texel of a layer at xy (in tiles).
vec4 fetchSlice(int layer, vec2 xy, float footprintM, vec3 random, float levelJitter) {
  int level = mipLevel(footprintM * u_slicesPerM, levelJitter);
  bool mean = level > u_sliceMaxLevel;
  level = min(level, u_sliceMaxLevel);
  LevelShape shape = levelShape(level, u_sliceSize, u_sliceSize, u_sliceMaxLevel, u_slicePlanes);
  vec2 place = xy + (random.xy - 0.5) / float(shape.width);
  vec2 cell = floor(place);
  ivec2 texel = min(ivec2((place - cell) * float(shape.width)), shape.width - 1);
  int tile = mean ? u_tiles : mapTile(cell);
  return texelFetch(t_relit,
                    shape.offset + ((tile * u_sliceLayers + layer) * shape.height + texel.y) * shape.width + texel.x);
}

// A blade texel: `across` counts slabs along the planes' normal, `along` tiles along the plane, `height` shell heights.
// AxisX says that planes are normal to x.
vec4 fetchBlade(bool axisX, int base, float across, float along, float height, float footprintM, vec3 random,
                float levelJitter) {
  int level = mipLevel(footprintM * u_bladesPerM, levelJitter);
  bool mean = level > u_bladeMaxLevel;
  level = min(level, u_bladeMaxLevel);
  LevelShape shape = levelShape(level, u_bladeSize.x, u_bladeSize.y, u_bladeVerticalLevels, u_bladePlanes);
  float place = along + (random.x - 0.5) / float(shape.width);
  float row = height * float(shape.height) + random.y - 0.5;
  float cellAlong = floor(place);
  float cellAcross = floor(across / float(u_slabs));
  int slab = int(across - cellAcross * float(u_slabs));
  int column = min(int((place - cellAlong) * float(shape.width)), shape.width - 1);
  int tile = mean ? u_tiles : mapTile(axisX ? vec2(cellAcross, cellAlong) : vec2(cellAlong, cellAcross));
  int plane = tile * u_slabs + slab;
  return texelFetch(t_relit, base + shape.offset +
                                 (plane * shape.height + clamp(int(row), 0, shape.height - 1)) * shape.width + column);
}
