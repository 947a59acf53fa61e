#include "report/npy.h"

#include "base/check.h"

#include <bit>
#include <cstring>
#include <string>

namespace sward::report {

std::vector<std::byte> npyBytes(const Array& array) {
  static_assert(std::endian::native == std::endian::little, "values are copied as they stand");
  std::size_t count = 1;
  std::string shape = "(";
  for (std::size_t i = 0; i < array.shape.size(); ++i) {
    count *= array.shape[i];
    shape += (i > 0 ? " " : "") + std::to_string(array.shape[i]);
    // A tuple of one needs its comma.
    if (i + 1 < array.shape.size() || array.shape.size() == 1) shape += ',';
  }
  shape += ')';
  SWARD_CHECK_EQ(count, array.values.size());

  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }";
  constexpr std::size_t kPrefix = 10, kAlignment = 64;
  const std::size_t unpadded = kPrefix + header.size() + 1;
  header.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  header += '\n';
  SWARD_CHECK_LE(header.size(), std::size_t{0xffff});  // what two bytes hold
  std::string prefix("\x93NUMPY\x01\x00", 8);
  prefix += static_cast<char>(header.size() & 0xff);
  prefix += static_cast<char>(header.size() >> 8);

  const std::string front = prefix + header;
  std::vector<std::byte> bytes(front.size() + array.values.size() * sizeof(float));
  std::memcpy(bytes.data(), front.data(), front.size());
  if (!array.values.empty()) {
    std::memcpy(bytes.data() + front.size(), array.values.data(), array.values.size() * sizeof(float));
  }
  return bytes;
}

}  // namespace sward::report
