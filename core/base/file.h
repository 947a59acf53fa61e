#pragma once

#include "base/result.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sward::base {

/// The whole file, at most `limitBytes` long; a missing, unreadable or larger file is an error that says which.
Result<std::vector<std::byte>> readFile(const std::filesystem::path& path,
                                        std::uint64_t limitBytes = std::uint64_t{4} << 30);
Result<std::string> readTextFile(const std::filesystem::path& path, std::uint64_t limitBytes = std::uint64_t{64} << 20);

/// Whether a write waits until the disk has the bytes: a file of the user's survives a power cut then, at the cost of
/// milliseconds to a second; caches need it not.
enum class Sync { No, Yes };

/// Writes a temporary file beside `path` and renames it, so that `path` holds either its old content or all of the new.
/// The permissions of a file that is replaced are kept, and a symbolic link is followed. Creates no folders.
Result<void> writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> data,
                                 Sync sync = Sync::No);
Result<void> writeFileAtomically(const std::filesystem::path& path, const std::string& text, Sync sync = Sync::No);

/// The same for writers that want a file name: calls write(temporaryPath) and renames its file to `path`; the temporary
/// keeps the extension of `path`, and is removed when write fails.
Result<void> writeThroughTemporary(const std::filesystem::path& path,
                                   const std::function<Result<void>(const std::filesystem::path&)>& write);

}  // namespace sward::base
