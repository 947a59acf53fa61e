#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::test {

struct Outcome {
  int exitCode = -1;  ///< -1 when a signal ended it
  std::string out, err;
  /// Processor time of all threads after the signal where one was sent, else in all: unlike the clock's, it does not
  /// depend on what else the machine does.
  double processorSeconds = 0.0;
};

/// Runs the built program with these arguments in `folder` and waits for it. With `interruptAfter` >= 0, sends SIGINT
/// that many seconds after the start.
Outcome runProgram(const std::filesystem::path& folder, const std::vector<std::string>& arguments,
                   double interruptAfter = -1.0);

/// The names of everything in a folder, sorted.
std::vector<std::string> listing(const std::filesystem::path& folder);

}  // namespace sward::test
