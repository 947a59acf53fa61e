// One mip level from the next finer: coverage-weighted means.
#include "include/layout.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) writeonly buffer Relit { uint b_relit[]; };
uniform usamplerBuffer t_relit;

uniform ivec2 u_fineSize;
uniform ivec2 u_outSize;
uniform int u_fineBase;
uniform int u_outBase;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, u_outSize))) return;
  int plane = int(gl_GlobalInvocationID.z);
  ivec2 factor = u_fineSize / u_outSize;  // 2 along x, 1 or 2 along y
  vec4 sum = vec4(0.0);
  for (int y = 0; y < factor.y; ++y) {
    for (int x = 0; x < factor.x; ++x) {
      ivec2 fine = texel * factor + ivec2(x, y);
      vec4 relit =
          decodeRelit(texelFetch(t_relit, u_fineBase + (plane * u_fineSize.y + fine.y) * u_fineSize.x + fine.x).r);
      sum += vec4(relit.rgb * relit.a, relit.a);
    }
  }
  b_relit[u_outBase + (plane * u_outSize.y + texel.y) * u_outSize.x + texel.x] =
      encodeRelit(sum.rgb / max(sum.a, 1e-6), sum.a / float(factor.x * factor.y));
}
