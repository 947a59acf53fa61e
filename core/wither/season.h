#pragma once

#include "base/curve.h"
#include "base/result.h"
#include "wither/options.h"

#include <vector>

namespace sward::wither {

/// Water and chlorophyll of an autumn over the season, shares in [0, 1] (TVT paper, figure 9).
base::Curve waterCurve(const AgeingOptions& ageing);
base::Curve chlorophyllCurve(const AgeingOptions& ageing);

/// A blade's body at one moment.
struct BladeState {
  double strainAlong = 0.0;   ///< of the vein's length, 0 to 1: a third of the volume it has lost
  double strainAcross = 0.0;  ///< of width and thickness
  double tipRad = 0.0;        ///< how far the tip has turned
};

/// The body's state variables while a season passes, and one step of it. The step solves each linear rate equation
/// exactly with the coefficients of the step's middle, so that every step, a whole season too, gives finite and ordered
/// results; its error is of second order in the step.
struct BodyMotion {
  BladeState state;
  /// `water0` and `water1`: shares at the step's beginning and end; `season` in the middle; `step` of the season, > 0.
  void advance(double season, double step, double water0, double water1, const BodyOptions& body);
};

/// A season worked out once: what a blade is at any weathering degree.
class Season {
 public:
  /// Errors: curves out of their ranges, a weathering curve that falls; values that are not finite.
  static Result<Season> create(const AgeingOptions& ageing, const BodyOptions& body);

  /// The moment in [0, 1] at which the sward has a weathering degree; the earliest where it rests. Clamped.
  double seasonOf(double weathering) const;
  double water(double season) const;        ///< share in [0, 1]
  double chlorophyll(double season) const;  ///< share in [0, 1]
  /// The body of a blade that started `delay` later than the sward; for weathering 0 the state at rest, whatever the
  /// delay. `droop` multiplies the tip's turn.
  BladeState state(double weathering, double delay, double droop) const;
  /// Shares that colour a place s along a blade (0 root to 1 tip) in the same way: the tip leads.
  struct Shares {
    double water = 1.0, chlorophyll = 1.0;
  };
  Shares shares(double weathering, double delay, double s) const;

 private:
  double local(double weathering, double delay, double lead) const;
  AgeingOptions m_ageing;
  base::Curve m_water, m_chlorophyll;
  std::vector<BladeState> m_states;  ///< evenly over the season
};

}  // namespace sward::wither
