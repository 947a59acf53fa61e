#pragma once

#include "base/result.h"
#include "impostor/quadtree.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace sward::impostor {

/// How much memory impostors may take.
struct AtlasBudget {
  int atlasSize = 2048;             ///< texels along each side: a power of two, 16384 at most
  int smallest = 16;                ///< of a region, a power of two
  std::uint64_t bytesPerTexel = 8;  ///< of all textures of an atlas together, with their mips
  std::uint64_t bytes = 0;          ///< of all atlases; room for one at least
};

/// Several quadtree atlases under a memory budget (forest paper: a full atlas opens another). A picture stays until it
/// is given back or another needs its place: then the square goes whose pictures were drawn the longest time ago, and
/// never one that was drawn in the present frame.
class AtlasPool {
 public:
  using Id = std::uint32_t;  ///< of a picture; never used again
  struct Place {
    int atlas = 0;
    AtlasRegion region;
    bool operator==(const Place&) const = default;
  };
  struct Allocation {
    Id id = 0;
    Place place;
    std::vector<Id> evicted;  ///< pictures that had to go
  };

  /// Errors: no powers of two; a budget that holds no atlas.
  static Result<AtlasPool> create(const AtlasBudget& budget);

  /// A place at least `size` texels wide, drawn in `frame`. None if the size is under 1 or above an atlas's, or all
  /// that is there was drawn in `frame`: then nothing changes, and the caller draws something smaller.
  std::optional<Allocation> allocate(int size, std::uint64_t frame);
  /// Notes that a picture was drawn in `frame`, no earlier than before. False if it is gone.
  bool touch(Id id, std::uint64_t frame);
  /// Gives a picture's place back. False if it is gone.
  bool release(Id id);
  std::optional<Place> find(Id id) const;

  std::size_t pictures() const { return m_entries.size(); }
  std::size_t atlases() const { return m_atlases.size(); }
  const QuadtreeAtlas& atlas(std::size_t i) const { return m_atlases[i]; }
  std::uint64_t bytes() const;
  double occupancy() const;  ///< share of the open atlases' texels that is taken, 0 to 1

 private:
  struct Entry {
    Place place;
    std::uint64_t frame = 0;
  };
  explicit AtlasPool(const AtlasBudget& budget) : m_budget(budget) {}
  std::uint64_t bytesOfAtlas() const;
  static std::uint64_t key(const Place& place);
  Allocation enter(int atlas, const AtlasRegion& region, std::uint64_t frame);
  bool makeRoom(int size, std::uint64_t frame, std::vector<Id>& evicted);

  AtlasBudget m_budget;
  std::vector<QuadtreeAtlas> m_atlases;
  std::unordered_map<Id, Entry> m_entries;
  std::unordered_map<std::uint64_t, Id> m_ids;  ///< of the picture at a place
  Id m_next = 1;
};

}  // namespace sward::impostor
