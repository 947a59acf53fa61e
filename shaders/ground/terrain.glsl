// Rays through a shell that follows slopes. In coordinates (x, y, z - terrain(x, y)) a ray (dx, dy, dz) over ground of
// gradient g rises by dz - g . d_xy a metre (science.md section 3), and bends away where the ground does:
//   height(t) = height + slope t + bend t^2 / 2.
// Rays that come out of the shell's top again (over a crest) go on to where they enter it next, and then to the sky.
uniform sampler2D t_first;         // distance to the shell; 0: none
uniform sampler2D t_second;        // and where a ray enters it once more
uniform sampler2D t_terrain;       // gradient x, y; share of the sun that the hills let through
uniform vec2 u_terrainEye;         // eye in the texture
uniform vec2 u_terrainPerM;        // texture's extent a metre
uniform float u_eyeOverGroundM;
uniform float u_lookAheadM;        // nearest distance at which the ground's bend is looked for: a texel
uniform vec3 u_sunIrradiance;
uniform vec3 u_meanSky;            // radiance

// Rays that sink less than so much a metre follow the ground's bend, those that sink half as much wholly.
const float kBendSlope = 0.4;
const float kFar = 1e6;
// The mesh reaches so far that rays under the horizon by more than this meet it again beyond every crest.
const float kMeshHorizon = 0.002;

struct TerrainWalk {
  Walk walk;
  float bend;        // second derivative of the height, 1 / metres
  bool soilSeen;     // it ends on the ground, not in the shell's top
  vec3 ground;       // what t_terrain has where it starts
};

vec4 terrainAt(vec2 d, float t) { return textureLod(t_terrain, u_terrainEye + d * t * u_terrainPerM, 0.0); }

// Distances to the ground and to the shell's top from height h.
vec2 shellEnds(float h, float slope, float bend, bool fromTop) {
  float down = slope * slope - 2.0 * bend * h;
  float toGround = down >= 0.0 ? sqrt(down) - slope : 0.0;
  float ground = toGround > 1e-7 ? 2.0 * h / toGround : kFar;
  float above = max(v_heightM - h, 0.0);
  float up = slope * slope + 2.0 * bend * above;
  float toTop = up >= 0.0 ? slope + sqrt(up) : 0.0;
  float top = fromTop ? (bend > 1e-7 ? -2.0 * slope / bend : kFar) : (toTop > 1e-7 ? 2.0 * above / toTop : kFar);
  return vec2(ground, top);
}

// From `enterM` on; 0: from the eye, within the shell. `last`: nothing is known behind, so that the ray ends here.
TerrainWalk startTerrain(vec3 d, float enterM, bool last) {
  bool inside = enterM <= 0.0;
  TerrainWalk w;
  w.ground = terrainAt(d.xy, enterM).xyz;
  float slope = d.z - dot(w.ground.xy, d.xy);
  if (!inside) slope = min(slope, -kLeastSlope);
  w.bend = 0.0;
  if (abs(slope) < kBendSlope) {
    float ahead = max(0.5 * v_heightM / max(abs(slope), kLeastSlope), u_lookAheadM);
    vec2 turn = terrainAt(d.xy, enterM + ahead).xy - w.ground.xy;
    float shallow = 1.0 - smoothstep(0.5 * kBendSlope, kBendSlope, abs(slope));
    w.bend = -dot(turn, d.xy) / ahead * shallow;
    if (last) w.bend = min(w.bend, 0.0);
  }
  Walk walk;
  walk.slopeZ = slope < 0.0 ? min(slope, -1e-5) : max(slope, 1e-5);
  walk.slope = d.xy * v_tilesPerM;
  walk.tEnter = enterM;
  walk.tStart = max(enterM, kNearestM);
  float t = walk.tStart - enterM;
  walk.heightM = (inside ? u_eyeOverGroundM : v_heightM) + t * (walk.slopeZ + 0.5 * w.bend * t);
  walk.slopeZ = slope < 0.0 ? min(slope, -kLeastSlope) : max(slope, kLeastSlope);
  walk.path = 1.0 / abs(walk.slopeZ);
  vec2 ends = shellEnds(max(walk.heightM, 0.0), walk.slopeZ, w.bend, !inside);
  w.soilSeen = ends.x <= ends.y;
  walk.tEnd = min(ends.x, ends.y);
  vec2 tiles = v_eyeTiles + walk.slope * walk.tStart;
  walk.place = mapPlace(tiles);
  walk.bend = tiles.yx * v_bendTurns + v_bendPhase;
  walk.footprint = (walk.tEnter + min(kLevelShare * walk.tEnd, kLevelReachM)) * v_pixelAngle;
  w.walk = walk;
  return w;
}

// What a slope and the hills' shadow make of the light that texels were lit with, which is that of level ground.
// A deep canopy of leaves in all directions scatters the sun by mu0 / (mu0 + mu) (Lommel and Seeliger; Chandrasekhar 1960,
// chapter 3), mu0 and mu the cosines toward sun and eye over the ground; plants stay vertical, so that on a slope both
// become (l_z - g . l_xy). Integrated over an even sky it is 2 pi (1 - mu log((1 + mu) / mu)); the slope sees a share
// (1 + n_z) / 2 of the sky. An approximation: one factor serves all layers of a place.
vec3 terrainLight(TerrainWalk w) {
  float mu = clamp(-w.walk.slopeZ, 0.05, 1.0);
  float level = max(u_sunDirection.z, 1e-3);
  float sloped = max(u_sunDirection.z - dot(w.ground.xy, u_sunDirection.xy), 0.0);
  float sky = 6.2831853 * (1.0 - mu * log((1.0 + mu) / mu));
  float skyShare = 0.5 + 0.5 * inversesqrt(1.0 + dot(w.ground.xy, w.ground.xy));
  vec3 lit = u_sunIrradiance * (level / (level + mu)) + u_meanSky * sky;
  vec3 seen = u_sunIrradiance * (w.ground.z * sloped / (sloped + mu)) + u_meanSky * (sky * skyShare);
  return seen / max(lit, vec3(1e-6));
}
