// The ray of a pixel and the random numbers of a sample.
uniform vec2 u_pixelScale;    // pixel to [-1, 1]
uniform vec2 u_pixelOffset;   // with the sample's place in the pixel
uniform vec3 u_viewRight;     // times the tangent of half the field of view
uniform vec3 u_viewUp;
uniform vec3 u_viewForward;
uniform vec3 u_sampleShift;   // of the random numbers, another for every sample of a picture

vec3 viewRay(vec2 pixel) {
  vec2 p = pixel * u_pixelScale + u_pixelOffset;
  return normalize(u_viewForward + p.x * u_viewRight + p.y * u_viewUp);
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
  return fract(vec3(v >> 8u) * (1.0 / 16777216.0) + u_sampleShift);
}

// A fourth number that is independent of any two of the three.
float fourthRandom(vec3 random) { return fract(random.x - random.y + random.z + 1.0); }
