#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace sward::impostor {

/// A square of an atlas, in texels; `size` is a power of two and x and y are multiples of it.
struct AtlasRegion {
  int x = 0, y = 0, size = 0;
  bool operator==(const AtlasRegion&) const = default;
};

/// Which squares of an atlas are taken (forest paper: each atlas is a quadtree whose leaves hold one impostor each).
///
/// A buddy allocator in four: a node is free as a whole, taken, or split in four. Of every node one byte is kept, the
/// size that can still be taken at or under it, so that a place is found, and a release makes whole again what can be,
/// in as many steps as the tree is deep. Requests go where they fit most tightly, then to the lower Morton code: the
/// same requests take the same places.
class QuadtreeAtlas {
 public:
  /// `size`: texels along each side; `smallest`: of a region. Errors: no powers of two, or not
  /// 1 <= smallest <= size <= 16384.
  static Result<QuadtreeAtlas> create(int size, int smallest);

  /// A region at least `size` texels wide (the next power of two, `smallest` at least); none if there is no such free
  /// square, or `size` is under 1 or above the atlas's.
  std::optional<AtlasRegion> allocate(int size);
  /// Gives a region back. False, and nothing changes, if it is not one that allocate() gave and that is still taken.
  bool release(const AtlasRegion& region);

  /// The square at least `size` wide whose taken regions are the least missed, and what stands in it; `age` gives the
  /// worth of a taken region (its last use, say), and a square counts as much as the worthiest region in it or over
  /// it. Regions worth more than `most` stay. None if every such square holds one that stays.
  struct Eviction {
    std::vector<AtlasRegion> regions;
    double worth = 0.0;
  };
  std::optional<Eviction> cheapest(int size, double most, const std::function<double(const AtlasRegion&)>& worth) const;

  int size() const { return m_size; }
  int smallest() const { return m_size >> m_deepest; }
  std::uint64_t takenTexels() const { return m_taken; }
  /// Widest region that allocate() would give now; 0: full.
  int largestFree() const;
  /// All taken regions, in Morton order.
  std::vector<AtlasRegion> taken() const;

 private:
  /// What can still be taken at or under a node of level l: 0 nothing, else 1 + the levels that the largest free square
  /// stands above the smallest. kTaken marks a node that is a region itself.
  static constexpr std::uint8_t kTaken = 255;
  struct Node {
    std::size_t index = 0;  ///< the children of i are 4 i + 1 to 4 i + 4
    int level = 0;          ///< 0 the root
    int x = 0, y = 0;       ///< texels
  };
  QuadtreeAtlas(int size, int deepest);
  std::uint8_t whole(int level) const { return static_cast<std::uint8_t>(m_deepest - level + 1); }
  std::uint8_t room(std::size_t index) const { return m_room[index] == kTaken ? std::uint8_t{0} : m_room[index]; }
  int levelOf(int size) const;
  int sizeOf(int level) const { return m_size >> level; }
  Node child(const Node& node, int i) const;
  AtlasRegion regionOf(const Node& node) const { return {node.x, node.y, sizeOf(node.level)}; }
  bool isSplit(const Node& node) const;
  void update(std::size_t index, int level);
  void gather(const Node& node, std::vector<AtlasRegion>& out) const;
  void weigh(const Node& node, int level, double most, const std::function<double(const AtlasRegion&)>& worth,
             std::optional<Eviction>& best) const;

  int m_size = 0, m_deepest = 0;
  std::vector<std::uint8_t> m_room;
  std::uint64_t m_taken = 0;
};

}  // namespace sward::impostor
