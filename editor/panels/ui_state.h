#pragma once

#include "document/selection.h"
#include "live/view_service.h"
#include "render/view_mode.h"
#include "scene/options.h"

#include <cstdint>
#include <optional>
#include <string>

namespace sward::editor {

/// What a drag in the viewport does.
enum class ViewportTool { Orbit, Sun };
/// What stands below the viewport.
enum class BottomTab { Curves, Season, Lights, Day, History };

/// How the viewport compares two ways of drawing.
struct CompareState {
  bool on = false;
  Comparison::Show show = Comparison::Show::Split;
  double splitAt = 0.5;
  /// What the right half shows: another way to draw the same bake, another fit of the light response, or the truth.
  enum class Other { March, Blended, BlendedPaper, Ptm, LptPaper, Reference } other = Other::Blended;
  double gain = 4.0;
  bool operator==(const CompareState&) const = default;
};

/// The project's sequence that plays in the viewport without touching the document.
struct SeasonPlay {
  bool running = false;
  bool loop = true;
  double seconds = 0.0;      ///< into the sequence, 0 to frames / framesPerSecond
  std::optional<double> at;  ///< moment in [0, 1] that is shown; none: the document's own
  double weathering = 0.0;   ///< degree at that moment
};

/// State of the window that belongs to no document: never undone, never saved with the project.
struct UiState {
  Selection selection;
  scene::View camera;                    ///< of the viewport; views of the project are places it can be put
  std::optional<std::size_t> boundView;  ///< the camera is this view's: moving it edits the view
  ViewportTool tool = ViewportTool::Orbit;
  render::ViewMode mode;
  CompareState compare;
  BottomTab bottomTab = BottomTab::Curves;
  std::string activeCurve;  ///< path of the curve that the curve panel edits
  bool showOutliner = true, showInspector = true, showBottom = true;
  bool inputActive = false;  ///< a drag in the viewport or a field: pictures answer at half resolution
  double lastMotion = -1e9;  ///< seconds; of the camera
  bool playingDay = false;
  SeasonPlay season;
};

}  // namespace sward::editor
