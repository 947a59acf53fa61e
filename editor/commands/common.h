#pragma once

#include "interrupt.h"

#include "bake/bake.h"
#include "base/job.h"
#include "base/result.h"
#include "project/project.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace sward::editor {

using Json = nlohmann::ordered_json;

/// Exit codes of the program.
enum ExitCode { kDone = 0, kFailed = 1, kWrongInput = 2 };  // 130: interrupted

/// Options that every command takes.
struct CommonOptions {
  std::vector<std::string> overrides;
  int threads = 0;
  std::string cacheFolder;
  bool json = false;
  bool quiet = false;
};

/// What commands share: the interrupt source, the parsed common options, and the command to run once parsing is done.
struct Program {
  Interrupts& interrupts;
  CommonOptions common;
  std::function<Result<int>()> run;
  std::string commandLine;  ///< as it was given, quoted for a shell
};

/// Adds a command with the common options and examples under its help. `run` is called after parsing.
CLI::App* addCommand(CLI::App& app, Program& program, const std::string& name, const std::string& description,
                     const std::string& footer);

/// Human text on stderr: what is being done (left out with --quiet), and what is wrong.
void say(const Program& program, const std::string& text);
void warn(const Program& program, const std::string& text);
void complain(const std::string& text);
/// A result on stdout, as JSON.
void print(const Json& json);

int exitCodeOf(const Error& error);
Json toJson(const Error& error);

/// A project with the overrides of --set. Checks nothing but the file itself.
Result<project::Project> loadProject(const Program& program, const std::string& file);
/// Says the warnings, and gives the first fatal problem.
Result<void> checkProject(const Program& program, const project::Project& project);

/// A baker on the cache that the options name; on none, with a warning, when that folder cannot be used.
bake::Baker openBaker(const Program& program, const bake::Baker::Options& options = {});
std::filesystem::path cacheFolder(const Program& program);

/// A bar on a terminal; silent elsewhere and with --quiet. Ends its line when it goes.
class ProgressBar {
 public:
  explicit ProgressBar(const Program& program);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  JobContext job();
  /// Says a line above the bar.
  void line(const std::string& text);

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& stage, double fraction);

  const Program& m_program;
  bool m_enabled;
  std::mutex m_mutex;
  Clock::time_point m_start = Clock::now();
  Clock::time_point m_last{};
  double m_fraction = 0.0;
  bool m_drawn = false;
};

/// Seconds since it was made or last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - m_start).count();
    m_start = now;
    return seconds;
  }
  /// Seconds since it was made.
  double total() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - m_made).count(); }

 private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point m_made = m_start;
};

/// Checks that a file can be put there: the folder exists and may be written, the target is no folder or device.
Result<void> checkOutputFile(const std::filesystem::path& file);

/// Words as a shell takes them: those with anything but plain characters in quotes.
std::string shellText(const std::vector<std::string>& words);

/// "1.24 s", "38 ms"; "12.3 MiB".
std::string secondsText(double seconds);
std::string bytesText(std::uint64_t bytes);
/// A time that is still to come: "40 s", "12 min", "3.2 h".
std::string leftText(double seconds);

/// One sentence for people about what a bake did, and the same as JSON with every node.
std::string bakeText(const bake::BakeReport& report);
/// The same about one node.
std::string nodeText(const bake::NodeReport& node);
Json bakeJson(const bake::BakeReport& report);

}  // namespace sward::editor
