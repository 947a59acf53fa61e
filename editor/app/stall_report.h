#pragma once

#include "app/application.h"
#include "base/result.h"

#include <array>
#include <cstddef>

namespace sward::editor {

/// What the interface's thread was kept from while something baked.
struct StallMeasurement {
  std::size_t frames = 0;
  double leastMs = 0.0, medianMs = 0.0, worstMs = 0.0;
  std::array<std::size_t, StallMeter::kEndsMs.size() + 1> histogram{};
  int pictures = 0;  ///< that changed on screen during the drag
  double dragSeconds = 0.0;
};

/// Runs the editor without a window (1280 x 800) on a project, drags the first procedural plant's height for `seconds`
/// with a change in every frame, and goes on until everything is baked at full quality, or as long again. Errors: no
/// EGL, no procedural grass in the project.
Result<StallMeasurement> measureStalls(const ApplicationOptions& options, double seconds);

}  // namespace sward::editor
