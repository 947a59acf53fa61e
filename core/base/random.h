#pragma once

#include <cstdint>

namespace sward::base {

/// A counter-based mix of 64 bits (the finaliser of SplitMix64, Steele et al. 2014): statistically good, stateless, and
/// so the same on any number of threads.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Combines a seed with up to three indices into one well-mixed value.
constexpr std::uint64_t mix64(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0) {
  return mix64(mix64(mix64(mix64(seed) ^ a) ^ b) ^ c);
}

/// Uniform in [0, 1) from the top 24 bits: every value is exact in float.
constexpr float unitFloat(std::uint64_t bits) {
  return static_cast<float>(bits >> 40) * 0x1.0p-24f;
}
constexpr double unitDouble(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

/// A small sequential generator (SplitMix64) for scattering and growing: one per object, seeded by mix64(seed, index).
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) : m_state(seed) {}
  constexpr std::uint64_t next() {
    const std::uint64_t value = mix64(m_state);
    m_state += 0x9e3779b97f4a7c15ULL;
    return value;
  }
  /// Uniform in [0, 1).
  constexpr double uniform() { return unitDouble(next()); }
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal (Box-Muller, one of the pair).
  double normal();
  /// Uniform in {0, ..., count - 1}; count > 0.
  constexpr std::uint32_t index(std::uint32_t count) {
    return static_cast<std::uint32_t>(((next() >> 32) * count) >> 32);
  }

 private:
  std::uint64_t m_state;
};

}  // namespace sward::base
