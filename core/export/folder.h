#pragma once

#include "base/result.h"

#include <filesystem>

namespace sward::exporting {

/// Makes the folder that files are written to, with those above it. Errors: it cannot be made, or a file stands there.
Result<void> makeFolder(const std::filesystem::path& folder);

}  // namespace sward::exporting
