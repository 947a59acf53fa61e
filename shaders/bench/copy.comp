// The yardstick of relighting: one invocation a texel reads a word and writes it elsewhere.
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Out { uint b_out[]; };
uniform usamplerBuffer t_texels;
uniform int u_count;

void main() {
  int at = int(gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64 + int(gl_LocalInvocationID.x);
  if (at < u_count) b_out[at] = texelFetch(t_texels, at).r;
}
