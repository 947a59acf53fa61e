#include "wither/leaf_ageing.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace sward::wither {
namespace {

/// Nothing that grows is blacker: tints stay finite. A fresh leaf lets through no blue that a display could show; that
/// channel counts as so dark throughout, since an authored one would go black at the season's first moment otherwise.
constexpr double kDarkest = 1e-3;

double aged(double colour, double fresh, double now, double exponent) {
  const double tint = std::max(colour, kDarkest) / std::max(fresh, kDarkest);
  return std::max(now, kDarkest) * std::pow(tint, exponent);
}

}  // namespace

AgeColour ageColour(const leaf::AgeingColours& colours) {
  // Copies of the function share one table.
  const auto table = std::make_shared<const leaf::AgeingColours>(colours);
  const leaf::LeafColour fresh = (*table)(1.0, 1.0);
  return [table, fresh](glm::vec3& diffuse, glm::vec3& transmitted, const Season::Shares& shares) {
    if (shares.chlorophyll >= 1.0 && shares.water >= 1.0) return;
    const leaf::LeafColour now = (*table)(shares.chlorophyll, shares.water);
    const double green = std::clamp(std::min(shares.chlorophyll, shares.water), 0.0, 1.0);
    const double exponent = kLastingTint + (1.0 - kLastingTint) * green;
    for (int c = 0; c < 3; ++c) {
      const double r = aged(double{diffuse[c]}, fresh.reflectance[c], now.reflectance[c], exponent);
      // What lets no light through, wood or petals, does not begin to.
      const double t = transmitted[c] > 0.0f
                           ? aged(double{transmitted[c]}, fresh.transmittance[c], now.transmittance[c], exponent)
                           : 0.0;
      const double scale = 1.0 / std::max(r + t, 1.0);
      diffuse[c] = static_cast<float>(r * scale);
      transmitted[c] = static_cast<float>(t * scale);
    }
  };
}

}  // namespace sward::wither
