// Relights a stack: one invocation does a block of SWARD_BLOCK x SWARD_BLOCK columns through all layers. With blocks of
// 2 it writes the first mip level as well, from the values it holds.
#include "include/layout.glsl"
#include "include/quantity.glsl"
#include "relight/stack.glsl"
#if SWARD_QUANTITY
#include "relight/quantity.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) writeonly buffer Relit { uint b_relit[]; };

uniform ivec2 u_stackSize;  // texels of a stack's image, with aprons
uniform ivec2 u_outSize;    // without
uniform int u_apron;
uniform int u_layers;       // of the stack
uniform int u_outLayers;    // of the target set
uniform int u_outFirst;     // layer of the target that the stack's layer 0 goes to
uniform int u_outBase;      // texel at which the target's level 0 starts
uniform int u_outBase1;     // the same for level 1

const int kColumns = SWARD_BLOCK * SWARD_BLOCK;

void main() {
  ivec2 corner = ivec2(gl_GlobalInvocationID.xy) * SWARD_BLOCK;
  if (any(greaterThanEqual(corner, u_outSize))) return;
  int image = int(gl_GlobalInvocationID.z);
  int stackColumn = (corner.y + u_apron) * u_stackSize.x + corner.x + u_apron;
  int area = u_stackSize.x * u_stackSize.y;
  int outArea = u_outSize.x * u_outSize.y;
#if SWARD_LPT
  Response responses[kColumns];
  for (int i = 0; i < kColumns; ++i)
    responses[i] = columnResponse(image * area + stackColumn + i / SWARD_BLOCK * u_stackSize.x + i % SWARD_BLOCK);
#endif
#if SWARD_COMMON
  float open[kColumns];
  for (int i = 0; i < kColumns; ++i) open[i] = 1.0;
#endif
  for (int layer = 0; layer < u_layers; ++layer) {
    int texelBase = (image * u_layers + layer) * area + stackColumn;
    int plane = image * u_outLayers + u_outFirst + layer;
    int outTexel = u_outBase + plane * outArea + corner.y * u_outSize.x + corner.x;
    vec4 sum = vec4(0.0);
#if SWARD_COMMON
    CommonLayer together = commonLayer(layer);
#endif
    for (int i = 0; i < kColumns; ++i) {
      int texel = texelBase + i / SWARD_BLOCK * u_stackSize.x + i % SWARD_BLOCK;
#if SWARD_COMMON
      vec2 f = texelResponse(responses[i], together, texel, open[i]);
#elif SWARD_LPT
      vec2 f = texelResponse(responses[i], float(layer) / float(u_layers));
#else
      vec2 f = texelResponse(texel);
#endif
#if SWARD_QUANTITY
      int column = image * area + stackColumn + i / SWARD_BLOCK * u_stackSize.x + i % SWARD_BLOCK;
      vec4 relit = quantityTexel(texel, column, f, layer, image);
#else
      vec4 relit = relitTexel(texel, f);
#endif
      b_relit[outTexel + i / SWARD_BLOCK * u_outSize.x + i % SWARD_BLOCK] = encodeRelit(relit.rgb, relit.a);
      sum += vec4(relit.rgb * relit.a, relit.a);
    }
#if SWARD_BLOCK == 2
    int outTexel1 = u_outBase1 + plane * (outArea >> 2) + (corner.y >> 1) * (u_outSize.x >> 1) + (corner.x >> 1);
    b_relit[outTexel1] = encodeRelit(sum.rgb / max(sum.a, 1e-6), sum.a * 0.25);
#endif
  }
}
