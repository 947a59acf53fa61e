#pragma once

#include "leaf/ageing.h"
#include "wither/withered_model.h"

namespace sward::wither {

/// Ages colours that an author gave as a leaf's would (leaf::AgeingColours). An authored colour is a fresh leaf's times
/// a tint; the aged one is the aged leaf's times that tint, of which kLastingTint (as an exponent) outlives the
/// chlorophyll: what makes one green differ from another is mostly how much of it there is. Fresh shares leave a colour
/// as it is, to rounding; no channel of reflectance and transmittance together passes 1.
AgeColour ageColour(const leaf::AgeingColours& colours);

inline constexpr double kLastingTint = 0.2;

}  // namespace sward::wither
