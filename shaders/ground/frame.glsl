// What all rays of a frame share: uniforms that the vertex shader hands over as flat inputs. A software rasteriser loads
// a uniform lane by lane, with a check of bounds, wherever a shader names it, but a flat input once a triangle. At most 60
// components, the least that OpenGL grants.
#define FRAME_VALUES(VALUE) \
  VALUE(vec2, v_pixelScale, u_pixelScale) \
  VALUE(vec2, v_pixelOffset, u_pixelOffset) \
  VALUE(vec3, v_viewRight, u_viewRight) \
  VALUE(vec3, v_viewUp, u_viewUp) \
  VALUE(vec3, v_viewForward, u_viewForward) \
  VALUE(vec3, v_sampleShift, u_sampleShift) \
  VALUE(vec2, v_mapSize, u_mapSize) \
  VALUE(vec2, v_mapInverse, u_mapInverse) \
  VALUE(vec2, v_mapOffset, u_mapOffset) \
  VALUE(float, v_mapBorder, u_mapBorder) \
  VALUE(float, v_mapStride, u_mapStride) \
  VALUE(int, v_tiles, u_tiles) \
  VALUE(float, v_pixelAngle, u_pixelAngle) \
  VALUE(int, v_sliceSize, u_sliceSize) \
  VALUE(int, v_sliceMaxLevel, u_sliceMaxLevel) \
  VALUE(int, v_slicePlanes, u_slicePlanes) \
  VALUE(int, v_sliceLayers, u_sliceLayers) \
  VALUE(float, v_slicesPerM, u_slicesPerM) \
  VALUE(ivec2, v_bladeSize, u_bladeSize) \
  VALUE(int, v_bladeMaxLevel, u_bladeMaxLevel) \
  VALUE(int, v_bladeVerticalLevels, u_bladeVerticalLevels) \
  VALUE(int, v_bladePlanes, u_bladePlanes) \
  VALUE(int, v_slabs, u_slabs) \
  VALUE(float, v_bladesPerM, u_bladesPerM) \
  VALUE(uvec4, v_bladeBase, uvec4(u_bladeBase[0], u_bladeBase[1], u_bladeBase[2], u_bladeBase[3])) \
  VALUE(vec2, v_eyeTiles, u_eyeTiles) \
  VALUE(float, v_eyeM, u_eyeM) \
  VALUE(float, v_tilesPerM, u_tilesPerM) \
  VALUE(float, v_slabsPerM, u_slabsPerM) \
  VALUE(float, v_heightM, u_heightM) \
  VALUE(float, v_relightScale, u_relightScale) \
  VALUE(float, v_cosTheta0, u_cosTheta0) \
  VALUE(float, v_slicesFrom, u_slicesFrom) \
  VALUE(float, v_slicesAll, u_slicesAll) \
  VALUE(float, v_exposure, u_exposure) \
  VALUE(float, v_hazePerM, u_hazePerM) \
  VALUE(float, v_gridBendTiles, u_gridBendTiles) \
  VALUE(float, v_bendTurns, u_bendTurns) \
  VALUE(vec2, v_bendPhase, u_bendPhase) \
  VALUE(float, v_macroFadePerM, u_macroFadePerM)

#ifdef SWARD_VERTEX
uniform vec2 u_pixelScale;      // pixel to [-1, 1]
uniform vec2 u_pixelOffset;     // with the sample's place in the pixel
uniform vec3 u_viewRight;       // times the tangent of half the field of view
uniform vec3 u_viewUp;
uniform vec3 u_viewForward;
uniform vec3 u_sampleShift;     // of the random numbers, another for every sample of a picture
uniform vec2 u_mapSize;
uniform vec2 u_mapInverse;      // 1 / u_mapSize
uniform vec2 u_mapOffset;       // map cell of local cell (0, 0)
uniform float u_mapBorder;      // cells
uniform float u_mapStride;      // cells in a row, with borders
uniform int u_tiles;
uniform float u_pixelAngle;     // width of a pixel at unit distance
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
uniform vec2 u_eyeTiles;        // eye in tiles from the local cell
uniform float u_eyeM;           // height over the ground
uniform float u_tilesPerM;
uniform float u_slabsPerM;
uniform float u_heightM;        // of the shell
uniform float u_relightScale;
uniform float u_cosTheta0;
uniform float u_slicesFrom;     // |N.E| from which the march draws slices
uniform float u_slicesAll;      // and from which it draws nothing else
uniform float u_exposure;
uniform float u_hazePerM;       // extinction of aerial perspective
uniform float u_gridBendTiles;  // largest shift of the tiles' grid
uniform float u_bendTurns;      // turns a tile of its wave
uniform vec2 u_bendPhase;       // turns at the local cell, of the shift along x and along y
uniform float u_macroFadePerM;  // 1 / distance at which a pixel covers the macro variation

#define FRAME_OUT(type, name, value) flat out type name;
FRAME_VALUES(FRAME_OUT)
#define FRAME_SET(type, name, value) name = value;
void setFrame() { FRAME_VALUES(FRAME_SET) }
#else
#define FRAME_IN(type, name, value) flat in type name;
FRAME_VALUES(FRAME_IN)
#endif
