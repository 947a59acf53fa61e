#include "mesh/gltf_uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace sward::mesh {
namespace {

namespace fs = std::filesystem;

std::optional<int> hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

std::string percentDecoded(const std::string& uri) {
  std::string text;
  text.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size()) {
      const std::optional<int> high = hexDigit(uri[i + 1]), low = hexDigit(uri[i + 2]);
      if (high && low) {
        text.push_back(static_cast<char>(*high * 16 + *low));
        i += 2;
        continue;
      }
    }
    text.push_back(uri[i]);
  }
  return text;
}

/// "http:" and the like; one letter is a Windows drive.
bool hasScheme(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string::npos || colon == 0) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.'; });
}

std::string shortened(const std::string& uri) {
  return uri.size() <= 80 ? uri : uri.substr(0, 77) + "...";
}

/// Value of a base64 character, or -1.
constexpr std::array<signed char, 256> base64Table() {
  std::array<signed char, 256> table{};
  for (signed char& value : table) value = -1;
  const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (int i = 0; i < 64; ++i) table[static_cast<unsigned char>(letters[i])] = static_cast<signed char>(i);
  return table;
}

}  // namespace

bool isDataUri(const std::string& uri) {
  return uri.starts_with("data:");
}

Result<std::vector<std::byte>> decodeDataUri(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos || !std::string_view(uri).substr(0, comma).ends_with(";base64")) {
    return Error::badInput("the data URI is not base64", shortened(uri),
                           "Export the file again, or use a separate .bin file.");
  }
  static constexpr std::array<signed char, 256> kTable = base64Table();
  std::vector<std::byte> bytes;
  bytes.reserve((uri.size() - comma) / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t i = comma + 1; i < uri.size() && uri[i] != '='; ++i) {
    const signed char value = kTable[static_cast<unsigned char>(uri[i])];
    if (value < 0) {
      return Error::badInput("the data URI holds a character that is not base64", shortened(uri),
                             "Export the file again.");
    }
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes.push_back(static_cast<std::byte>((bits >> held) & 0xffu));
    }
  }
  return bytes;
}

Result<fs::path> resolveUri(const fs::path& folder, const std::string& uri) {
  if (hasScheme(uri)) {
    return Error::badInput("the URI \"" + shortened(uri) + "\" is not a file beside the glTF file", {},
                           "Remote and absolute URIs are never followed: put the file beside the glTF file.");
  }
  const std::string decoded = percentDecoded(uri);
  if (decoded.empty() || decoded.find('\0') != std::string::npos) {
    return Error::badInput("the URI \"" + shortened(uri) + "\" names no file", {}, "Export the file again.");
  }
  std::string slashed = decoded;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  if (decoded.front() == '/' || slashed.front() == '/' || uri.front() == '/') {
    return Error::badInput("the URI \"" + shortened(uri) + "\" is an absolute path", {},
                           "Put the file beside the glTF file and refer to it by its name.");
  }
  std::error_code code;
  for (const std::string& candidate : {decoded, uri, slashed}) {
    if (fs::is_regular_file(folder / candidate, code)) return folder / candidate;
  }
  return folder / decoded;
}

}  // namespace sward::mesh
