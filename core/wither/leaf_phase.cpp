#include "wither/leaf_phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::wither {

LeafSidesSeen leafSidesSeen(double cosine) {
  const double c = std::clamp(cosine, -1.0, 1.0);
  const double b = std::acos(c), s = std::sqrt(1.0 - c * c);
  constexpr double kThird = 1.0 / (3.0 * std::numbers::pi);
  return {((std::numbers::pi - b) * c + s) * kThird, (s - b * c) * kThird};
}

double leafPhase(double cosine, double passed) {
  const LeafSidesSeen seen = leafSidesSeen(cosine);
  return 8.0 * (seen.same + passed * seen.different) / (1.0 + passed);
}

}  // namespace sward::wither
