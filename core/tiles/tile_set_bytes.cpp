#include "tiles/layout.h"
#include "tiles/tile_set.h"

#include <algorithm>
#include <cmath>

namespace sward::tiles {

namespace {

constexpr std::uint32_t kMagic = 0x31535453;  // "STS1"

bool validShape(const TileSet& set) {
  return set.resolution >= 2 && set.resolution <= 4096 && set.resolution % 2 == 0 && set.apron >= 0 &&
         set.apron <= set.resolution / 2 && set.coloursPerAxis >= 1 && set.coloursPerAxis <= 4 &&
         set.patchResolution >= 1 && set.patchResolution <= 65535;
}

bool validTiles(const TileSet& set) {
  const auto pairs = static_cast<std::size_t>(set.coloursPerAxis * set.coloursPerAxis);
  const std::size_t perPair = set.tiles.size() / pairs;
  if (set.tiles.size() % pairs != 0 || perPair < 1 || perPair > pairs) return false;
  const std::vector<Tile> expected = tileColours(set.coloursPerAxis, static_cast<int>(perPair));
  return std::equal(expected.begin(), expected.end(), set.tiles.begin(),
                    [](const Tile& a, const Tile& b) { return a.edges == b.edges; });
}

bool validContent(const TileSet& set) {
  const auto side = static_cast<std::size_t>(set.resolution);
  const auto onPatch = [&](glm::ivec2 p) {
    return p.x >= 0 && p.y >= 0 && p.x < set.patchResolution && p.y < set.patchResolution;
  };
  return set.diamonds.size() == 2 * static_cast<std::size_t>(set.coloursPerAxis) &&
         std::all_of(set.diamonds.begin(), set.diamonds.end(), onPatch) &&
         set.owner.size() == set.tiles.size() * side * side &&
         std::all_of(set.owner.begin(), set.owner.end(), [](std::uint8_t edge) { return edge < 4; }) &&
         set.seamCosts.size() == set.tiles.size() &&
         std::all_of(set.seamCosts.begin(), set.seamCosts.end(), [](double c) { return std::isfinite(c) && c >= 0.0; });
}

}  // namespace

void save(base::ByteWriter& out, const TileSet& set) {
  out.value(kMagic);
  for (const int value : {set.resolution, set.apron, set.coloursPerAxis, set.patchResolution}) {
    out.value(static_cast<std::int32_t>(value));
  }
  out.array(set.tiles);
  out.array(set.diamonds);
  out.array(set.owner);
  out.array(set.seamCosts);
}

bool load(base::ByteReader& in, TileSet& set) {
  std::uint32_t magic = 0;
  TileSet read;
  in.value(magic);
  for (int* value : {&read.resolution, &read.apron, &read.coloursPerAxis, &read.patchResolution}) {
    std::int32_t stored = 0;
    in.value(stored);
    *value = stored;
  }
  in.array(read.tiles);
  in.array(read.diamonds);
  in.array(read.owner);
  in.array(read.seamCosts);
  const bool good = in.ok() && magic == kMagic && validShape(read) && validTiles(read) && validContent(read);
  set = good ? std::move(read) : TileSet{};
  return good;
}

}  // namespace sward::tiles
