#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace sward::base {

/// A 128-bit content hash (XXH3). Not cryptographic: it names cache entries, it does not authenticate them.
struct Hash128 {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  bool operator==(const Hash128&) const = default;
  auto operator<=>(const Hash128&) const = default;
  /// 32 lower-case hexadecimal digits.
  std::string hex() const;
};

/// Hashes values in the order given. Strings and spans enter with their length, so that ("ab","c") != ("a","bc").
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  Hasher& bytes(std::span<const std::byte> data);
  Hasher& add(std::string_view text);
  Hasher& add(const Hash128& hash);
  template <typename T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) Hasher& add(T value) {
    // -0.0 and 0.0 are equal values and must give equal keys.
    if constexpr (std::is_floating_point_v<T>) value = value == T(0) ? T(0) : value;
    return raw(&value, sizeof(value));
  }
  Hash128 finish() const;

 private:
  Hasher& raw(const void* data, std::size_t size);
  struct State;
  std::unique_ptr<State> m_state;
};

Hash128 hashBytes(std::span<const std::byte> data);

}  // namespace sward::base
