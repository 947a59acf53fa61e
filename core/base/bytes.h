#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sward::base {

/// Writes plain values and arrays into one buffer, little-endian as the machine is; the payload of cache entries.
class ByteWriter {
 public:
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void value(const T& v) {
    const auto* p = reinterpret_cast<const std::byte*>(&v);
    m_data.insert(m_data.end(), p, p + sizeof(T));
  }
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void array(std::span<const T> values) {
    value(static_cast<std::uint64_t>(values.size()));
    const auto bytes = std::as_bytes(values);
    m_data.insert(m_data.end(), bytes.begin(), bytes.end());
  }
  template <typename T>
  void array(const std::vector<T>& values) {
    array(std::span<const T>(values));
  }
  void text(std::string_view s) { array(std::span<const char>(s.data(), s.size())); }
  std::vector<std::byte> take() { return std::move(m_data); }

 private:
  std::vector<std::byte> m_data;
};

/// Reads what ByteWriter wrote. A short or inconsistent buffer never reads out of bounds: ok() turns false and every
/// later value is empty, so that a damaged cache entry is simply rebuilt.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> data) : m_data(data) {}

  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void value(T& v) {
    if (!m_ok || m_data.size() < sizeof(T)) {
      m_ok = false;
      v = T{};
      return;
    }
    std::memcpy(&v, m_data.data(), sizeof(T));
    m_data = m_data.subspan(sizeof(T));
  }
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void array(std::vector<T>& values) {
    std::uint64_t count = 0;
    value(count);
    if (!m_ok || count > m_data.size() / sizeof(T)) {
      m_ok = false;
      values.clear();
      return;
    }
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), m_data.data(), count * sizeof(T));
    m_data = m_data.subspan(count * sizeof(T));
  }
  void text(std::string& s) {
    std::vector<char> chars;
    array(chars);
    s.assign(chars.begin(), chars.end());
  }
  bool ok() const { return m_ok; }
  /// True when everything was read and nothing is left over.
  bool finished() const { return m_ok && m_data.empty(); }

 private:
  std::span<const std::byte> m_data;
  bool m_ok = true;
};

}  // namespace sward::base
