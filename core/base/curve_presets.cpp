#include "base/curve.h"

namespace sward::base {

const std::vector<CurvePreset>& curvePresets() {
  // Powers are given by enough points that the monotone cubic through them stays within two hundredths of them.
  static const std::vector<CurvePreset> presets{
      {"Constant", {{0.0, 1.0}, {1.0, 1.0}}},
      {"Linear", {{0.0, 0.0}, {1.0, 1.0}}},
      {"Linear, falling", {{0.0, 1.0}, {1.0, 0.0}}},
      {"Ease in", {{0.0, 0.0}, {0.25, 0.0625}, {0.5, 0.25}, {0.75, 0.5625}, {1.0, 1.0}}},
      {"Ease out", {{0.0, 0.0}, {0.25, 0.4375}, {0.5, 0.75}, {0.75, 0.9375}, {1.0, 1.0}}},
      {"S", {{0.0, 0.0}, {0.25, 0.15625}, {0.5, 0.5}, {0.75, 0.84375}, {1.0, 1.0}}},
      {"Bump", {{0.0, 0.0}, {0.25, 0.5}, {0.5, 1.0}, {0.75, 0.5}, {1.0, 0.0}}},
      {"Two humps", {{0.0, 0.0}, {0.25, 1.0}, {0.5, 0.15}, {0.7, 0.5}, {1.0, 0.0}}}};
  return presets;
}

Curve presetCurve(const CurvePreset& preset, double xLow, double xHigh, double yLow, double yHigh) {
  std::vector<CurvePoint> points;
  for (const CurvePoint& p : preset.points) {
    points.push_back({xLow + p.x * (xHigh - xLow), yLow + p.y * (yHigh - yLow)});
  }
  return Curve::fromPoints(std::move(points)).value();
}

}  // namespace sward::base
