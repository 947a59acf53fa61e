// Sky and sun. The map's axes need no inverse trigonometry: u is the diamond angle of the azimuth clockwise from north,
// v the square root of the direction's height.
uniform sampler2D t_sky;
uniform vec3 u_sunDirection;
uniform vec3 u_sunDisc;       // radiance of the disc; 0 below the horizon

float diamondAngle(vec2 xy) {
  float p = xy.x / max(abs(xy.x) + abs(xy.y), 1e-9);
  return xy.y >= 0.0 ? 0.25 * p : 0.5 - 0.25 * p;  // in [-1/4, 3/4]
}

vec3 skyRadiance(vec3 d) {
  float v = (sqrt(max(d.z, 0.0)) * (kSkyRows - 1.0) + 0.5) / kSkyRows;  // row 0 is the horizon itself
  return textureLod(t_sky, vec2(diamondAngle(d.xy), v), 0.0).rgb;
}

vec3 sunDisc(vec3 d) {
  // The chord: accurate for small angles, where an arc cosine is not.
  float angle = length(d - u_sunDirection);
  return u_sunDisc * (1.0 - smoothstep(kSunDiscRad - kSunLimbRad, kSunDiscRad + kSunLimbRad, angle));
}
