#pragma once

#include "base/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What the file dialog shows of a folder, without a user interface.
namespace sward::editor {

struct FolderEntry {
  std::string name;
  bool folder = false;
  std::uintmax_t bytes = 0;    ///< of files
  std::int64_t modifiedS = 0;  ///< seconds since 1970, UTC; 0 when it is not known
};

struct FileFilter {
  std::string name;                     ///< "Sward projects"
  std::vector<std::string> extensions;  ///< ".sward", lower case; none: every file
  bool matches(std::string_view fileName) const;
};

enum class FolderSort { Name, Modified, Size };

/// Folders, and the files that the filter lets through, unsorted. Links count as what they lead to; broken ones are
/// left out, and so are names that start with a dot unless `hidden`. An error says why the folder cannot be read.
Result<std::vector<FolderEntry>> listFolder(const std::filesystem::path& folder, const FileFilter& filter, bool hidden);
/// Folders first, whatever the order; names as people count ("grass 2" before "grass 10"), whatever the case.
void sortEntries(std::vector<FolderEntry>& entries, FolderSort by, bool descending);
/// True when a stands before b as people count.
bool naturalLess(std::string_view a, std::string_view b);
/// The first entry from `from` on (round the end) whose name begins with the typed text, whatever the case.
std::optional<std::size_t> findTyped(const std::vector<FolderEntry>& entries, std::string_view typed, std::size_t from);
/// "3.4 MB"
std::string fileSizeText(std::uintmax_t bytes);
/// "2025-06-21 14:03", local time; empty for 0.
std::string timeText(std::int64_t secondsSince1970);
/// Why a file or folder cannot be called this; empty when it can.
std::string nameProblem(std::string_view name);

}  // namespace sward::editor
