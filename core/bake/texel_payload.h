#pragma once

#include "bake/texel_bake.h"
#include "bake/texel_rest.h"
#include "base/bytes.h"

namespace sward::bake {

/// Cache payloads of texels; see payload.h. What load() takes is whole: every index in its array's range, every array
/// as long as the others say.
/// wither::PackedTexel holds voxels in 20 bytes, with its errors: a tenth of a per cent of density, half of one of 255
/// steps in the root of colours, a thousandth of a radian of normals. Which voxels there are is exact.
///
/// The rest takes 8 bytes a voxel more for what it hangs on, and 24 a point of the strands' veins, to the last bit.
void save(base::ByteWriter& out, const TexelRest& rest);
bool load(base::ByteReader& in, TexelRest& rest);

/// Finished texels take 4 bytes a voxel more for skylight, in 16 bits of the largest share.
void save(base::ByteWriter& out, const TexelBake& bake);
bool load(base::ByteReader& in, TexelBake& bake);

}  // namespace sward::bake
