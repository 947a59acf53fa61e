#include "bake/memory_cache.h"

#include <utility>

namespace sward::bake {

void MemoryCache::drop(std::list<Entry>::iterator entry) {
  m_bytes -= entry->bytes;
  m_entries.erase(entry->key);
  m_order.erase(entry);
}

void MemoryCache::put(const base::Hash128& key, std::shared_ptr<const void> value, std::uint64_t bytes) {
  if (const auto found = m_entries.find(key); found != m_entries.end()) drop(found->second);
  if (bytes > m_limitBytes) return;
  while (m_bytes + bytes > m_limitBytes) drop(std::prev(m_order.end()));
  m_order.push_front({key, std::move(value), bytes});
  m_entries[key] = m_order.begin();
  m_bytes += bytes;
}

}  // namespace sward::bake
