// Fetches from the relit sets: nearest texel of a jittered place and level, which averages to the bilinear and
// trilinear filter. A jittered place may fall on the neighbouring tile: the map says which, so no apron is read.
#include "include/layout.glsl"

uniform usamplerBuffer t_relit;
// tile | brightness << 8 | hue << 16, row by row from the south-west, the map's other side repeated as a border
uniform usamplerBuffer t_map;



// A mip level of a set, chosen once a ray: the distance changes too little within the shell to change it.
struct Level {
  int start;          // first texel of the level
  int area;           // texels of a plane
  int width;
  int tileArea;       // texels of a tile's planes
  float columns;      // width and height as floats
  float rows;
  vec2 jitter;        // in tiles along a row, and in rows (slices: tiles)
  int leastTile;      // where a pixel covers more than a tile that of the mean, which stands for every tile; else 0
};

// floor(log2(texels in the footprint) + a number in [0, 1)), from the exponent of a float.
int mipLevel(float footprintTexels, float levelJitter) {
  return max((floatBitsToInt(footprintTexels * levelJitter) >> 23) - 127, 0);
}

Level sliceLevel(float footprintM, vec3 random, float levelJitter) {
  int wanted = mipLevel(footprintM * v_slicesPerM, levelJitter);
  int level = min(wanted, v_sliceMaxLevel);
  Level l;
  l.width = v_sliceSize >> level;
  l.area = l.width * l.width;
  l.start = levelOffset(level, v_sliceSize * v_sliceSize, v_slicePlanes);
  l.tileArea = l.area * v_sliceLayers;
  l.columns = float(l.width);
  l.rows = l.columns;
  l.jitter = (random.xy - 0.5) / l.columns;
  l.leastTile = wanted > v_sliceMaxLevel ? v_tiles : 0;
  return l;
}

Level bladeLevel(float footprintM, vec3 random, float levelJitter) {
  int wanted = mipLevel(footprintM * v_bladesPerM, levelJitter);
  int level = min(wanted, v_bladeMaxLevel);
  int height = v_bladeSize.y >> min(level, v_bladeVerticalLevels);
  Level l;
  l.width = v_bladeSize.x >> level;
  l.area = l.width * height;
  l.start = levelOffset(level, v_bladeSize.x * v_bladeSize.y, v_bladePlanes);
  l.tileArea = l.area * v_slabs;
  l.columns = float(l.width);
  l.rows = float(height);
  l.jitter = vec2((random.x - 0.5) / l.columns, random.y - 0.5);
  l.leastTile = wanted > v_bladeMaxLevel ? v_tiles : 0;
  return l;
}

// A place in tiles from the local cell, moved by whole maps into the stored one: once a ray, which then walks on over
// the border (a ray that leaves even that is opaque, or so distant that any tile will do).
vec2 mapPlace(vec2 tiles) {
  vec2 cell = floor(tiles);
  vec2 wrapped = cell + v_mapOffset;
  wrapped -= v_mapSize * floor((wrapped + 0.5) * v_mapInverse);
  return tiles - cell + wrapped + v_mapBorder;
}

uint mapWord(vec2 cell) { return texelFetch(t_map, int(cell.y * v_mapStride + cell.x)).r; }

// First texel of the planes of the tile on a cell, counted from the first tile's.
int tileStart(Level l, vec2 cell) { return max(int(mapWord(cell) & 0xffu), l.leastTile) * l.tileArea; }

// First texel of a slice layer of the first tile.
int layerStart(Level l, int layer) { return l.start + layer * l.area; }

// The texel of a slice layer at a place in a tile, from its corner in tiles.
int sliceTexel(Level l, vec2 place) {
  ivec2 texel = ivec2(place * l.columns);
  return texel.y * l.width + texel.x;
}

// The stored texel of the slice layer that starts at `start`, at a place in tiles, jittered already.
uint fetchSlice(Level l, int start, vec2 place) {
  vec2 cell = floor(place);
  return texelFetch(t_relit, start + tileStart(l, cell) + sliceTexel(l, place - cell)).r;
}

// A stored blade texel: `across` and `along` count tiles along the planes' normal and along the plane, `row` rows from
// -1/2 up; jittered already. axisX says that the planes are normal to x, `start` where the level of their set starts.
uint fetchBlade(Level l, int start, bool axisX, float across, float along, float row) {
  float cellAlong = floor(along);
  float cellAcross = floor(across);
  int plane = int((across - cellAcross) * float(v_slabs));
  int within = int(min(row, l.rows - 1.0)) * l.width + int((along - cellAlong) * l.columns);
  vec2 cell = axisX ? vec2(cellAcross, cellAlong) : vec2(cellAlong, cellAcross);
  return texelFetch(t_relit, start + tileStart(l, cell) + plane * l.area + within).r;
}

// Stored bytes to floats without their scale: colours in units of kColourUnit once squared.
const float kColourUnit = 1.0 / (255.0 * 255.0);
vec3 storedColour(uint stored) {
  vec3 root = vec3(float(stored & 0xffu), float((stored >> 8) & 0xffu), float((stored >> 16) & 0xffu));
  return root * root;
}

// Optical depth of a stored texel that is crossed perpendicularly, times `unit`; kDepthUnit gives the depth itself.
const float kDepthUnit = kDepthRange / (255.0 * 255.0);
float storedDepth(uint stored, float unit) {
  float root = float(stored >> 24);
  return root * root * unit;
}

// exp(-depth) as (1 - z / 16)^16 with z = depth (1 - depth / 32), which agrees with it to the third order: within 1 % up
// to a depth of 4, where hardly anything is left; a fifth of the time of exp in software.
float transmitted(float depth) {
  float z = min(depth, 16.0);
  float x = 1.0 - z * (1.0 / 16.0 - z * (1.0 / 512.0));
  x *= x;
  x *= x;
  x *= x;
  return x * x;
}
