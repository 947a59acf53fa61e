#pragma once

#include "bake/memory_size.h"
#include "bake/session.h"

#include <utility>

/// Private to the sources of Session: how the result of any node is found, made and kept.
namespace sward::bake {

template <typename T>
std::shared_ptr<const T> Session::findOnDisk(const std::string& kind, const base::Hash128& key, Keep keep,
                                             NodeReport& report) {
  if constexpr (requires(base::ByteReader & in, T & value) { load(in, value); }) {
    if (!m_disk) return nullptr;
    const auto payload = m_disk->get(kind, key);
    auto value = payload ? fromPayload<T>(*payload) : std::nullopt;
    if (!value) return nullptr;
    if (report.state == NodeReport::State::Skipped) report.state = NodeReport::State::FromDisk;
    report.bytes = payload->size();
    auto shared = std::make_shared<const T>(std::move(*value));
    m_held[key] = shared;
    if (keep == Keep::MemoryAndDisk) m_memory.put(key, shared, memoryBytes(*shared));
    return shared;
  }
  return nullptr;
}

template <typename T>
std::shared_ptr<const T> Session::find(const std::string& kind, const base::Hash128& key, Keep keep,
                                       NodeReport& report) {
  if (auto held = m_held[key].lock()) return std::static_pointer_cast<const T>(held);
  if (keep == Keep::Memory || keep == Keep::MemoryAndDisk) {
    if (auto value = m_memory.get<T>(key)) {
      if (report.state == NodeReport::State::Skipped) report.state = NodeReport::State::FromMemory;
      m_held[key] = value;
      return value;
    }
  }
  if (keep == Keep::Disk || keep == Keep::MemoryAndDisk) return findOnDisk<T>(kind, key, keep, report);
  return nullptr;
}

template <typename T>
void Session::remember(const std::string& kind, const base::Hash128& key, Keep keep, const Shared<T>& value,
                       NodeReport& report) {
  m_held[key] = value;
  report.bytes = memoryBytes(*value);
  if constexpr (requires(base::ByteWriter & out) { save(out, *value); }) {
    if (m_disk && (keep == Keep::Disk || keep == Keep::MemoryAndDisk)) {
      const std::vector<std::byte> payload = payloadOf(*value);
      report.bytes = payload.size();
      if (const auto stored = m_disk->put(kind, key, payload); !stored.ok()) {
        // The result is still good; only the next run has to make it again. One message is enough.
        if (!std::exchange(m_storeFailed, true)) m_report.warnings.push_back(stored.error().text());
      }
    }
  }
  if (keep == Keep::Memory || keep == Keep::MemoryAndDisk) m_memory.put(key, value, memoryBytes(*value));
}

template <typename T, typename Make>
Result<std::shared_ptr<const T>> Session::node(const std::string& kind, const std::string& what,
                                               const base::Hash128& key, Keep keep, const Make& make) {
  if (m_job.cancelled()) return Error::cancelled();
  const std::size_t index = indexOf(kind, what);
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  if (auto found = find<T>(kind, key, keep, m_report.nodes[index])) {
    m_report.nodes[index].seconds += elapsed();
    m_childSeconds += elapsed();
    return found;
  }
  const double outerChildren = std::exchange(m_childSeconds, 0.0);
  Result<T> made = make(jobOf(index));
  if (!made.ok()) return std::move(made).error();
  // Loops that were cancelled leave ranges out without saying so: such a result must never be kept.
  if (m_job.cancelled()) return Error::cancelled();
  NodeReport& report = m_report.nodes[index];
  report.state = NodeReport::State::Baked;
  auto value = std::make_shared<const T>(std::move(made).value());
  remember<T>(kind, key, keep, value, report);
  const double seconds = elapsed();
  report.seconds += seconds - m_childSeconds;
  m_childSeconds = outerChildren + seconds;
  return value;
}

}  // namespace sward::bake
