#include "export/folder.h"

#include <system_error>

namespace sward::exporting {

Result<void> makeFolder(const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (!code && std::filesystem::is_directory(folder)) return {};
  return Error::badInput("cannot make the folder" + (code ? ": " + code.message() : std::string()), folder.string(),
                         "Choose another folder with -o.");
}

}  // namespace sward::exporting
