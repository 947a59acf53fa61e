#include "bake/ground_plan.h"

namespace sward::bake {

namespace {

/// A patch that repeats as it is: one tile that covers it.
trace::GroundPlan repeatedPatch(const GroundBake& ground, int texels) {
  trace::GroundPlan plan;
  plan.patchSideM = ground.patchSideM;
  plan.patchTexels = plan.tileTexels = texels;
  plan.offsets.emplace_back();
  plan.offsets.back().fill(glm::ivec2(0));
  plan.owner.assign(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels), 0);
  plan.map = {0};
  return plan;
}

}  // namespace

trace::GroundPlan groundPlan(const GroundBake& ground) {
  if (ground.texels) return repeatedPatch(ground, ground.texels->grid().columns);
  const tiles::TileSet& set = ground.tiles;
  trace::GroundPlan plan;
  plan.patchSideM = ground.patchSideM;
  plan.patchTexels = set.patchResolution;
  plan.tileTexels = set.resolution;
  for (std::size_t tile = 0; tile < set.tiles.size(); ++tile) {
    auto& offsets = plan.offsets.emplace_back();
    for (const tiles::Edge edge : {tiles::kSouth, tiles::kWest, tiles::kNorth, tiles::kEast}) {
      offsets[edge] = set.patchOffset(static_cast<int>(tile), edge);
    }
  }
  plan.owner = set.owner;
  plan.mapWidth = ground.map.width;
  plan.mapHeight = ground.map.height;
  plan.map = ground.map.tiles;
  return plan;
}

}  // namespace sward::bake
