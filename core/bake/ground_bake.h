#pragma once

#include "bake/texel_bake.h"
#include "lpt/layer_stack.h"
#include "tiles/tile_set.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace sward::bake {

/// Everything that a renderer needs to draw one kind of ground, plain data: layers of tiles, or texels.
struct GroundBake {
  double patchSideM = 1.0;
  double heightM = 0.0;  ///< top of the shell over the ground, at least 1 cm, also over bare soil
  tiles::TileSet tiles;
  lpt::LayerStack slices;  ///< images = tiles with aprons; side() texels square
  lpt::LayerStack soil;    ///< images = tiles with aprons; 1 layer, PTM, 1 channel
  /// +x, -x, +y, -y (order of trace::LayerSet); images = 1: the periodic patch itself. Layers as LayerSet numbers them.
  std::array<lpt::LayerStack, 4> blades;
  /// tiles::bladeOwners: where each tile's blades lie on the patch.
  std::vector<tiles::BladeOwner> bladeOwners;
  int bladesPerPatch = 8;
  tiles::TileMap map;
  /// Texels that stand in place of all the layers, which are empty then (render::GroundMethod::Texels); else null.
  std::shared_ptr<const TexelBake> texels;

  double tileSideM() const { return patchSideM * tiles.resolution / tiles.patchResolution; }
};

}  // namespace sward::bake
