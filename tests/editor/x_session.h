#pragma once

#include "image/image.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace sward {

/// A virtual X server of its own (Xvfb), ended with the object.
class XServer {
 public:
  XServer(int width, int height);
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;

  bool running() const { return m_pid > 0; }
  std::string display() const { return ":" + std::to_string(m_number); }
  /// What the screen shows now: linear order of bytes / 255, RGB, rows from the top.
  image::Image screenshot() const;

 private:
  pid_t m_pid = -1;
  int m_number = -1;
  std::filesystem::path m_folder;
};

/// The editor in a real window, driven by real mouse and key events. Finds items by the log that the program writes.
class EditorSession {
 public:
  struct Item {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    bool visible = false;
  };

  /// Starts `sward edit ARGUMENTS` with folders of its own for preferences, recovery and cache below `home`.
  EditorSession(const XServer& server, const std::filesystem::path& home, std::vector<std::string> arguments,
                std::map<std::string, std::string> environment = {});
  ~EditorSession();
  EditorSession(const EditorSession&) = delete;
  EditorSession& operator=(const EditorSession&) = delete;

  bool alive();
  /// Waits for the end of the process; its exit code, or nothing after `seconds`.
  std::optional<int> waitForExit(double seconds = 20.0);
  void kill(int signal);

  /// Reads the newest log; false while there is none.
  bool refresh();
  std::optional<Item> item(const std::string& name);
  /// A value of the log's state, such as "revision", as text; empty when unknown.
  std::string state(const std::string& name);
  std::int64_t number(const std::string& name);
  /// Polls until `done` holds; false after `seconds`.
  bool waitUntil(const std::function<bool()>& done, double seconds = 60.0);
  /// Waits until a value of the state is `value`: what an event causes shows some frames after it.
  bool reaches(const std::string& name, const std::string& value, double seconds = 20.0);
  bool waitForItem(const std::string& name, double seconds = 30.0);

  void moveTo(double x, double y);
  /// Clicks the middle of an item (1 left, 2 middle, 3 right). False when it is not on the screen.
  bool click(const std::string& name, int button = 1, int times = 1);
  /// Presses on the middle of an item, moves by (dx, dy) pixels in small steps, lets go.
  bool drag(const std::string& name, double dx, double dy, int button = 1);
  /// Such as "ctrl+z"; the names of xdotool.
  void key(const std::string& keys);
  void keyDown(const std::string& key);
  void keyUp(const std::string& key);
  void type(const std::string& text);
  /// Gives the window the keyboard: there is no window manager that would.
  void focus();
  void resize(int width, int height);
  std::string errors() const;

 private:
  void xdotool(const std::vector<std::string>& arguments);

  std::string m_display;
  std::filesystem::path m_home, m_log;
  pid_t m_pid = -1;
  std::map<std::string, Item> m_items;
  std::map<std::string, std::string> m_state;
};

}  // namespace sward
