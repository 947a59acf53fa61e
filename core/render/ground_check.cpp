#include "render/ground_check.h"

#include <algorithm>
#include <string>

namespace sward::render {
namespace {

constexpr int kMaxMapSide = 3900;

Error misfit(const std::string& what) {
  return Error::badInput("the baked ground does not fit together: " + what, "ground", "Bake it again.");
}

Result<void> checkStack(const lpt::LayerStack& stack, const std::string& name) {
  const std::size_t perItem = static_cast<std::size_t>(stack.perColumn() * stack.channels);
  const std::size_t items = stack.itemCount();
  const std::size_t texels = stack.texelCount();
  if (perItem == 0) return misfit(name + " holds a basis that cannot be relit");
  if (stack.bits != 8 && stack.bits != 16) return misfit(name + " has " + std::to_string(stack.bits) + " bits");
  if (stack.channels < 1 || stack.channels > 2) return misfit(name + " has a wrong number of channels");
  if (texels == 0 || stack.layers < 1) return misfit(name + " is empty");
  if (stack.coefficients.size() != items * perItem * static_cast<std::size_t>(stack.bits / 8) ||
      stack.ranges.size() != perItem || stack.surface.size() != texels * 4 || stack.sky.size() != texels * 2 ||
      (!stack.transmission.empty() && stack.transmission.size() != texels * 4))
    return misfit(name + " has arrays of the wrong size");
  return {};
}

Result<void> checkSlices(const bake::GroundBake& ground) {
  SWARD_TRY(checkStack(ground.slices, "slices"));
  SWARD_TRY(checkStack(ground.soil, "soil"));
  const int tiles = static_cast<int>(ground.tiles.tiles.size());
  if (tiles < 1 || tiles > 255) return misfit("there are " + std::to_string(tiles) + " tiles");
  for (const lpt::LayerStack* stack : {&ground.slices, &ground.soil})
    if (stack->width != ground.tiles.side() || stack->height != ground.tiles.side() || stack->images != tiles)
      return misfit("tiles have other sizes than their layers");
  if (ground.soil.layers != 1) return misfit("the soil has several layers");
  if (ground.tiles.resolution < 2 || ground.tiles.resolution % 2 != 0) return misfit("a tile has an odd side");
  const tiles::TileMap& map = ground.map;
  // Shaders count the map's words, borders and all, in floats, which are exact up to 2^24.
  if (map.width < 1 || map.height < 1 || map.width > kMaxMapSide || map.height > kMaxMapSide ||
      map.tiles.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height))
    return misfit("the tile map is empty or longer than " + std::to_string(kMaxMapSide) + " cells");
  if (std::any_of(map.tiles.begin(), map.tiles.end(), [&](std::uint8_t tile) { return tile >= tiles; }))
    return misfit("the tile map names a tile that is not there");
  return {};
}

Result<void> checkBlades(const bake::GroundBake& ground) {
  const tiles::TileSet& set = ground.tiles;
  const int blades = ground.bladesPerPatch;
  if (blades < 1 || set.patchResolution < 1 || set.patchResolution % blades != 0)
    return misfit("blade slabs do not divide the patch");
  const int slabTexels = set.patchResolution / blades;
  if (set.resolution % slabTexels != 0) return misfit("blade slabs do not divide a tile");
  const lpt::LayerStack& first = ground.blades[0];
  for (const lpt::LayerStack& side : ground.blades) {
    SWARD_TRY(checkStack(side, "blades"));
    if (side.images != 1 || side.layers != blades || side.width != first.width || side.height != first.height)
      return misfit("blade sets have different sizes");
  }
  if (first.width % set.patchResolution != 0 || first.width % 2 != 0)
    return misfit("blade texels are no multiple of slice texels");
  const std::size_t owners = 2 * set.tiles.size() * static_cast<std::size_t>(set.resolution / slabTexels) *
                             static_cast<std::size_t>(set.resolution);
  if (ground.bladeOwners.size() != owners) return misfit("blade owners are missing");
  for (const tiles::BladeOwner& owner : ground.bladeOwners)
    if (owner.slab >= blades || owner.position >= set.patchResolution) return misfit("a blade owner is off the patch");
  return {};
}

}  // namespace

bool bladesPresent(const bake::GroundBake& ground) {
  return !ground.blades[0].surface.empty();
}

Result<void> checkGround(const bake::GroundBake& ground) {
  SWARD_TRY(checkSlices(ground));
  if (bladesPresent(ground)) SWARD_TRY(checkBlades(ground));
  return {};
}

}  // namespace sward::render
