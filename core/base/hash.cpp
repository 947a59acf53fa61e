#include "base/hash.h"

#include <cstdio>
#include <new>

#define XXH_STATIC_LINKING_ONLY
#include <xxhash.h>

namespace sward::base {

struct alignas(64) Hasher::State {
  XXH3_state_t xxh;
};

std::string Hash128::hex() const {
  char text[33];
  std::snprintf(text, sizeof(text), "%016llx%016llx", static_cast<unsigned long long>(high),
                static_cast<unsigned long long>(low));
  return text;
}

Hasher::Hasher() : m_state(std::make_unique<State>()) {
  XXH3_128bits_reset(&m_state->xxh);
}
Hasher::~Hasher() = default;
Hasher::Hasher(Hasher&&) noexcept = default;
Hasher& Hasher::operator=(Hasher&&) noexcept = default;

Hasher& Hasher::raw(const void* data, std::size_t size) {
  XXH3_128bits_update(&m_state->xxh, data, size);
  return *this;
}

Hasher& Hasher::bytes(std::span<const std::byte> data) {
  add(static_cast<std::uint64_t>(data.size()));
  return raw(data.data(), data.size());
}

Hasher& Hasher::add(std::string_view text) {
  return bytes(std::as_bytes(std::span(text)));
}
Hasher& Hasher::add(const Hash128& hash) {
  return add(hash.high).add(hash.low);
}

Hash128 Hasher::finish() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(&m_state->xxh);
  return {hash.high64, hash.low64};
}

Hash128 hashBytes(std::span<const std::byte> data) {
  const XXH128_hash_t hash = XXH3_128bits(data.data(), data.size());
  return {hash.high64, hash.low64};
}

}  // namespace sward::base
