#pragma once

#include <string>
#include <vector>

#include <imgui.h>

namespace sward::editor {

enum class Severity { Info, Done, Warning, Error };

/// Notices in a corner of the window that ask for nothing and go by themselves.
class Toasts {
 public:
  static constexpr double kUsualS = 5.0;
  static constexpr double kForever = -1.0;

  /// Returns the notice's number. The same text again only renews the one that is shown. `action` (may be empty) is the
  /// text of a button; `lastsS` in seconds, counted by ImGui's clock and not while the mouse rests on the notice.
  int add(Severity severity, std::string text, std::string action = {}, double lastsS = kUsualS);
  void remove(int number);

  /// Draws them from the lower right corner of `area` upward, newest below. Returns the number of the notice whose
  /// action was clicked, which closes it; 0 for none.
  int draw(ImVec2 areaMin, ImVec2 areaMax);

  std::size_t count() const { return m_toasts.size(); }
  /// Something will change without input, so that the window must go on redrawing.
  bool needFrames() const;

 private:
  struct Toast {
    int number;
    Severity severity;
    std::string text, action;
    double leftS;
    double lastsS;
  };
  /// Draws one with its bottom right corner at `corner`; its height, and what was clicked.
  struct Drawn {
    float height = 0.0f;
    bool closed = false, acted = false;
  };
  Drawn drawOne(Toast& toast, ImVec2 corner, float width);

  std::vector<Toast> m_toasts;
  int m_next = 1;
};

}  // namespace sward::editor
