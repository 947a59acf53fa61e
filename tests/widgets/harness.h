#pragma once

#include "widgets/item_log.h"
#include "widgets/theme.h"

#include "image/image.h"

#include <functional>
#include <string>

#include <imgui.h>

namespace sward::editor {

/// A user interface without a window: a context of ImGui, a display of its own size, and a mouse and keyboard that are
/// set from outside, as the GLFW backend sets them. Every action runs the frames that a real event would take.
class Harness {
 public:
  explicit Harness(float width = 500, float height = 900, ThemeKind kind = ThemeKind::Dark, float scale = 1.0f);
  ~Harness();
  Harness(const Harness&) = delete;
  Harness& operator=(const Harness&) = delete;

  /// What every frame draws, inside a window that fills the display.
  void show(std::function<void()> draw);
  /// Runs frames of 1/60 s.
  void frames(int count = 1);

  /// Centre of a named item; the test fails when it was not drawn.
  ImVec2 at(const std::string& item) const;
  const ItemLog::Item& item(const std::string& name) const;
  bool has(const std::string& item) const { return m_log.find(item) != nullptr; }

  void moveTo(ImVec2 place);
  void press(int button = 0);
  void release(int button = 0);
  void click(const std::string& item, int button = 0);
  void clickAt(ImVec2 place, int button = 0);
  void doubleClickAt(ImVec2 place);
  /// Press at `from`, move to `to` in a few frames, release.
  void drag(ImVec2 from, ImVec2 to, int steps = 4, int button = 0);
  void wheel(float notches);
  /// A key of ImGui's map, pressed and released.
  void key(ImGuiKey key);
  /// Characters as typed, a frame each.
  void type(const std::string& text);
  void hold(bool ctrl, bool shift, bool alt);
  /// Longer than a double-click lasts, so that the next click is a single one.
  void pause() { frames(30); }

  /// The last frame, drawn by a small rasteriser: RGB, display values.
  image::Image picture();

 private:
  ImGuiContext* m_context;
  ItemLog m_log;
  std::function<void()> m_draw;
};

}  // namespace sward::editor
