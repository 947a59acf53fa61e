#pragma once

#include "base/curve.h"

#include <vector>

namespace sward::base {

/// Draws numbers whose density is proportional to a curve (negative values count as 0) over [low, high], by inverting
/// its cumulative integral. Between nodes (an even grid and the curve's own points) the density is taken as linear, so
/// that no spike between two grid lines is lost.
class CurveSampler {
 public:
  CurveSampler(const Curve& density, double low, double high);

  /// False when the curve is zero all over [low, high] or empty: nothing can be drawn then.
  bool possible() const { return m_total > 0.0; }
  /// The number below which a share u of all draws lies, u in [0, 1]; increases with u. The middle of [low, high] when
  /// nothing can be drawn.
  double operator()(double u) const;
  /// Mean of the draws.
  double mean() const;

 private:
  struct Node {
    double x = 0.0;
    double density = 0.0;
    double below = 0.0;  ///< integral of the density up to x
  };
  std::vector<Node> m_nodes;
  double m_total = 0.0;
};

}  // namespace sward::base
