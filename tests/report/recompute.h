#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include <sys/wait.h>

namespace sward::report::test {

/// The exit code of recompute.py on a report's folder, and all that it says.
inline std::pair<int, std::string> recompute(const std::filesystem::path& folder) {
  const std::string command = std::string(SWARD_PYTHON) + " -B " + SWARD_SOURCE_DIR + "/tests/report/recompute.py '" +
                              folder.string() + "' 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {-1, "cannot start it"};
  std::string said;
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr) said += buffer.data();
  return {WEXITSTATUS(::pclose(pipe)), said};
}

}  // namespace sward::report::test
