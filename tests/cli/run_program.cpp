#include "cli/run_program.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sward::test {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

[[noreturn]] void execute(const fs::path& folder, const std::vector<std::string>& arguments, const fs::path& out,
                          const fs::path& err) {
  std::vector<std::string> all{SWARD_BINARY};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& argument : all) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDOUT_FILENO);
  ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
  ::unsetenv("DISPLAY");  // commands draw without one; the window has tests of its own
  ::unsetenv("WAYLAND_DISPLAY");
  if (::chdir(folder.c_str()) == 0) ::execv(SWARD_BINARY, pointers.data());
  ::_exit(99);
}

/// Returns once the program blocks SIGINT, which is the first thing it does: before, a signal would just end it, and
/// how long starting takes depends on what else the machine does.
void waitForHandler(pid_t child) {
  constexpr unsigned long long kInterrupt = 1ull << (SIGINT - 1);
  const fs::path file = fs::path("/proc") / std::to_string(child) / "status";
  for (int i = 0; i < 2000; ++i) {
    std::ifstream status(file);
    for (std::string line; std::getline(status, line);) {
      if (!line.starts_with("SigBlk:")) continue;
      if ((std::stoull(line.substr(7), nullptr, 16) & kInterrupt) != 0) return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

/// Processor seconds that a running process has used: fields 14 and 15 of its stat line, counted after its name.
double processorSecondsOf(pid_t child) {
  std::ifstream file(fs::path("/proc") / std::to_string(child) / "stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(line.rfind(')') + 1));
  std::string skipped;
  for (int i = 0; i < 11; ++i) fields >> skipped;
  double user = 0.0, system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Outcome runProgram(const fs::path& folder, const std::vector<std::string>& arguments, double interruptAfter) {
  const fs::path base = folder.string() + ".streams";
  const fs::path out = base.string() + ".out", err = base.string() + ".err";
  double before = 0.0;
  const pid_t child = ::fork();
  if (child == 0) execute(folder, arguments, out, err);
  if (interruptAfter >= 0.0) {
    waitForHandler(child);
    std::this_thread::sleep_for(std::chrono::duration<double>(interruptAfter));
    before = processorSecondsOf(child);
    ::kill(child, SIGINT);
  }
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  Outcome outcome;
  outcome.processorSeconds = secondsOf(used.ru_utime) + secondsOf(used.ru_stime) - before;
  outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.out = contents(out);
  outcome.err = contents(err);
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::vector<std::string> listing(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& item : fs::directory_iterator(folder)) names.push_back(item.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace sward::test
