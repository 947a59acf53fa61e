// The paper's drawing, for comparison (science.md section 3): every plane of every family that the ray crosses within
// the shell is composited, slices in front of blades in front of the soil, as whole layers with the weights
//   w_s = max(N . E, 0),  w_b = max(1 - |N . E| / cos(theta0), 0)
// on their coverage; SWARD_PAPER_WEIGHTS 0 divides them by their sum. No early end, no path lengths: what a blend of
// textured planes gives. Texels are fetched and filtered as in the march. The planes of a set are those of the ground it
// crosses, not one tile's, so that parallax is right and no plane ends; at most kMaxBlendedBlades of each direction are
// composited, the nearest. Where the march takes several slabs in a step, so do these, composited so many times.
#include "ground/constants.glsl"
#include "ground/view.glsl"
#include "ground/sky.glsl"
#include "ground/texels.glsl"
#include "ground/surface.glsl"

out vec4 o_radiance;

vec3 g_sum = vec3(0.0);
float g_left = 1.0;

void composite(uint stored, float weight, float times) {
  float opacity = weight * (1.0 - transmitted(storedDepth(stored, kDepthUnit)));
  if (times > 1.0) opacity = 1.0 - pow(1.0 - opacity, times);
  g_sum += g_left * opacity * storedColour(stored);
  g_left *= 1.0 - opacity;
}

void compositeBlades(Walk walk, Level level, bool axisX, float weight, float random) {
  BladeWalk blades = startBlades(walk, level, axisX, random);
  Planes planes = blades.planes;
  for (int i = 0; i < kMaxBlendedBlades; ++i) {
    if (planes.t >= walk.tEnd) break;
    uint stored = fetchAlong(blades, level, axisX, planes.place, planes.t);
    composite(stored, weight, abs(planes.step) * float(v_slabs));
    planes.t += planes.stride;
    planes.place += planes.step;
  }
}

void main() {
  vec3 d = viewRay(gl_FragCoord.xy);
  vec3 random = pixelRandom(ivec2(gl_FragCoord.xy));
  float levelJitter = (1.0 + random.z) * kLevelBias;
  Walk walk = startWalk(d);
  float facing = max(-d.z, 0.0);
  float slices = facing;
  float blades = max(1.0 - facing / v_cosTheta0, 0.0);
#if !SWARD_PAPER_WEIGHTS
  float both = max(slices + blades, 1e-6);
  slices /= both;
  blades /= both;
#endif

  Level layered = sliceLevel(walk.footprint, random, levelJitter);
  vec2 place = slicePlace(walk, layered);
  Planes planes = slicePlanes(walk, fourthRandom(random));
  for (int i = 0; i < v_sliceLayers; ++i) {
    if (planes.t >= walk.tEnd) break;
    int start = layerStart(layered, int(planes.place));
    composite(fetchSlice(layered, start, place + walk.slope * planes.t), slices, 1.0);
    planes.t += planes.stride;
    planes.place += planes.step;
  }
#if SWARD_FAMILIES & 6
  Level level = bladeLevel(walk.footprint, random, levelJitter);
  compositeBlades(walk, level, true, blades * abs(d.x) / max(abs(d.x) + abs(d.y), 1e-6), random.y);
  compositeBlades(walk, level, false, blades * abs(d.y) / max(abs(d.x) + abs(d.y), 1e-6), random.y);
#endif
  o_radiance = finishGround(walk, d, g_sum * kColourUnit, g_left, layered, random);
}
