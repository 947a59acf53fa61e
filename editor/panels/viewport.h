#pragma once

#include "panels/panel_context.h"

#include <cstdint>
#include <optional>
#include <string>

namespace sward::editor {

/// The picture in the middle, and what the mouse and keys do to the camera and the sun over it. Draws itself into the
/// current ImGui window's whole content.
///   left drag orbit (with Alt: look around), middle or Shift+left drag pan, wheel dolly, right drag look and fly
///   (WASD, Q and E down and up, Shift faster); with L held or the sun tool, a left drag moves the sun.
class ViewportPanel {
 public:
  void draw(PanelContext& context);
  /// Pixels of the picture that the panel wants.
  int width() const { return m_width; }
  int height() const { return m_height; }
  double aspect() const { return m_height > 0 ? static_cast<double>(m_width) / m_height : 1.0; }
  /// A key that moves the camera is held: frames should follow one another.
  bool flying() const { return m_flying; }

 private:
  void header(PanelContext& context);
  void modes(PanelContext& context);
  void picture(PanelContext& context);
  void navigate(PanelContext& context, bool hovered);
  void dragSun(PanelContext& context);
  bool dragSplit(PanelContext& context);
  /// A line of text over a corner of the picture.
  struct Pill {
    std::string text;
    std::uint32_t dot = 0;  ///< its colour, as ImGui packs them
    bool right = false, bottom = false;
  };
  void pill(const Pill& shown, float scale) const;
  static Pill captionOf(const std::optional<ReferenceState>& reference);
  void overlays(PanelContext& context);
  void compareOverlay(PanelContext& context) const;
  void moved(PanelContext& context);

  int m_width = 0, m_height = 0;
  float m_left = 0.0f, m_top = 0.0f;  ///< of the picture on the screen
  enum class Drag { None, Orbit, Pan, Look, Sun, Split } m_drag = Drag::None;
  double m_lastSeconds = 0.0;
  bool m_flying = false;
};

}  // namespace sward::editor
