#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace sward::report {

/// Text as it may stand in HTML and XML, between tags and in quoted attributes. What XML cannot hold (bytes that are
/// not UTF-8, control characters, surrogates) becomes U+FFFD, so that the result is always well-formed.
std::string escaped(std::string_view text);

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> data);

/// The number of code points of UTF-8 text; a byte that starts none counts as one.
std::size_t codePoints(std::string_view text);

/// A number for people, with about `significant` digits and no more than it has: "0.0123", "35.2", "1280", "2.1e-7".
/// Not finite: "not finite".
std::string figureText(double value, int significant = 3);
/// With this many decimals.
std::string fixedText(double value, int decimals);
/// The same with a prefix of 1000s: "4.55 M", "330 ", "2.10 k": the unit follows.
std::string prefixedText(double value);

}  // namespace sward::report
