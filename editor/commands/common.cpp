#include "common.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <utility>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

spdlog::logger& console() {
  static const auto logger = [] {
    auto made = std::make_shared<spdlog::logger>("sward", std::make_shared<spdlog::sinks::stderr_color_sink_mt>());
    made->set_pattern("%v");
    return made;
  }();
  return *logger;
}

const char* stateName(bake::NodeReport::State state) {
  switch (state) {
    case bake::NodeReport::State::Baked:
      return "baked";
    case bake::NodeReport::State::FromMemory:
      return "memory";
    case bake::NodeReport::State::FromDisk:
      return "disk";
    case bake::NodeReport::State::Skipped:
      return "skipped";
  }
  return "?";
}

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

}  // namespace

CLI::App* addCommand(CLI::App& app, Program& program, const std::string& name, const std::string& description,
                     const std::string& footer) {
  CLI::App* command = app.add_subcommand(name, description);
  command->footer(footer + "\n");
  CommonOptions& common = program.common;
  const std::string group = "Options of every command";
  command
      ->add_option("--set", common.overrides,
                   "Override a value of the project for this run: PATH=VALUE, such as\n"
                   "patch.plants[0].grass.heightM=0.6 (repeatable)")
      ->group(group)
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--threads", common.threads, "Threads to work with; 0: all of the machine's [0]")
      ->group(group)
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--cache", common.cacheFolder,
                   "Folder of baked results [$XDG_CACHE_HOME/sward, else ~/.cache/sward]")
      ->group(group)
      ->type_name("DIR");
  command->add_flag("--json", common.json, "Results on stdout as JSON")->group(group);
  command->add_flag("--quiet,-q", common.quiet, "Say only what is wrong")->group(group);
  return command;
}

void say(const Program& program, const std::string& text) {
  if (!program.common.quiet) console().info("{}", text);
}

void warn(const Program& program, const std::string& text) {
  if (!program.common.quiet) console().warn("warning: {}", text);
}

void complain(const std::string& text) {
  console().error("sward: {}", text);
}

void print(const Json& json) {
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << std::endl;
}

int exitCodeOf(const Error& error) {
  switch (error.kind) {
    case ErrorKind::Failed:
      return kFailed;
    case ErrorKind::BadInput:
      return kWrongInput;
    case ErrorKind::Cancelled:
      return Interrupts::kExitCode;
  }
  return kFailed;
}

Json toJson(const Error& error) {
  return {{"what", error.what}, {"where", error.where}, {"remedy", error.remedy}, {"exit", exitCodeOf(error)}};
}

Result<project::Project> loadProject(const Program& program, const std::string& file) {
  return project::load(file, program.common.overrides);
}

Result<void> checkProject(const Program& program, const project::Project& project) {
  for (const project::Problem& problem : project::validate(project)) {
    if (problem.fatal) return Error::badInput(problem.what, problem.where, problem.remedy);
    warn(program, Error::badInput(problem.what, problem.where, problem.remedy).text());
  }
  return {};
}

fs::path cacheFolder(const Program& program) {
  return program.common.cacheFolder.empty() ? bake::defaultCacheFolder() : fs::path(program.common.cacheFolder);
}

bake::Baker openBaker(const Program& program, const bake::Baker::Options& options) {
  auto cache = bake::DiskCache::open(cacheFolder(program));
  if (cache.ok()) return bake::Baker(std::move(cache).value(), options);
  warn(program, cache.error().text() + " Going on without one: nothing is kept for the next run.");
  return bake::Baker(std::nullopt, options);
}

ProgressBar::ProgressBar(const Program& program)
    : m_program(program), m_enabled(!program.common.quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (m_drawn) std::fputs("\r\033[K", stderr);
}

JobContext ProgressBar::job() {
  JobContext job{m_program.interrupts.token(), {}, m_program.common.threads};
  if (m_enabled) job.onProgress = [this](const std::string& stage, double fraction) { show(stage, fraction); };
  return job;
}

void ProgressBar::line(const std::string& text) {
  const std::scoped_lock lock(m_mutex);
  if (std::exchange(m_drawn, false)) std::fputs("\r\033[K", stderr);
  say(m_program, text);
}

void ProgressBar::show(const std::string& stage, double fraction) {
  const std::scoped_lock lock(m_mutex);
  m_fraction = std::max(m_fraction, fraction);
  const auto now = Clock::now();
  if (now - m_last < std::chrono::milliseconds(100)) return;
  m_last = now;
  m_drawn = true;
  constexpr int kCells = 24;
  const int full = static_cast<int>(m_fraction * kCells);
  const double spent = std::chrono::duration<double>(now - m_start).count();
  const std::string left =
      m_fraction > 0.02 && spent > 1.0 ? ", " + leftText(spent / m_fraction - spent) + " left" : "";
  const std::string bar =
      std::string(static_cast<std::size_t>(full), '#') + std::string(static_cast<std::size_t>(kCells - full), '.');
  std::fprintf(stderr, "\r\033[K[%s] %3d %%%s  %s", bar.c_str(), static_cast<int>(100.0 * m_fraction), left.c_str(),
               stage.c_str());
  std::fflush(stderr);
}

Result<void> checkOutputFile(const fs::path& file) {
  std::error_code code;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (file.filename().empty()) return Error::badInput("this names no file", file.string(), "Give a file name.");
  if (!fs::exists(folder, code)) {
    return Error::badInput("the folder does not exist", folder.string(), "Make it first, or choose another.");
  }
  if (!fs::is_directory(folder, code)) {
    return Error::badInput("this is not a folder", folder.string(), "Choose a file in a folder.");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return Error::failed("the folder cannot be written", folder.string(), "Choose another, or change its permissions.");
  }
  if (!fs::exists(file, code)) return {};
  // A device or a pipe would be replaced by a file when the result is renamed into place.
  if (!fs::is_regular_file(file, code)) {
    return Error::badInput(fs::is_directory(file, code) ? "this is a folder" : "this is not an ordinary file",
                           file.string(), "Give the name of a file.");
  }
  if (::access(file.c_str(), W_OK) != 0) {
    return Error::failed("the file is write-protected", file.string(), "Choose another, or change its permissions.");
  }
  return {};
}

std::string shellText(const std::vector<std::string>& words) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ' ';
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      text += word;
      continue;
    }
    text += '\'';
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += '\'';
  }
  return text;
}

std::string secondsText(double seconds) {
  if (seconds < 0.1) return fixed(1000.0 * seconds, 1) + " ms";
  return fixed(seconds, 2) + " s";
}

std::string bytesText(std::uint64_t bytes) {
  if (bytes < 1024) return std::to_string(bytes) + " bytes";
  if (bytes < std::uint64_t{1024} * 1024) return fixed(static_cast<double>(bytes) / 1024.0, 1) + " KiB";
  return fixed(static_cast<double>(bytes) / (1024.0 * 1024.0), 1) + " MiB";
}

std::string leftText(double seconds) {
  if (seconds < 100.0) return fixed(seconds, 0) + " s";
  if (seconds < 6000.0) return fixed(seconds / 60.0, 0) + " min";
  return fixed(seconds / 3600.0, 1) + " h";
}

std::string bakeText(const bake::BakeReport& report) {
  int counts[4] = {};
  for (const bake::NodeReport& node : report.nodes) ++counts[static_cast<int>(node.state)];
  const std::uint64_t rays = report.raysNearest + report.raysOcclusion;
  std::string text = counts[0] == 0 ? "baked nothing" : "baked " + std::to_string(counts[0]) + " results";
  if (counts[1] + counts[2] > 0) text += ", reused " + std::to_string(counts[1] + counts[2]);
  if (counts[3] > 0) text += ", " + std::to_string(counts[3]) + " not needed";
  if (rays > 0) text += ", " + fixed(1e-6 * static_cast<double>(rays), 1) + " million rays";
  return text + ", in " + secondsText(report.seconds);
}

std::string nodeText(const bake::NodeReport& node) {
  const std::string name = "  " + node.kind + (node.what.empty() ? "" : ", " + node.what) + ": ";
  switch (node.state) {
    case bake::NodeReport::State::Baked:
      return name + "baked in " + secondsText(node.seconds) + ", " + bytesText(node.bytes);
    case bake::NodeReport::State::FromMemory:
      return name + "from memory";
    case bake::NodeReport::State::FromDisk:
      return name + "from the cache in " + secondsText(node.seconds) + ", " + bytesText(node.bytes);
    case bake::NodeReport::State::Skipped:
      return name + "not needed";
  }
  return name;
}

Json bakeJson(const bake::BakeReport& report) {
  Json nodes = Json::array();
  for (const bake::NodeReport& node : report.nodes) {
    nodes.push_back({{"kind", node.kind},
                     {"what", node.what},
                     {"state", stateName(node.state)},
                     {"seconds", node.seconds},
                     {"bytes", node.bytes}});
  }
  return {{"seconds", report.seconds},
          {"rays", {{"nearest", report.raysNearest}, {"occlusion", report.raysOcclusion}}},
          {"warnings", report.warnings},
          {"nodes", nodes}};
}

}  // namespace sward::editor
