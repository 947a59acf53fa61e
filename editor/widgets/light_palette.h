#pragma once

#include "widgets/curve_points.h"
#include "widgets/disc.h"

#include "scene/options.h"

#include <optional>
#include <string>
#include <vector>

namespace sward::editor {

/// A value for each direction of the hemisphere, painted beneath the lights.
struct HemisphereValues {
  int side = 0;                  ///< of the square grid over the disc's box [-1, 1]^2, rows from the south up
  std::vector<float> values;     ///< side * side, at the cells' centres; what lies outside the disc is not read
  double low = 0.0, high = 1.0;  ///< ends of the colours
  std::string title;             ///< "Coverage"
  std::string unit;

  /// Place on the disc (DiscMap::EqualArea) of a cell's centre.
  static glm::dvec2 place(int side, int column, int row);
};

struct LightEvents {
  bool changed = false;
  bool finished = false;
  std::string label;  ///< "move light", for the name of the step
};

/// The directions that are baked, on the hemisphere in equal areas. Drag moves, double-click adds, Delete removes,
/// Shift-click and the rubber band select several, Ctrl+A all. Lights stay above the horizon; angles are rounded to 0.1
/// degrees. Logs itself as "lights:ID", each light as "light:ID:INDEX", the sun as "lights:ID:sun".
class LightPalette {
 public:
  static constexpr std::size_t kMostLights = 1024;

  /// `editable` false: the directions come from a pattern and are only shown and selected.
  LightEvents draw(const char* id, std::vector<scene::SunAngles>& lights, bool editable, float side,
                   const std::optional<SkyAngles>& sun = {}, const HemisphereValues* values = nullptr);
  const PointSelection& selection() const { return m_selection; }
  void select(PointSelection selection) { m_selection = std::move(selection); }

 private:
  struct Frame {
    const char* id;
    std::vector<scene::SunAngles>& lights;
    bool editable;
    ImVec2 centre;
    float radius;
    LightEvents events;
  };
  void pressed(Frame& f);
  void dragged(Frame& f);
  void released(Frame& f);
  void keys(Frame& f);
  void paint(const Frame& f, const std::optional<SkyAngles>& sun, const HemisphereValues* values) const;
  void paintLights(const Frame& f) const;
  void tooltip(const Frame& f, const HemisphereValues* values) const;
  int lightAt(const Frame& f, ImVec2 mouse) const;

  enum class Gesture { None, Move, Band };
  Gesture m_gesture = Gesture::None;
  PointSelection m_selection, m_bandBase;
  std::vector<scene::SunAngles> m_before;
  ImVec2 m_pressedAt;
  bool m_moved = false, m_edited = false;
  std::string m_label;
};

/// A colour of the ramp for values: t from 0 to 1, dark blue over green to yellow, lighter all the way, so that it
/// reads in grey too.
ImU32 rampColour(double t);

}  // namespace sward::editor
