#include "report/markup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace sward::report {
namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

/// Length of the code point that starts at the front of `text` when it is one that XML 1.0 holds (production 2,
/// "Char"); 0 when it is not.
std::size_t characterLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
  if (length == 0 || first > 0xf4 || text.size() < length) return 0;
  std::uint32_t point = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    point = (point << 6) | (byte(i) & 0x3f);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = point >= 0xd800 && point <= 0xdfff;
  const bool noCharacter = point == 0xfffe || point == 0xffff;
  return point < kLeast[length] || point > 0x10ffff || surrogate || noCharacter ? 0 : length;
}

std::string printed(const char* format, int decimals, double value) {
  std::array<char, 400> text{};  // 1e308 with decimals
  std::snprintf(text.data(), text.size(), format, decimals, value);
  return text.data();
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  while (!text.empty()) {
    const std::size_t length = characterLength(text);
    switch (text.front()) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += length == 0 ? kReplacement : text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string base64(std::span<const std::byte> data) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((data.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < data.size(); i += 3) {
    const std::size_t taken = std::min<std::size_t>(3, data.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = (bits << 8) | (k < taken ? std::to_integer<std::uint32_t>(data[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) out += k <= taken ? kDigits[(bits >> (18 - 6 * k)) & 63u] : '=';
  }
  return out;
}

std::size_t codePoints(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string fixedText(double value, int decimals) {
  std::string text = printed("%.*f", decimals, value);
  // "-0.00" says something that is not there.
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return text;
}

std::string figureText(double value, int significant) {
  if (!std::isfinite(value)) return "not finite";
  if (value == 0.0) return "0";
  // Rounded first: 0.09996 with three digits is 0.100, not 0.1000.
  const std::string rounded = printed("%.*e", significant - 1, value);
  const int exponent = std::atoi(rounded.c_str() + rounded.find('e') + 1);
  const bool whole = value == std::round(value) && std::abs(value) < 1e6;
  if (whole) return printed("%.*f", 0, value);
  if (exponent >= -4 && exponent < 7) return fixedText(value, std::max(0, significant - 1 - exponent));
  std::string mantissa = rounded.substr(0, rounded.find('e'));
  if (mantissa.find('.') != std::string::npos) mantissa.erase(mantissa.find_last_not_of(".0") + 1);
  return mantissa + "e" + std::to_string(exponent);
}

std::string prefixedText(double value) {
  constexpr std::array<const char*, 6> kPrefixes{"", "k", "M", "G", "T", "P"};
  std::size_t prefix = 0;
  // From 999.5 on, three digits would show 1000.
  while (std::abs(value) >= 999.5 && prefix + 1 < kPrefixes.size()) {
    value /= 1000.0;
    ++prefix;
  }
  const double shown = std::abs(value);
  const int decimals = shown >= 99.95 ? 0 : shown >= 9.995 ? 1 : 2;
  return (prefix == 0 && shown < 0.995 ? figureText(value) : fixedText(value, decimals)) + " " + kPrefixes[prefix];
}

}  // namespace sward::report
