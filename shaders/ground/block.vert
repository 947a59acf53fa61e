// One screen block of u_blockSize pixels per instance, from gl_VertexID.
#define SWARD_VERTEX
#include "ground/frame.glsl"

uniform usamplerBuffer t_blocks;  // x | y << 16, pixels of the lower left corner
uniform int u_firstBlock;
uniform ivec2 u_targetSize;
uniform int u_blockSize;

void main() {
  setFrame();
  uint corner32 = texelFetch(t_blocks, u_firstBlock + gl_InstanceID).r;
  ivec2 corner = ivec2(int(corner32 & 0xffffu), int(corner32 >> 16));
  ivec2 offset = ivec2(gl_VertexID & 1, gl_VertexID >> 1) * u_blockSize;
  vec2 pixel = vec2(min(corner + offset, u_targetSize));
  gl_Position = vec4(pixel / vec2(u_targetSize) * 2.0 - 1.0, 0.0, 1.0);
}
