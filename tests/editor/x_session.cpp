#include "editor/x_session.h"

#include "base/file.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace sward {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr auto kPoll = std::chrono::milliseconds(50);
/// Steps of a drag, and the pause after each: an author's hand, not a jump.
constexpr int kDragSteps = 8;
constexpr auto kStepPause = std::chrono::milliseconds(25);

/// Starts a program with its output in `log`; environment entries are added.
pid_t start(const std::vector<std::string>& command, const std::map<std::string, std::string>& environment,
            const fs::path& log) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
  const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(out, STDOUT_FILENO);
  dup2(out, STDERR_FILENO);
  std::vector<char*> arguments;
  for (const std::string& part : command) arguments.push_back(const_cast<char*>(part.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

std::uint32_t bigEndian(const std::byte* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint32_t>(bytes[i]);
  return value;
}

fs::path temporaryFolder(const char* name) {
  std::string pattern = (fs::temp_directory_path() / (std::string(name) + ".XXXXXX")).string();
  return mkdtemp(pattern.data());
}

}  // namespace

XServer::XServer(int width, int height) : m_folder(temporaryFolder("sward-x")) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return;
  const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
  m_pid = start({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", screen, "-fbdir", m_folder.string(),
                 "-nolisten", "tcp", "-noreset"},
                {}, m_folder / "log");
  close(ends[1]);
  // The server writes the number of its display once it listens.
  std::string text;
  char c = 0;
  while (read(ends[0], &c, 1) == 1 && c != '\n') text += c;
  close(ends[0]);
  if (text.empty()) {
    waitpid(m_pid, nullptr, 0);
    m_pid = -1;
    return;
  }
  m_number = std::atoi(text.c_str());
}

XServer::~XServer() {
  if (m_pid > 0) {
    ::kill(m_pid, SIGTERM);
    waitpid(m_pid, nullptr, 0);
  }
  std::error_code code;
  fs::remove_all(m_folder, code);
}

image::Image XServer::screenshot() const {
  // XWD, version 7: a header of 32-bit numbers in big-endian order, a colour map, then rows of 4-byte pixels (BGRX).
  const auto file = base::readFile(m_folder / "Xvfb_screen0").value();
  const auto field = [&](std::size_t index) { return bigEndian(file.data() + 4 * index); };
  const std::size_t headerSize = field(0), width = field(4), height = field(5), rowBytes = field(12),
                    colours = field(19);
  const std::size_t first = headerSize + colours * 12;
  image::Image out(static_cast<int>(width), static_cast<int>(height), 3);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::byte* pixel = file.data() + first + y * rowBytes + x * 4;
      for (std::size_t c = 0; c < 3; ++c)
        out.pixels[(y * width + x) * 3 + c] = static_cast<float>(pixel[2 - c]) / 255.0f;
    }
  }
  return out;
}

EditorSession::EditorSession(const XServer& server, const fs::path& home, std::vector<std::string> arguments,
                             std::map<std::string, std::string> environment)
    : m_display(server.display()), m_home(home), m_log(home / "items.json") {
  fs::create_directories(home);
  fs::remove(m_log);  // of a session before
  environment.insert({{"DISPLAY", m_display},
                      {"HOME", home.string()},
                      {"XDG_CONFIG_HOME", (home / "config").string()},
                      {"XDG_STATE_HOME", (home / "state").string()},
                      {"XDG_CACHE_HOME", (home / "cache").string()}});
  std::vector<std::string> command{SWARD_BINARY, "edit", "--item-log", m_log.string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  m_pid = start(command, environment, home / "output");
}

EditorSession::~EditorSession() {
  if (m_pid > 0 && alive()) {
    ::kill(m_pid, SIGKILL);
    waitpid(m_pid, nullptr, 0);
  }
}

bool EditorSession::alive() {
  return m_pid > 0 && waitpid(m_pid, nullptr, WNOHANG) == 0;
}

std::optional<int> EditorSession::waitForExit(double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end) {
    int status = 0;
    if (waitpid(m_pid, &status, WNOHANG) == m_pid) {
      m_pid = -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    std::this_thread::sleep_for(kPoll);
  }
  return std::nullopt;
}

void EditorSession::kill(int signal) {
  ::kill(m_pid, signal);
}

bool EditorSession::refresh() {
  const auto text = base::readTextFile(m_log);
  if (!text.ok()) return false;
  const Json json = Json::parse(*text, nullptr, false);
  if (json.is_discarded()) return false;
  m_items.clear();
  for (const auto& [name, item] : json["items"].items()) {
    m_items[name] = {item["x"].get<double>(), item["y"].get<double>(), item["width"].get<double>(),
                     item["height"].get<double>(), item["visible"].get<bool>()};
  }
  m_state.clear();
  for (const auto& [name, value] : json["state"].items())
    m_state[name] = value.is_string() ? value.get<std::string>() : value.dump();
  return true;
}

std::optional<EditorSession::Item> EditorSession::item(const std::string& name) {
  refresh();
  const auto found = m_items.find(name);
  return found == m_items.end() ? std::nullopt : std::optional(found->second);
}

std::string EditorSession::state(const std::string& name) {
  refresh();
  const auto found = m_state.find(name);
  return found == m_state.end() ? std::string() : found->second;
}

std::int64_t EditorSession::number(const std::string& name) {
  return std::atoll(state(name).c_str());
}

bool EditorSession::waitUntil(const std::function<bool()>& done, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end || !alive()) return false;
    std::this_thread::sleep_for(kPoll);
  }
  return true;
}

bool EditorSession::reaches(const std::string& name, const std::string& value, double seconds) {
  return waitUntil([&] { return state(name) == value; }, seconds);
}

bool EditorSession::waitForItem(const std::string& name, double seconds) {
  return waitUntil(
      [&] {
        const auto found = item(name);
        return found && found->visible;
      },
      seconds);
}

void EditorSession::xdotool(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"xdotool"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  const pid_t pid = start(command, {{"DISPLAY", m_display}}, m_home / "xdotool");
  waitpid(pid, nullptr, 0);
}

void EditorSession::moveTo(double x, double y) {
  xdotool({"mousemove", std::to_string(std::lround(x)), std::to_string(std::lround(y))});
  std::this_thread::sleep_for(kStepPause * 3);
}

bool EditorSession::click(const std::string& name, int button, int times) {
  if (!waitForItem(name)) return false;
  const Item found = *item(name);
  moveTo(found.x + 0.5 * found.width, found.y + 0.5 * found.height);
  xdotool({"click", "--repeat", std::to_string(times), "--delay", "120", std::to_string(button)});
  std::this_thread::sleep_for(kStepPause * 6);
  return true;
}

bool EditorSession::drag(const std::string& name, double dx, double dy, int button) {
  if (!waitForItem(name)) return false;
  const Item found = *item(name);
  const double x = found.x + 0.5 * found.width, y = found.y + 0.5 * found.height;
  moveTo(x, y);
  xdotool({"mousedown", std::to_string(button)});
  std::this_thread::sleep_for(kStepPause * 3);
  for (int i = 1; i <= kDragSteps; ++i) moveTo(x + dx * i / kDragSteps, y + dy * i / kDragSteps);
  xdotool({"mouseup", std::to_string(button)});
  std::this_thread::sleep_for(kStepPause * 6);
  return true;
}

void EditorSession::key(const std::string& keys) {
  // Held as long as a finger does.
  xdotool({"keydown", keys});
  std::this_thread::sleep_for(kStepPause * 3);
  xdotool({"keyup", keys});
  std::this_thread::sleep_for(kStepPause * 6);
}

void EditorSession::keyDown(const std::string& key) {
  xdotool({"keydown", key});
  std::this_thread::sleep_for(kStepPause * 3);
}

void EditorSession::keyUp(const std::string& key) {
  xdotool({"keyup", key});
  std::this_thread::sleep_for(kStepPause * 3);
}

void EditorSession::type(const std::string& text) {
  xdotool({"type", "--delay", "40", text});
  std::this_thread::sleep_for(kStepPause * 6);
}

void EditorSession::focus() {
  xdotool({"search", "--sync", "--onlyvisible", "--name", "Sward", "windowfocus", "--sync"});
}

void EditorSession::resize(int width, int height) {
  xdotool({"search", "--onlyvisible", "--name", "Sward", "windowsize", std::to_string(width), std::to_string(height)});
  std::this_thread::sleep_for(kStepPause * 10);
}

std::string EditorSession::errors() const {
  return base::readTextFile(m_home / "output").ok() ? *base::readTextFile(m_home / "output") : std::string();
}

}  // namespace sward
