#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Small image files that the library cannot write itself, byte by byte.
namespace sward::terrain::files {

inline void put(std::string& out, std::uint32_t value, int bytes, bool bigEndian) {
  for (int i = 0; i < bytes; ++i) {
    const int shift = 8 * (bigEndian ? bytes - 1 - i : i);
    out += static_cast<char>((value >> shift) & 0xffu);
  }
}

inline std::uint32_t crc32(const std::string& data) {
  std::uint32_t crc = 0xffffffffu;
  for (const char c : data) {
    crc ^= static_cast<unsigned char>(c);
    for (int i = 0; i < 8; ++i) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

inline void putChunk(std::string& out, const std::string& type, const std::string& data) {
  put(out, static_cast<std::uint32_t>(data.size()), 4, true);
  out += type + data;
  put(out, crc32(type + data), 4, true);
}

/// A grey PNG of 8 or 16 bits with one stored (not compressed) block; `samples` row by row from the top, at most 60 KB.
/// The header may promise another width than the samples have.
inline std::string greyPng(std::uint32_t width, std::uint32_t height, int bits,
                           const std::vector<std::uint32_t>& samples) {
  std::string header, rows;
  put(header, width, 4, true);
  put(header, height, 4, true);
  header += static_cast<char>(bits);
  header += std::string(4, '\0');
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i % width == 0) rows += '\0';
    put(rows, samples[i], bits / 8, true);
  }
  std::string stored("\x78\x01\x01", 3);
  put(stored, static_cast<std::uint32_t>(rows.size()), 2, false);
  put(stored, ~static_cast<std::uint32_t>(rows.size()) & 0xffffu, 2, false);
  stored += rows;
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : rows) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  put(stored, (b << 16) | a, 4, true);
  std::string out("\x89PNG\r\n\x1a\n", 8);
  putChunk(out, "IHDR", header);
  putChunk(out, "IDAT", stored);
  putChunk(out, "IEND", "");
  return out;
}

/// A little-endian grey TIFF in one strip: bits 16 (integers) or 32 (floats as their bits).
inline std::string greyTiff(std::uint32_t width, std::uint32_t height, int bits,
                            const std::vector<std::uint32_t>& samples) {
  std::string data;
  for (const std::uint32_t sample : samples) put(data, sample, bits / 8, false);
  struct Entry {
    std::uint32_t tag, type, value;
  };
  constexpr std::uint32_t kShort = 3, kLong = 4;
  const std::array<Entry, 10> entries{{{256, kLong, width},
                                       {257, kLong, height},
                                       {258, kShort, static_cast<std::uint32_t>(bits)},
                                       {259, kShort, 1},
                                       {262, kShort, 1},
                                       {273, kLong, 8},
                                       {277, kShort, 1},
                                       {278, kLong, height},
                                       {279, kLong, static_cast<std::uint32_t>(data.size())},
                                       {339, kShort, bits == 32 ? 3u : 1u}}};
  std::string out("II*\0", 4);
  put(out, static_cast<std::uint32_t>(8 + data.size()), 4, false);
  out += data;
  put(out, static_cast<std::uint32_t>(entries.size()), 2, false);
  for (const Entry& entry : entries) {
    put(out, entry.tag, 2, false);
    put(out, entry.type, 2, false);
    put(out, 1, 4, false);
    put(out, entry.value, 4, false);
  }
  put(out, 0, 4, false);
  return out;
}

inline std::uint32_t floatBits(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace sward::terrain::files
