#pragma once

#include "base/result.h"

#include <cstddef>
#include <span>
#include <string>

namespace sward::image {

/// Checks the container of a PNG (signature, chunk lengths, checksums, an end) before libpng sees it: libpng prints its
/// complaints to stderr, and jumps over the destructors of the reader that feeds it when the data ends early.
/// Errors name `name` and the place of the first damage.
Result<void> checkPng(std::span<const std::byte> data, const std::string& name);

}  // namespace sward::image
