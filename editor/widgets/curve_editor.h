#pragma once

#include "widgets/curve_points.h"
#include "widgets/number_field.h"

#include <span>
#include <string>
#include <vector>

#include <imgui.h>

namespace sward::editor {

/// One of the curves that are drawn over one another.
struct CurveLayer {
  std::string name;
  base::Curve* curve = nullptr;  ///< edited in place; must outlive the call
  ImU32 colour = 0;              ///< 0: the theme's for its place in the list
  bool visible = true;
  bool locked = false;                   ///< shown, but neither edited nor chosen by a click
  const base::Curve* builtIn = nullptr;  ///< what holds while the curve has no points; the first edit starts from it
};

/// What the axes mean and where points may stand.
struct CurveAxes {
  CurveLimits limits;
  std::string xLabel, yLabel;
  std::string xUnit, yUnit;         ///< behind numbers; may be empty
  double xSnap = 0.0, ySnap = 0.0;  ///< steps of the grid that points snap to; 0: the lines that are drawn
};

struct CurvePreset {
  std::string name;
  base::Curve curve;  ///< an empty one: back to what is built in
};

/// What the user did in one frame: as FieldEvents, one drag is many `changed` and one `finished`.
struct CurveEvents {
  bool changed = false;
  bool finished = false;
  std::size_t layer = 0;
  std::string label;  ///< "move curve point", for the name of the step
};

/// The editor of curves, drawn as they are evaluated.
///
/// Double-click or Ctrl-click adds a point (on the line: without changing it), drags move, Shift-click and the rubber
/// band select several, Delete removes; snap to the grid by its button (Alt does the opposite), Shift keeps a drag to
/// one axis. The wheel zooms about the mouse (Shift: x alone, Ctrl: y alone), the middle button pans, F frames all.
/// Arrows nudge by a hundredth, with Shift by a thousandth; Ctrl+A, C and V select, copy and paste points as text.
/// Points stop at their neighbours and at the limits. A click on another curve's line makes that one the active one.
///
/// Below about 160 pixels of height or 260 of width (at scale 1) the bar is left out; the context menu has all of it.
class CurveEditor {
 public:
  /// Draws into `size` pixels at the cursor. `layers` may change from frame to frame.
  CurveEvents draw(const char* id, std::span<CurveLayer> layers, const CurveAxes& axes, ImVec2 size,
                   std::span<const CurvePreset> presets = {});

  std::size_t active() const { return m_active; }
  void setActive(std::size_t layer);
  const PointSelection& selection() const { return m_selection; }
  bool snaps() const { return m_snaps; }
  void setSnaps(bool on) { m_snaps = on; }
  /// Shows the limits' whole range; so does the first frame, and one with other limits.
  void frameAll() { m_framed = false; }

 private:
  enum class Gesture { None, Move, Band, Pan };
  /// One frame's arguments and layout.
  struct Frame {
    std::string id;
    std::span<CurveLayer> layers;
    const CurveAxes* axes = nullptr;
    std::span<const CurvePreset> presets;
    ImVec2 min, max;  ///< of the plot
    bool compact = false;
    bool hovered = false;
    bool focused = false;
    CurveEvents events;
  };

  // curve_editor.cpp: layout, the bar and the menu.
  void bar(Frame& f, float width);
  void layerChips(Frame& f, float right);
  void pointEntry(Frame& f, float width);
  void barButtons(Frame& f);
  void contextMenu(Frame& f);
  void menuItems(Frame& f);
  void presetItems(Frame& f);
  void plot(Frame& f);

  // curve_gestures.cpp: what mouse and keys do.
  void gestures(Frame& f);
  void pressed(Frame& f);
  void dragged(Frame& f);
  void released(Frame& f);
  void navigate(Frame& f);
  void keys(Frame& f);
  void nudge(Frame& f);
  void add(Frame& f, ImVec2 mouse);
  void remove(Frame& f);
  void copy(const Frame& f) const;
  void paste(Frame& f);
  void replace(Frame& f, const base::Curve& curve, const std::string& label);
  bool apply(Frame& f, CurvePoints points, const std::string& label);
  int pointAt(const Frame& f, ImVec2 mouse) const;
  int layerAt(const Frame& f, ImVec2 mouse) const;

  // curve_paint.cpp
  void paint(Frame& f);
  void paintGrid(const Frame& f) const;
  void paintTicks(const Frame& f) const;
  void paintLayer(const Frame& f, std::size_t index) const;
  void paintPoints(const Frame& f) const;
  void paintReadout(const Frame& f) const;

  bool editable(const Frame& f) const;
  CurvePoints pointsOf(const Frame& f) const;
  static ImU32 colourOf(const Frame& f, std::size_t index);
  static const base::Curve& shownCurve(const CurveLayer& layer);
  ImVec2 toScreen(const Frame& f, double x, double y) const;
  double xAt(const Frame& f, float screenX) const;
  double yAt(const Frame& f, float screenY) const;
  double xStep(const Frame& f) const;
  double yStep(const Frame& f) const;
  bool snapping() const;

  std::size_t m_active = 0;
  PointSelection m_selection;
  bool m_snaps = false;
  bool m_framed = false;
  CurveLimits m_framedFor;
  double m_x0 = 0, m_x1 = 1, m_y0 = 0, m_y1 = 1;  ///< what the plot shows

  Gesture m_gesture = Gesture::None;
  ImVec2 m_pressedAt;
  bool m_moved = false;
  bool m_edited = false;  ///< this gesture changed the curve: its end finishes a step
  std::size_t m_grabbed = 0;
  CurvePoints m_before;       ///< points when the drag began
  PointSelection m_bandBase;  ///< selection that the band adds to
  std::string m_gestureLabel;
  bool m_nudging = false;
};

}  // namespace sward::editor
