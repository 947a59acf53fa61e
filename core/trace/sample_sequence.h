#pragma once

#include "base/random.h"

#include <cstdint>

#include <glm/glm.hpp>

/// Private to core/trace: low-discrepancy points of path samples.
namespace sward::trace {

constexpr std::uint32_t reversedBits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
}

/// Owen's nested uniform scrambling of a number whose bits are reversed, by a hash in which higher bits depend on lower
/// ones alone (Laine and Karras 2011, with Vegdahl's constants; Burley 2020, "Practical Hash-based Owen Scrambling").
constexpr std::uint32_t scrambledReversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Second dimension of Sobol's sequence; the first is the index with its bits reversed.
constexpr std::uint32_t sobolSecond(std::uint32_t index) {
  std::uint32_t result = 0;
  for (std::uint32_t v = 1u << 31; index != 0; index >>= 1, v ^= v >> 1) {
    if ((index & 1u) != 0) result ^= v;
  }
  return result;
}

/// Pairs of numbers for the dimensions of one sample: each pair is Sobol's (0, 2)-sequence, shuffled and Owen-scrambled
/// with seeds of its own (padding), so that any aligned 2^k samples of a sequence are stratified in every pair and
/// pairs are independent of each other.
class SampleSequence {
 public:
  SampleSequence(std::uint64_t seed, std::uint32_t index) : m_seed(seed), m_index(reversedBits(index)) {}

  glm::dvec2 pair(std::uint32_t dimension) const {
    const std::uint64_t one = base::mix64(m_seed ^ (dimension + 1) * 0x9e3779b97f4a7c15ULL);
    const std::uint64_t two = base::mix64(one);
    const std::uint32_t index = reversedBits(scrambledReversed(m_index, static_cast<std::uint32_t>(one)));
    // The first dimension's bits reversed are the index itself.
    const std::uint32_t x = reversedBits(scrambledReversed(index, static_cast<std::uint32_t>(one >> 32)));
    const std::uint32_t y =
        reversedBits(scrambledReversed(reversedBits(sobolSecond(index)), static_cast<std::uint32_t>(two >> 32)));
    return {x * 0x1.0p-32, y * 0x1.0p-32};
  }

 private:
  std::uint64_t m_seed;
  std::uint32_t m_index;  ///< reversed
};

}  // namespace sward::trace
