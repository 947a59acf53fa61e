#include "impostor/quadtree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <utility>

namespace sward::impostor {
namespace {

constexpr int kLargestAtlas = 16384;

bool isPowerOfTwo(int value) {
  return value > 0 && std::has_single_bit(static_cast<unsigned>(value));
}

/// Nodes of a full tree with this many levels under the root.
std::size_t nodeCount(int deepest) {
  return ((std::size_t{1} << (2 * (deepest + 1))) - 1) / 3;
}

}  // namespace

Result<QuadtreeAtlas> QuadtreeAtlas::create(int size, int smallest) {
  if (!isPowerOfTwo(size) || !isPowerOfTwo(smallest) || smallest > size || size > kLargestAtlas) {
    return Error::badInput("an atlas of " + std::to_string(size) + " texels with regions of " +
                               std::to_string(smallest) + " cannot be halved",
                           "impostor atlas",
                           "Give powers of two: regions no larger than the atlas, the atlas 16384 at most");
  }
  return QuadtreeAtlas(size, std::countr_zero(static_cast<unsigned>(size / smallest)));
}

QuadtreeAtlas::QuadtreeAtlas(int size, int deepest) : m_size(size), m_deepest(deepest) {
  m_room.reserve(nodeCount(deepest));
  for (int level = 0; level <= deepest; ++level) {
    m_room.insert(m_room.end(), std::size_t{1} << (2 * level), whole(level));
  }
}

int QuadtreeAtlas::levelOf(int size) const {
  const int rounded = std::max(static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))), smallest());
  return std::countr_zero(static_cast<unsigned>(m_size / rounded));
}

QuadtreeAtlas::Node QuadtreeAtlas::child(const Node& node, int i) const {
  const int half = sizeOf(node.level + 1);
  return {4 * node.index + 1 + static_cast<std::size_t>(i), node.level + 1, node.x + (i & 1) * half,
          node.y + (i >> 1) * half};
}

/// Whether a node is neither free as a whole nor taken as a whole.
bool QuadtreeAtlas::isSplit(const Node& node) const {
  return m_room[node.index] != kTaken && m_room[node.index] != whole(node.level);
}

/// From a changed node's parent up to the root.
void QuadtreeAtlas::update(std::size_t index, int level) {
  while (index > 0) {
    index = (index - 1) / 4;
    --level;
    std::uint8_t least = kTaken, most = 0;
    for (std::size_t i = 1; i <= 4; ++i) {
      const std::uint8_t below = room(4 * index + i);
      least = std::min(least, below);
      most = std::max(most, below);
    }
    m_room[index] = least == whole(level + 1) ? whole(level) : most;
  }
}

std::optional<AtlasRegion> QuadtreeAtlas::allocate(int size) {
  if (size < 1 || size > m_size) return std::nullopt;
  const int level = levelOf(size);
  if (room(0) < whole(level)) return std::nullopt;
  Node node;
  while (node.level < level) {
    int tightest = -1;
    std::uint8_t least = kTaken;
    for (int i = 0; i < 4; ++i) {
      const Node below = child(node, i);
      const std::uint8_t here = room(below.index);
      if (here >= whole(level) && here < least) least = here, tightest = i;
    }
    node = child(node, tightest);
  }
  m_room[node.index] = kTaken;
  update(node.index, node.level);
  m_taken += static_cast<std::uint64_t>(sizeOf(level)) * static_cast<std::uint64_t>(sizeOf(level));
  return regionOf(node);
}

bool QuadtreeAtlas::release(const AtlasRegion& region) {
  const bool fits = isPowerOfTwo(region.size) && region.size >= smallest() && region.size <= m_size && region.x >= 0 &&
                    region.y >= 0 && region.x < m_size && region.y < m_size && region.x % region.size == 0 &&
                    region.y % region.size == 0;
  if (!fits) return false;
  Node node;
  while (sizeOf(node.level) > region.size) {
    if (m_room[node.index] == kTaken) return false;
    const int half = sizeOf(node.level + 1);
    node = child(node, (region.x >= node.x + half ? 1 : 0) + (region.y >= node.y + half ? 2 : 0));
  }
  if (m_room[node.index] != kTaken) return false;
  m_room[node.index] = whole(node.level);
  update(node.index, node.level);
  m_taken -= static_cast<std::uint64_t>(region.size) * static_cast<std::uint64_t>(region.size);
  return true;
}

int QuadtreeAtlas::largestFree() const {
  return room(0) == 0 ? 0 : smallest() << (room(0) - 1);
}

void QuadtreeAtlas::gather(const Node& node, std::vector<AtlasRegion>& out) const {
  if (m_room[node.index] == kTaken) {
    out.push_back(regionOf(node));
  } else if (isSplit(node) && node.level < m_deepest) {
    for (int i = 0; i < 4; ++i) gather(child(node, i), out);
  }
}

std::vector<AtlasRegion> QuadtreeAtlas::taken() const {
  std::vector<AtlasRegion> out;
  gather({}, out);
  return out;
}

void QuadtreeAtlas::weigh(const Node& node, int level, double most,
                          const std::function<double(const AtlasRegion&)>& worth, std::optional<Eviction>& best) const {
  if (isSplit(node) && node.level < level) {
    for (int i = 0; i < 4; ++i) weigh(child(node, i), level, most, worth, best);
    return;
  }
  // A region over the square that is sought goes as a whole; a free square costs nothing.
  Eviction eviction;
  gather(node, eviction.regions);
  eviction.worth = -std::numeric_limits<double>::infinity();
  for (const AtlasRegion& region : eviction.regions) eviction.worth = std::max(eviction.worth, worth(region));
  if (eviction.worth > most) return;
  if (!best || eviction.worth < best->worth) best = std::move(eviction);
}

std::optional<QuadtreeAtlas::Eviction> QuadtreeAtlas::cheapest(
    int size, double most, const std::function<double(const AtlasRegion&)>& worth) const {
  if (size < 1 || size > m_size) return std::nullopt;
  std::optional<Eviction> best;
  weigh({}, levelOf(size), most, worth, best);
  return best;
}

}  // namespace sward::impostor
