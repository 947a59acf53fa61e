// The ray of a pixel and the random numbers of a sample.
#include "ground/frame.glsl"


vec3 viewRay(vec2 pixel) {
  vec2 p = pixel * v_pixelScale + v_pixelOffset;
  return normalize(v_viewForward + p.x * v_viewRight + p.y * v_viewUp);
}

// Three numbers in [0, 1) of a pixel (PCG3D, Jarzynski and Olano 2020), shifted by the sample's (Cranley and Patterson).
vec3 pixelRandom(ivec2 pixel) {
  uvec3 v = uvec3(pixel, 17) * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v ^= v >> 16u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return fract(vec3(v >> 8u) * (1.0 / 16777216.0) + v_sampleShift);
}

// A fourth number that is independent of any two of the three.
float fourthRandom(vec3 random) { return fract(random.x - random.y + random.z + 1.0); }
