#include "bake/payload.h"

#include <algorithm>

namespace sward::bake {
namespace {

/// Every array as long as the stack's sizes say, so that a renderer may index without asking.
bool consistent(const lpt::LayerStack& stack) {
  const std::size_t sets = stack.itemCount();
  const auto perSet = static_cast<std::size_t>(stack.channels * stack.perColumn());
  const std::size_t texels = stack.texelCount();
  return (stack.bits == 8 || stack.bits == 16) && stack.ranges.size() == perSet &&
         stack.coefficients.size() == sets * perSet * static_cast<std::size_t>(stack.bits / 8) &&
         stack.surface.size() == texels * 4 && stack.sky.size() == texels * 2 &&
         (stack.transmission.empty() || stack.transmission.size() == texels * 4);
}

bool consistent(const GroundBake& ground) {
  const auto tiles = ground.tiles.tiles.size();
  const auto cells = static_cast<std::size_t>(ground.map.width) * static_cast<std::size_t>(ground.map.height);
  const bool mapFits = ground.map.tiles.size() == cells && std::all_of(ground.map.tiles.begin(), ground.map.tiles.end(),
                                                                       [&](std::uint8_t tile) { return tile < tiles; });
  const bool stacksFit = consistent(ground.slices) && consistent(ground.soil) &&
                         std::all_of(ground.blades.begin(), ground.blades.end(),
                                     [](const lpt::LayerStack& blade) { return consistent(blade); });
  return mapFits && stacksFit && static_cast<std::size_t>(ground.slices.images) == tiles &&
         static_cast<std::size_t>(ground.soil.images) == tiles;
}

}  // namespace

void save(base::ByteWriter& out, const GroundBake& ground) {
  out.value(ground.patchSideM);
  out.value(ground.heightM);
  tiles::save(out, ground.tiles);
  lpt::save(out, ground.slices);
  lpt::save(out, ground.soil);
  for (const lpt::LayerStack& blade : ground.blades) lpt::save(out, blade);
  out.array(ground.bladeOwners);
  out.value(ground.bladesPerPatch);
  out.value(ground.map.width);
  out.value(ground.map.height);
  out.array(ground.map.tiles);
}

bool load(base::ByteReader& in, GroundBake& ground) {
  in.value(ground.patchSideM);
  in.value(ground.heightM);
  if (!tiles::load(in, ground.tiles) || !lpt::load(in, ground.slices) || !lpt::load(in, ground.soil)) return false;
  for (lpt::LayerStack& blade : ground.blades) {
    if (!lpt::load(in, blade)) return false;
  }
  in.array(ground.bladeOwners);
  in.value(ground.bladesPerPatch);
  in.value(ground.map.width);
  in.value(ground.map.height);
  in.array(ground.map.tiles);
  return in.ok() && ground.map.width > 0 && ground.map.height > 0 && consistent(ground);
}

}  // namespace sward::bake
