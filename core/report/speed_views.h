#pragma once

#include "base/result.h"
#include "scene/camera.h"

#include <array>
#include <string>

namespace sward::report {

/// A view of the sections speed and grassland: the eye over the origin, `slantDeg` under the horizon, `distanceM` from
/// what it looks at.
struct SpeedView {
  std::string name;
  double slantDeg = 90.0;
  double distanceM = 3.0;
};

inline constexpr int kTilesInView = 200;
inline constexpr double kNearM = 3.0;
inline constexpr double kSpeedFocalLengthMm = 35.0;

/// The eye at a person's height looks at a place a hundred tiles away: to the horizon and beyond.
SpeedView grazingView(double tileSideM);
Result<scene::Camera> cameraOf(const SpeedView& view);
/// The same as a project has it.
scene::View viewOf(const SpeedView& view);

}  // namespace sward::report
