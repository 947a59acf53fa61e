// The mean over all tiles of the coarsest level, layer by layer, into the image after the last tile: the medium that
// the march runs in where a pixel covers more than a tile. For every layer, and row of the coarsest level.
#include "include/layout.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) writeonly buffer Relit { uint b_relit[]; };
uniform usamplerBuffer t_relit;

uniform ivec2 u_outSize;  // of the coarsest level
uniform int u_outBase;
uniform int u_tiles;
uniform int u_outLayers;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, u_outSize))) return;
  int layer = int(gl_GlobalInvocationID.z);
  int area = u_outSize.x * u_outSize.y;
  int within = texel.y * u_outSize.x + texel.x;
  vec4 sum = vec4(0.0);
  for (int tile = 0; tile < u_tiles; ++tile) {
    vec4 relit = decodeRelit(texelFetch(t_relit, u_outBase + (tile * u_outLayers + layer) * area + within).r);
    sum += vec4(relit.rgb * relit.a, relit.a);
  }
  b_relit[u_outBase + (u_tiles * u_outLayers + layer) * area + within] =
      encodeRelit(sum.rgb / max(sum.a, 1e-6), sum.a / float(u_tiles));
}
