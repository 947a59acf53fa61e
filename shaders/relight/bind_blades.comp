// Copies the relit blades of the patch to the tiles: each tile's slabs show the patch slab and place that their owner
// map names (tiles::bladeOwners).
#include "include/layout.glsl"
#include "include/quantity.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 0) writeonly buffer Relit { uint b_relit[]; };
uniform usamplerBuffer t_patch;   // [layer][row][column]
uniform usamplerBuffer t_owners;  // slab | position << 16, [tile][slab of the tile][slice texel]

uniform ivec2 u_patchSize;   // texels of a patch blade
uniform ivec2 u_outSize;     // texels of a tile's blade
uniform int u_slabs;         // of a patch
uniform int u_reversed;      // 1: the patch's layer 0 is its last slab (sets seen from the positive side)
uniform int u_ownerTexels;   // slice texels along a tile's side
uniform int u_texelsPerOwner;  // blade texels in one slice texel
uniform int u_outBase;
uniform int u_ownerBase;     // where the axis' owners start
#if SWARD_QUANTITY == SWARD_TILES
uniform int u_tileSlabs;     // of a tile
#endif

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, u_outSize))) return;
  int plane = int(gl_GlobalInvocationID.z);  // tile * slabs of a tile + slab
  int along = texel.x / u_texelsPerOwner;
  uint owner = texelFetch(t_owners, u_ownerBase + plane * u_ownerTexels + along).r;
  int slab = int(owner & 0xffffu);
  int column = int(owner >> 16) * u_texelsPerOwner + texel.x - along * u_texelsPerOwner;
  int layer = u_reversed == 1 ? u_slabs - 1 - slab : slab;
  uint value = texelFetch(t_patch, (layer * u_patchSize.y + texel.y) * u_patchSize.x + column).r;
#if SWARD_QUANTITY == SWARD_TILES
  vec4 relit = decodeRelit(value);
  value = encodeRelit(relit.rgb * tileColour(plane / u_tileSlabs), relit.a);
#endif
  b_relit[u_outBase + (plane * u_outSize.y + texel.y) * u_outSize.x + texel.x] = value;
}
