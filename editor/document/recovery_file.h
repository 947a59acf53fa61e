#pragma once

#include "project/project.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sward::editor {

/// What an autosave file holds: an unsaved project, where it came from, and when and by whom it was written.
struct RecoveryFile {
  std::string title;             ///< of the document, for people
  std::filesystem::path file;    ///< absolute path of the document; empty when it was never saved
  std::filesystem::path folder;  ///< where its relative asset paths start; empty for one that lay nowhere
  std::int64_t unixSeconds = 0;
  std::int64_t processId = 0;
  project::Project project;
};

/// The text of an autosave file: a line with a checksum and the length of the rest, then JSON. An error when the
/// project could not be read back, such as for a value that is not finite.
Result<std::string> recoveryText(const RecoveryFile& content);

/// Reads such a text. Cut off anywhere, or with any byte changed, it is an error, never another project. `file` stands
/// in messages.
Result<RecoveryFile> parseRecovery(const std::string& text, const std::filesystem::path& file);

}  // namespace sward::editor
