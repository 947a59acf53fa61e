#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace sward::base {

/// Two numbers parted by `separator`, with nothing else around them, such as "1280x720"; whatever the locale.
template <typename T>
std::optional<std::pair<T, T>> twoNumbers(std::string_view text, char separator) {
  std::pair<T, T> numbers;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, numbers.first);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != separator) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, numbers.second);
  if (second.ec != std::errc{} || second.ptr != end) return std::nullopt;
  return numbers;
}

}  // namespace sward::base
