#pragma once

#include "base/hash.h"

#include <cstdint>
#include <list>
#include <map>
#include <memory>

namespace sward::bake {

/// Results held in memory, of any type, up to a number of bytes; the least recently used go first. A key belongs to one
/// type for ever (kinds enter keys). What is in use elsewhere lives on when it leaves the cache.
class MemoryCache {
 public:
  explicit MemoryCache(std::uint64_t limitBytes) : m_limitBytes(limitBytes) {}

  template <typename T>
  std::shared_ptr<const T> get(const base::Hash128& key) {
    const auto found = m_entries.find(key);
    if (found == m_entries.end()) return nullptr;
    m_order.splice(m_order.begin(), m_order, found->second);
    return std::static_pointer_cast<const T>(found->second->value);
  }
  /// Keeps a value of about `bytes`; one larger than the whole limit is not kept.
  void put(const base::Hash128& key, std::shared_ptr<const void> value, std::uint64_t bytes);
  /// Without counting as a use.
  bool contains(const base::Hash128& key) const { return m_entries.contains(key); }
  std::uint64_t size() const { return m_bytes; }

 private:
  struct Entry {
    base::Hash128 key;
    std::shared_ptr<const void> value;
    std::uint64_t bytes = 0;
  };
  void drop(std::list<Entry>::iterator entry);

  std::uint64_t m_limitBytes;
  std::uint64_t m_bytes = 0;
  std::list<Entry> m_order;  ///< most recently used first
  std::map<base::Hash128, std::list<Entry>::iterator> m_entries;
};

}  // namespace sward::bake
