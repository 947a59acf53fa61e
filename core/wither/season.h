#pragma once

#include "base/curve.h"
#include "base/result.h"
#include "wither/options.h"

#include <vector>

namespace sward::wither {

/// Water and chlorophyll of an autumn over the season, shares in [0, 1] (TVT paper, figure 9, whose numbers are not
/// preserved: sigmoids that fall to the ends that the text gives).
base::Curve waterCurve(const AgeingOptions& ageing);
base::Curve chlorophyllCurve(const AgeingOptions& ageing);

/// A blade's body at one moment.
struct BladeState {
  double strainAlong = 0.0;   ///< of the vein's length, 0 to 1: a third of the volume that the vein has lost
  double strainAcross = 0.0;  ///< of width and thickness, 0 to 1
  double tipRad = 0.0;        ///< how far the tip has turned
};

/// How far the tip of a blade turns in the end when it holds a share of water: 0 at 1 (and above), `droopDeg` at 0 (and
/// below), strictly falling between. The blade is a beam that turns by x s^2 along s, 0 to x at its tip; x is 10
/// degrees under its own weight at rest. Gravity's torque about the root is proportional to T(x), the horizontal reach
/// of its centre of mass, and balances stiffness k(w) x: T(x) / x falls strictly for x below pi, so that there is one
/// solution for every k. k follows the turgor, 1 - (1 - w)^3: it stays near 1 until a third of the water is lost.
double restingTurnRad(double water, double droopDeg);

/// The body's state variables while a season passes, and one step of it.
///
/// Shrinking (science.md section 4): volume strain eps0 = k dw of vein and mesophyll; its rate is multiplied by
/// E_ref / E(t), E growing over the season from E_ref to E_ref `stiffening` (mesophyll) and twice as much beyond E_ref
/// (vein: E_v > E_m). Length follows the vein, whose strain is the same in all directions: lambda = 1 - eps_v / 3. What
/// else the mesophyll loses of its volume is shared evenly by width and thickness: 1 - eps_m = lambda mu^2.
/// Falling: d tip / dt = (restingTurn(w) - tip) / response.
///
/// A step takes dw exactly and E in its middle; the turn is solved exactly for a resting turn that is linear over the
/// step. Each new value is then a mean (weights >= 0, sum 1) of the old one and of what the ends of the step ask for,
/// so that any step, a whole season too, is finite and ordered; halving the step divides the error by four.
struct BodyMotion {
  BladeState state;
  double veinLoss = 0.0, mesophyllLoss = 0.0;  ///< of their volumes, 0 to 1
  /// `water0` and `water1`: shares at the step's beginning and end, cut to [0, 1]; `season` in the middle; `step` of
  /// the season, > 0.
  void advance(double season, double step, double water0, double water1, const BodyOptions& body);
};

/// A season worked out once: what a blade is at any weathering degree.
class Season {
 public:
  /// Errors: curves out of [0, 1], a weathering curve that falls, values that are out of range or not finite.
  static Result<Season> create(const AgeingOptions& ageing, const BodyOptions& body);

  /// The moment in [0, 1] at which the sward has a weathering degree; the earliest where it rests. Degrees that the
  /// curve never reaches give the earliest moment of the nearest that it does.
  double seasonOf(double weathering) const;
  double water(double season) const;        ///< share in [0, 1]
  double chlorophyll(double season) const;  ///< share in [0, 1]

  /// The body of a blade that started `delay` later than the sward; at season 0 the state at rest, whatever the delay.
  /// `droop` multiplies the tip's turn, which stays below 175 degrees. The leaf at rest is what the water curve's value
  /// at 0 makes it: only water lost from there counts.
  BladeState stateAt(double season, double delay, double droop) const;
  BladeState state(double weathering, double delay, double droop) const {
    return stateAt(seasonOf(weathering), delay, droop);
  }
  /// Shares that colour a place s along a blade (0 root to 1 tip) in the same way. The tip leads, the blade's middle
  /// follows the curves.
  struct Shares {
    double water = 1.0, chlorophyll = 1.0;
  };
  Shares sharesAt(double season, double delay, double s) const;
  Shares shares(double weathering, double delay, double s) const { return sharesAt(seasonOf(weathering), delay, s); }

 private:
  AgeingOptions m_ageing;
  base::Curve m_water, m_chlorophyll;
  std::vector<BladeState> m_states;  ///< evenly over the season
};

/// The moment that counts for a place that is `ahead` of the sward (of the season, below 0: behind): season + ahead
/// once some of the season has passed, cut to [0, 1], but 0 at 0. Never falls with the season.
double ownSeason(double season, double ahead);

}  // namespace sward::wither
