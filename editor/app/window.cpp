#include "app/window.h"

#include "widgets/theme.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

namespace sward::editor {
namespace {

constexpr int kDefaultWidth = 1440, kDefaultHeight = 900;
constexpr int kLeastWidth = 160, kLeastHeight = 90;
/// ImGui needs a few frames after an event until hovers, popups and sizes have settled.
constexpr int kFramesAfterEvent = 3;
/// How long the loop sleeps at most: files are looked after once a second.
constexpr double kLongestSleep = 1.0;
/// A text cursor blinks.
constexpr double kBlinkSeconds = 0.4;

std::string& lastGlfwError() {
  static std::string text;
  return text;
}

/// GLFW as a resource: one for the process.
class Glfw {
 public:
  Result<void> start() {
    glfwSetErrorCallback([](int, const char* text) { lastGlfwError() = text; });
    m_started = glfwInit() == GLFW_TRUE;
    if (m_started) return {};
    return Error::failed("no window can be opened: " + lastGlfwError(), "display",
                         "Set DISPLAY to an X server, or draw without a window: sward render PROJECT -o FILE.");
  }
  ~Glfw() {
    if (m_started) glfwTerminate();
  }

 private:
  bool m_started = false;
};

struct DestroyWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowHandle = std::unique_ptr<GLFWwindow, DestroyWindow>;

/// ImGui's context with both backends.
class ImGuiScope {
 public:
  explicit ImGuiScope(GLFWwindow* window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // the layout is part of the preferences
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330 core");
  }
  ~ImGuiScope() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  ImGuiScope(const ImGuiScope&) = delete;
  ImGuiScope& operator=(const ImGuiScope&) = delete;
};

/// What the window's callbacks leave for the loop.
struct Events {
  bool any = false;
  bool close = false;
  std::vector<std::filesystem::path> dropped;
  /// ImGui sees keys as they stand at the start of a frame; a short press during a long frame would be lost on it.
  std::vector<Shortcut> keys;
};

Events& eventsOf(GLFWwindow* window) {
  return *static_cast<Events*>(glfwGetWindowUserPointer(window));
}

/// Set before ImGui's backend installs its own, which call these on.
void installCallbacks(GLFWwindow* window, Events& events) {
  glfwSetWindowUserPointer(window, &events);
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double, double) { eventsOf(w).any = true; });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int, int, int) { eventsOf(w).any = true; });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double) { eventsOf(w).any = true; });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    eventsOf(w).any = true;
    if (action != GLFW_PRESS) return;
    eventsOf(w).keys.push_back(
        {key, (modifiers & GLFW_MOD_CONTROL) != 0, (modifiers & GLFW_MOD_SHIFT) != 0, (modifiers & GLFW_MOD_ALT) != 0});
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { eventsOf(w).any = true; });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { eventsOf(w).any = true; });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { eventsOf(w).any = true; });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { eventsOf(w).any = true; });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { eventsOf(w).any = true; });
  glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
    eventsOf(w).close = true;
    glfwSetWindowShouldClose(w, GLFW_FALSE);
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) eventsOf(w).dropped.emplace_back(paths[i]);
  });
}

Result<WindowHandle> openWindow(const Preferences& preferences) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_MAXIMIZED, preferences.window.maximised ? GLFW_TRUE : GLFW_FALSE);
  int width = preferences.window.known ? preferences.window.width : kDefaultWidth;
  int height = preferences.window.known ? preferences.window.height : kDefaultHeight;
  if (const GLFWvidmode* mode = glfwGetVideoMode(glfwGetPrimaryMonitor())) {
    width = std::min(width, mode->width);
    height = std::min(height, mode->height);
  }
  WindowHandle window(glfwCreateWindow(width, height, "Sward", nullptr, nullptr));
  if (!window) {
    return Error::failed("the window needs OpenGL 3.3: " + lastGlfwError(), "display",
                         "Update the graphics driver or install Mesa (libgl1-mesa-dri).");
  }
  if (preferences.window.known && !preferences.window.maximised)
    glfwSetWindowPos(window.get(), preferences.window.x, preferences.window.y);
  glfwSetWindowSizeLimits(window.get(), kLeastWidth, kLeastHeight, GLFW_DONT_CARE, GLFW_DONT_CARE);
  return window;
}

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The loop's state: draws when something happened, sleeps otherwise.
class WindowLoop {
 public:
  WindowLoop(GLFWwindow* window, Events& events, Application& application, const UiGl& gl)
      : m_window(window), m_events(events), m_application(application), m_gl(gl) {}

  void run(const std::stop_token& stop) {
    int framesLeft = kFramesAfterEvent;
    while (!m_application.wantsToQuit() && !stop.stop_requested()) {
      if (framesLeft > 0) {
        glfwPollEvents();
      } else {
        glfwWaitEventsTimeout(sleepSeconds());
      }
      const double woke = secondsNow();
      if (takeEvents()) framesLeft = kFramesAfterEvent;
      if (m_application.poll(woke)) framesLeft = std::max(framesLeft, 1);
      if (due(woke)) framesLeft = std::max(framesLeft, 1);
      if (framesLeft == 0) continue;
      drawFrame(woke);
      --framesLeft;
    }
    rememberWindow();
  }

 private:
  double sleepSeconds() const {
    double sleep = kLongestSleep;
    if (ImGui::GetIO().WantTextInput) sleep = kBlinkSeconds;
    if (const auto wake = m_application.nextWake()) sleep = std::min(sleep, *wake - secondsNow());
    return std::clamp(sleep, 0.001, kLongestSleep);
  }

  bool due(double now) const {
    const auto wake = m_application.nextWake();
    return (wake && now >= *wake) || ImGui::GetIO().WantTextInput;
  }

  bool takeEvents() {
    if (m_events.close) m_application.closeRequested();
    if (!m_events.dropped.empty()) m_application.dropped(m_events.dropped);
    for (const Shortcut& key : m_events.keys) m_application.keyPressed(key);
    const bool any = m_events.any || m_events.close || !m_events.dropped.empty();
    m_events = {};
    return any;
  }

  float screenScale() const {
    float scaleX = 1.0f, scaleY = 1.0f;
    glfwGetWindowContentScale(m_window, &scaleX, &scaleY);
    return std::max(scaleX, scaleY);
  }

  void drawFrame(double woke) {
    m_application.refreshStyle(screenScale());
    const std::string title = m_application.title();
    if (title != m_title) glfwSetWindowTitle(m_window, title.c_str());
    m_title = title;
    int width = 0, height = 0;
    glfwGetFramebufferSize(m_window, &width, &height);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    m_application.frame(woke, width, height);
    ImGui::Render();
    if (width > 0 && height > 0) {
      const ImVec4 back = ImGui::ColorConvertU32ToFloat4(theme().colours.backdrop);
      m_gl.clear(width, height, back.x, back.y, back.z);
      ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
      glfwSwapBuffers(m_window);
    }
    m_application.frameShown((secondsNow() - woke) * 1000.0);
  }

  void rememberWindow() {
    Preferences& preferences = m_application.preferences();
    preferences.window.maximised = glfwGetWindowAttrib(m_window, GLFW_MAXIMIZED) == GLFW_TRUE;
    preferences.window.known = true;
    if (preferences.window.maximised) return;
    glfwGetWindowSize(m_window, &preferences.window.width, &preferences.window.height);
    glfwGetWindowPos(m_window, &preferences.window.x, &preferences.window.y);
  }

  GLFWwindow* m_window;
  Events& m_events;
  Application& m_application;
  const UiGl& m_gl;
  std::string m_title;
};

}  // namespace

Result<int> runWindow(const ApplicationOptions& options, const std::stop_token& stop) {
  Glfw glfw;
  SWARD_TRY(glfw.start());
  const LoadedPreferences loaded = loadPreferences();
  SWARD_ASSIGN(const WindowHandle window, openWindow(loaded.preferences));
  glfwMakeContextCurrent(window.get());
  glfwSwapInterval(0);  // a software renderer has no use for waiting; frames are only drawn when something changed
  Events events;
  installCallbacks(window.get(), events);
  SWARD_ASSIGN(const UiGl gl,
               UiGl::load([](const char* name) { return reinterpret_cast<void*>(glfwGetProcAddress(name)); }));
  const ImGuiScope imgui(window.get());
  Application application(options, loaded, gl, [] { glfwPostEmptyEvent(); });
  const std::stop_callback wakeOnStop(stop, [] { glfwPostEmptyEvent(); });
  WindowLoop(window.get(), events, application, gl).run(stop);
  application.shutDown(stop.stop_requested());
  return 0;
}

}  // namespace sward::editor
