#include "bake/ground_plan.h"

namespace sward::bake {

trace::GroundPlan groundPlan(const GroundBake& ground) {
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
