// finishGround() of the view modes: relit texels hold a quantity (relight/quantity.glsl), which is composited as
// radiance would be; no macro variation, no haze, no sky. Alpha says how much of the pixel is ground.
// SWARD_MODE: 1 as is, 2 with the tiles' borders and numbers over it.
uniform float u_sampleWeight;
uniform float u_soilWeight;  // 0: what shines through is background

#if SWARD_MODE == 2
uniform vec2 u_labelUp;  // the axis of the ground that points up in the picture, so that numbers stand upright

const float kLinePixels = 0.8;         // half the width of a border
const float kHaloPixels = 1.8;         // and of the dark seam around it
const float kSmallestTile = 8.0;       // pixels of a tile where its border begins to show
const float kLabelHeight = 0.26;       // of a tile
const float kLabelWidth = 0.36;
const float kPlateAlpha = 0.5;
const float kOverlayHeight = 0.5;      // of the shell: about where what is seen of the plants stands

// Ten digits of three columns and five rows, the highest bit the upper left.
const int kDigits[10] =
    int[10](0x7b6f, 0x2c97, 0x73e7, 0x73cf, 0x5bc9, 0x79cf, 0x79ef, 0x7252, 0x7bef, 0x7bcf);

// Whether a number's ink is at a place counted in cells of its digits from the upper left.
bool inkAt(int number, int digits, ivec2 at) {
  int index = at.x / 4;
  int column = at.x - index * 4;
  if (at.x < 0 || at.y < 0 || at.y > 4 || index >= digits || column == 3) return false;
  int shown = number;
  for (int i = digits - 1; i > index; --i) shown /= 10;
  return ((kDigits[shown % 10] >> (14 - at.y * 3 - column)) & 1) == 1;
}

// White ink on a dark plate, premultiplied. `q` counts tiles from the middle of one, x to the right.
vec4 label(int number, vec2 q, float pixelsATile) {
  int digits = number > 99 ? 3 : (number > 9 ? 2 : 1);
  float columns = float(digits * 4 - 1);
  float cell = min(kLabelHeight / 5.0, kLabelWidth / columns);
  vec2 at = vec2(q.x + 0.5 * columns * cell, 2.5 * cell - q.y) / cell;
  bool plate = all(greaterThan(at, vec2(-1.0))) && all(lessThan(at, vec2(columns, 5.0) + 1.0));
  float shown = smoothstep(0.7, 1.4, cell * pixelsATile);
  if (!plate || shown <= 0.0) return vec4(0.0);
  bool ink = inkAt(number, digits, ivec2(floor(at)));
  return shown * (ink ? vec4(1.0) : vec4(vec3(0.0), kPlateAlpha));
}

// Borders and numbers lie on a plane within the shell, or on the ground where the eye is below that; premultiplied.
vec4 tileOverlay(Walk walk, vec3 d) {
  float overlayM = v_eyeM > v_heightM ? kOverlayHeight * v_heightM : 0.0;
  float t = max(walk.heightM - overlayM, 0.0) * walk.path;
  vec2 at = walk.place + walk.slope * t + vec2(gridBend(walk.bend.x), gridBend(walk.bend.y));
  float distanceM = walk.tStart + t;
  vec2 cell = floor(at);
  vec2 within = at - cell;
  // Tiles a pixel along x and y: a pixel is stretched along the view by the slant.
  float across = distanceM * v_pixelAngle * v_tilesPerM;
  vec2 forward = d.xy / max(length(d.xy), 1e-6);
  vec2 perPixel = across * sqrt(forward * forward / max(d.z * d.z, 1e-6) + forward.yx * forward.yx);
  vec2 borderPixels = min(within, 1.0 - within) / perPixel;
  float nearest = min(borderPixels.x, borderPixels.y);
  float pixelsATile = 1.0 / max(perPixel.x, perPixel.y);
  float seen = smoothstep(kSmallestTile, 3.0 * kSmallestTile, pixelsATile);
  float line = 1.0 - smoothstep(kLinePixels - 0.5, kLinePixels + 0.5, nearest);
  float halo = 1.0 - smoothstep(kHaloPixels - 0.8, kHaloPixels + 0.8, nearest);
  vec4 border = seen * vec4(vec3(line), max(line, 0.5 * halo));
  vec2 q = within - 0.5;
  vec4 number = label(int(mapWord(cell) & 0xffu), vec2(dot(q, vec2(u_labelUp.y, -u_labelUp.x)), dot(q, u_labelUp)),
                      pixelsATile);
  return border + number * (1.0 - border.a);
}
#endif

vec4 finishGround(Walk walk, vec3 d, vec3 value, float left, Level soilLevel, vec3 random) {
  vec2 foot = slicePlace(walk, soilLevel) + walk.slope * max(walk.tEnd, 0.0);
  vec3 soil = storedColour(fetchSlice(soilLevel, layerStart(soilLevel, v_sliceLayers - 1), foot));
#if SWARD_SKY
  float behind = walk.slopeZ < 0.0 ? left * u_soilWeight : 0.0;
#else
  float behind = left * u_soilWeight;
#endif
  vec3 seen = (value + behind * kColourUnit * soil) * (v_relightScale * v_exposure);
  float ground = (1.0 - left + behind) * u_sampleWeight;
#if SWARD_MODE == 2
  if (walk.tEnd > 0.0 && walk.slopeZ < 0.0) {
    vec4 over = tileOverlay(walk, d);
    seen = seen * (1.0 - over.a) + over.rgb * u_sampleWeight;
    ground = mix(ground, u_sampleWeight, over.a);
  }
#endif
  return vec4(seen, ground);
}
