#pragma once

namespace sward::trace {

/// floor of a number that fits an int, without the call that std::floor is on processors before SSE4.1.
inline int floorOf(float value) {
  const int truncated = static_cast<int>(value);
  return static_cast<float>(truncated) > value ? truncated - 1 : truncated;
}

}  // namespace sward::trace
