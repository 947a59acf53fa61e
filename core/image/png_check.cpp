#include "image/png_check.h"

#include <array>
#include <cstdint>

namespace sward::image {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kChunkOverhead = 12;  // length, type, checksum
constexpr std::uint32_t kEnd = 0x49454E44;  // "IEND"

constexpr std::array<std::uint32_t, 256> crcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c >> 1) ^ ((c & 1u) != 0 ? 0xedb88320u : 0u);
    table[i] = c;
  }
  return table;
}

/// CRC-32 of ISO 3309, as PNG (ISO 15948) section 5.5 has it.
std::uint32_t crcOf(std::span<const std::byte> bytes) {
  static constexpr std::array<std::uint32_t, 256> kTable = crcTable();
  std::uint32_t crc = 0xffffffffu;
  for (const std::byte b : bytes) crc = kTable[(crc ^ static_cast<std::uint32_t>(b)) & 0xffu] ^ (crc >> 8);
  return ~crc;
}

std::uint32_t bigEndian(std::span<const std::byte> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8) | static_cast<std::uint32_t>(bytes[i]);
  return value;
}

}  // namespace

Result<void> checkPng(std::span<const std::byte> data, const std::string& name) {
  const auto damaged = [&](const std::string& what, std::size_t at) {
    return Error::badInput("the PNG is damaged: " + what + " at byte " + std::to_string(at), name,
                           "Export the image again.");
  };
  std::size_t at = kSignatureBytes;
  while (at + kChunkOverhead <= data.size()) {
    const std::size_t length = bigEndian(data.subspan(at));
    if (length > data.size() - at - kChunkOverhead) return damaged("a chunk is cut short", at);
    const std::span<const std::byte> checked = data.subspan(at + 4, 4 + length);
    if (crcOf(checked) != bigEndian(data.subspan(at + 8 + length))) return damaged("a checksum is wrong", at);
    if (bigEndian(checked) == kEnd) return {};
    at += kChunkOverhead + length;
  }
  return damaged("it ends early", data.size());
}

}  // namespace sward::image
