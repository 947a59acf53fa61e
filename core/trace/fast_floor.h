#pragma once

#include <cstdint>

namespace sward::trace {

/// floor of a number that fits an int, without the call that std::floor is on processors before SSE4.1.
inline int floorOf(float value) {
  const int truncated = static_cast<int>(value);
  return static_cast<float>(truncated) > value ? truncated - 1 : truncated;
}
/// The same for numbers below 2^53.
inline std::int64_t floorOf(double value) {
  const auto truncated = static_cast<std::int64_t>(value);
  return static_cast<double>(truncated) > value ? truncated - 1 : truncated;
}

/// A cell of a periodic row of `cells`; few lie outside of it, and most of those by one row.
inline int wrapped(int cell, int cells) {
  if (cell >= 0 && cell < cells) return cell;
  const int m = cell % cells;
  return m < 0 ? m + cells : m;
}

}  // namespace sward::trace
