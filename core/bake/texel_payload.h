#pragma once

#include "bake/texel_bake.h"
#include "bake/texel_rest.h"
#include "base/bytes.h"

namespace sward::bake {

/// Cache payloads of texels; see payload.h. What load() takes is whole: every index in its array's range, every array
/// as long as the others say.
///
/// The rest is stored to the last bit: 100 bytes a point and 24 a point of the strands' veins.
void save(base::ByteWriter& out, const TexelRest& rest);
bool load(base::ByteReader& in, TexelRest& rest);

/// Finished texels take 24 bytes a voxel: wither::PackedTexel's 20, with its errors (a tenth of a per cent of density,
/// one of 255 steps in the root of colours), and skylight in 16 bits of the largest share.
void save(base::ByteWriter& out, const TexelBake& bake);
bool load(base::ByteReader& in, TexelBake& bake);

}  // namespace sward::bake
