#pragma once

#include "widgets/disc.h"
#include "widgets/number_field.h"

#include <functional>
#include <span>

namespace sward::editor {

struct SkyDomeOptions {
  /// Colour of the sky toward a direction; empty: one that is made up from where the sun stands.
  std::function<ImU32(const SkyAngles&)> colour;
  std::span<const SkyAngles> path;  ///< the sun's way over the day, drawn beneath it; may be empty
  bool enabled = true;              ///< false: the sun is shown, but not dragged (a moment sets it)
};

/// A made-up sky for a sun at `sun`: blue by day, warm at the horizon toward a low sun, dark by night.
ImU32 suggestedSky(const SkyAngles& direction, const SkyAngles& sun);

/// The sky from above with the sun on it, `side` pixels wide and a line of text higher. A press anywhere moves the sun
/// there and goes on as a drag (Shift: its azimuth alone, Ctrl: its elevation alone); the ring outside the horizon is
/// twilight, down to -18 degrees. Angles are rounded to 0.1 degrees. Logs itself as "sky:ID" and "sky:ID:sun".
EditState skyDome(const char* id, SkyAngles& sun, float side, const SkyDomeOptions& options = {});

}  // namespace sward::editor
