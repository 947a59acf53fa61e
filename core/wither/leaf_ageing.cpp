#include "wither/leaf_ageing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

namespace sward::wither {
namespace {

/// Nothing that grows is blacker: tints stay finite. A fresh leaf lets through no blue that a display could show; that
/// channel counts as so dark throughout, since an authored one would go black at the season's first moment otherwise.
constexpr float kDarkest = 1e-3f;

/// Reflectances and transmittances of three channels, and two to fill vectors.
using Channels = std::array<float, 8>;

/// Binary logarithm of a normal positive number, to 2e-7: 2 atanh of (m - 1) / (m + 1), m within a root of 2 from 1.
float log2Of(float x) {
  constexpr float kTwoOverLn2 = 2.88539008f;
  constexpr std::int32_t kRootHalf = 0x3f3504f3;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x) - kRootHalf;
  const std::int32_t exponent = bits >> 23;
  const float m = std::bit_cast<float>((bits & 0x7fffff) + kRootHalf);
  const float t = (m - 1.0f) / (m + 1.0f), q = t * t;
  const float series = 1.0f + q * (1.0f / 3 + q * (1.0f / 5 + q * (1.0f / 7 + q * (1.0f / 9))));
  return static_cast<float>(exponent) + kTwoOverLn2 * t * series;
}

/// 2 to the power of x between -100 and 100, to 2e-7 of itself (Taylor).
float exp2Of(float x) {
  constexpr float kLn2 = 0.69314718f, kRound = 12582912.0f;
  const float n = (x + kRound) - kRound;
  const float r = (x - n) * kLn2;
  const float p =
      1.0f + r * (1.0f + r * (0.5f + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
  return p * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

/// (colour / fresh) to the power of `exponent`, with the binary logarithms of `fresh`. Loops of all channels, each
/// short enough to become vector instructions.
Channels powersOf(const Channels& colours, const Channels& logFresh, float exponent) {
  Channels logs, powers;
  for (std::size_t c = 0; c < logs.size(); ++c) logs[c] = colours[c] > kDarkest ? colours[c] : kDarkest;
  for (std::size_t c = 0; c < logs.size(); ++c) logs[c] = log2Of(logs[c]);
  for (std::size_t c = 0; c < logs.size(); ++c) powers[c] = exp2Of(exponent * (logs[c] - logFresh[c]));
  return powers;
}

}  // namespace

AgeColour ageColour(const leaf::AgeingColours& colours) {
  // Copies of the function share one table.
  const auto table = std::make_shared<const leaf::AgeingColours>(colours);
  const std::array<float, 6> freshLeaf = table->channels(1.0f, 1.0f);
  Channels fresh{};  // logarithms
  for (std::size_t c = 0; c < freshLeaf.size(); ++c) fresh[c] = log2Of(std::max(freshLeaf[c], kDarkest));
  return [table, fresh](glm::vec3& diffuse, glm::vec3& transmitted, const Season::Shares& shares) {
    if (shares.chlorophyll >= 1.0 && shares.water >= 1.0) return;
    const auto chlorophyll = static_cast<float>(shares.chlorophyll), water = static_cast<float>(shares.water);
    const float green = std::clamp(std::min(chlorophyll, water), 0.0f, 1.0f);
    const float exponent = static_cast<float>(kLastingTint) + (1.0f - static_cast<float>(kLastingTint)) * green;
    const std::array<float, 6> now = table->channels(chlorophyll, water);
    const Channels own{diffuse.r, diffuse.g, diffuse.b, transmitted.r, transmitted.g, transmitted.b, 1.0f, 1.0f};
    Channels aged = powersOf(own, fresh, exponent);
    for (std::size_t c = 0; c < now.size(); ++c) aged[c] *= now[c] > kDarkest ? now[c] : kDarkest;
    for (int c = 0; c < 3; ++c) {
      const float r = aged[static_cast<std::size_t>(c)];
      // What lets no light through, wood or petals, does not begin to.
      const float t = transmitted[c] > 0.0f ? aged[static_cast<std::size_t>(c) + 3] : 0.0f;
      const float scale = 1.0f / std::max(r + t, 1.0f);
      diffuse[c] = r * scale;
      transmitted[c] = t * scale;
    }
  };
}

}  // namespace sward::wither
