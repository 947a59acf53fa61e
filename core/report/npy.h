#pragma once

#include "report/section.h"

#include <cstddef>
#include <vector>

namespace sward::report {

/// The array as a file of NumPy's format, version 1.0 (numpy.lib.format): magic, length of the header, header padded to
/// 64 bytes, then little-endian 32-bit floats in C order. `values` must be as many as the product of `shape` (one for
/// an empty shape).
std::vector<std::byte> npyBytes(const Array& array);

}  // namespace sward::report
