#pragma once

#include "base/result.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::mesh {

/// True for "data:" URIs.
bool isDataUri(const std::string& uri);
/// The bytes of a base64 data URI of any media type.
Result<std::vector<std::byte>> decodeDataUri(const std::string& uri);
/// The file that a relative URI means, seen from the folder of the glTF file: percent-encoding is undone, a name that
/// holds a literal percent sign or backslashes is found too. Remote URIs and absolute paths are refused; "../" is not.
/// The file need not exist.
Result<std::filesystem::path> resolveUri(const std::filesystem::path& folder, const std::string& uri);

}  // namespace sward::mesh
