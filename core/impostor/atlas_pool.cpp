#include "impostor/atlas_pool.h"

#include <string>
#include <utility>

namespace sward::impostor {

std::uint64_t AtlasPool::bytesOfAtlas() const {
  return static_cast<std::uint64_t>(m_budget.atlasSize) * static_cast<std::uint64_t>(m_budget.atlasSize) *
         m_budget.bytesPerTexel;
}

Result<AtlasPool> AtlasPool::create(const AtlasBudget& budget) {
  SWARD_TRY(QuadtreeAtlas::create(budget.atlasSize, budget.smallest));
  AtlasPool pool(budget);
  if (pool.bytesOfAtlas() > budget.bytes) {
    return Error::badInput("an atlas of " + std::to_string(budget.atlasSize) + " texels takes " +
                               std::to_string(pool.bytesOfAtlas()) + " bytes, more than the " +
                               std::to_string(budget.bytes) + " that impostors may take",
                           "impostor memory", "Give more memory or a smaller atlas");
  }
  return pool;
}

/// No two taken regions share their first texel.
std::uint64_t AtlasPool::key(const Place& place) {
  return static_cast<std::uint64_t>(place.atlas) << 32 | static_cast<std::uint64_t>(place.region.y) << 16 |
         static_cast<std::uint64_t>(place.region.x);
}

AtlasPool::Allocation AtlasPool::enter(int atlas, const AtlasRegion& region, std::uint64_t frame) {
  const Allocation made{m_next++, {atlas, region}, {}};
  m_entries[made.id] = {made.place, frame};
  m_ids[key(made.place)] = made.id;
  return made;
}

std::optional<AtlasPool::Allocation> AtlasPool::allocate(int size, std::uint64_t frame) {
  if (size < 1 || size > m_budget.atlasSize) return std::nullopt;
  for (std::size_t i = 0; i < m_atlases.size(); ++i) {
    if (const auto region = m_atlases[i].allocate(size)) return enter(static_cast<int>(i), *region, frame);
  }
  if ((m_atlases.size() + 1) * bytesOfAtlas() <= m_budget.bytes) {
    m_atlases.push_back(QuadtreeAtlas::create(m_budget.atlasSize, m_budget.smallest).value());
    const auto region = m_atlases.back().allocate(size);
    return enter(static_cast<int>(m_atlases.size()) - 1, *region, frame);
  }
  std::vector<Id> evicted;
  if (!makeRoom(size, frame, evicted)) return std::nullopt;
  std::optional<Allocation> made = allocate(size, frame);
  made->evicted = std::move(evicted);
  return made;
}

/// Clears the square whose pictures were drawn the longest time ago, before `frame`.
bool AtlasPool::makeRoom(int size, std::uint64_t frame, std::vector<Id>& evicted) {
  if (frame == 0) return false;
  std::optional<QuadtreeAtlas::Eviction> best;
  std::size_t where = 0;
  for (std::size_t i = 0; i < m_atlases.size(); ++i) {
    const auto lastDrawn = [&](const AtlasRegion& region) {
      return static_cast<double>(m_entries.at(m_ids.at(key({static_cast<int>(i), region}))).frame);
    };
    auto found = m_atlases[i].cheapest(size, static_cast<double>(frame - 1), lastDrawn);
    if (found && (!best || found->worth < best->worth)) best = std::move(found), where = i;
  }
  if (!best) return false;
  for (const AtlasRegion& region : best->regions) {
    const Id id = m_ids.at(key({static_cast<int>(where), region}));
    evicted.push_back(id);
    release(id);
  }
  return true;
}

bool AtlasPool::touch(Id id, std::uint64_t frame) {
  const auto found = m_entries.find(id);
  if (found == m_entries.end()) return false;
  if (frame > found->second.frame) found->second.frame = frame;
  return true;
}

bool AtlasPool::release(Id id) {
  const auto found = m_entries.find(id);
  if (found == m_entries.end()) return false;
  const Place place = found->second.place;
  m_atlases[static_cast<std::size_t>(place.atlas)].release(place.region);
  m_ids.erase(key(place));
  m_entries.erase(found);
  return true;
}

std::optional<AtlasPool::Place> AtlasPool::find(Id id) const {
  const auto found = m_entries.find(id);
  return found == m_entries.end() ? std::nullopt : std::optional(found->second.place);
}

std::uint64_t AtlasPool::bytes() const {
  return m_atlases.size() * bytesOfAtlas();
}

double AtlasPool::occupancy() const {
  if (m_atlases.empty()) return 0.0;
  double taken = 0.0;
  for (const QuadtreeAtlas& atlas : m_atlases) taken += static_cast<double>(atlas.takenTexels());
  const auto side = static_cast<double>(m_budget.atlasSize);
  return taken / (side * side * static_cast<double>(m_atlases.size()));
}

}  // namespace sward::impostor
