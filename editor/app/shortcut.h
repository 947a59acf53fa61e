#pragma once

#include <string>
#include <string_view>

namespace sward::editor {

/// A key with modifiers. Keys are those of GLFW: upper-case ASCII for letters and digits, its own numbers for others.
struct Shortcut {
  int key = 0;  ///< 0: none
  bool control = false, shift = false, alt = false;

  bool empty() const { return key == 0; }
  bool operator==(const Shortcut&) const = default;
  /// "Ctrl+Shift+S"; empty for none.
  std::string text() const;
  /// The shortcut that text() gave; none for text that names no known key.
  static Shortcut parse(std::string_view text);
  /// Without control or alt, so that it must not fire while text is typed.
  bool plain() const { return !control && !alt; }
};

}  // namespace sward::editor
