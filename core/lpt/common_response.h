#pragma once

#include "base/bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt {

/// What the common response reads of a texel: 1; sky term, reflected and transmitted; coverage; and openness, the
/// product of 1 - coverage over the layers before it. All in [0, 1], and stored or known of a texel anyway.
inline constexpr int kTexelFeatures = 5;
using TexelFeatures = std::array<float, kTexelFeatures>;

/// Coordinates are cut off there: beyond four times the mean are only outliers, which would set the range of what is
/// quantised.
inline constexpr float kLargestCoordinate = 4.0f;

/// The response that all texels of a layer set share, linear in TexelFeatures and, in the light, a PTM; and the layer
/// coordinate g (LayerCoordinate::Response): its mean over the fitted lights, as a multiple of the weighted mean over
/// the set, cut to [0, kLargestCoordinate]. An LPT then holds what a column differs from it:
///   response = common(l, features) + sum_j b_j responseBasis(l, g)_j
/// It costs 70 numbers a layer for a whole set. Ours: in the paper the third variable is the layer's depth.
struct CommonResponse {
  static constexpr int kFunctions = 7;  ///< the six of ptmBasis, and the coordinate
  int channels = 0;
  std::vector<float> values;  ///< [layer][channel][function][feature]; empty: there is none

  bool empty() const { return values.empty(); }
  std::size_t bytes() const { return values.size() * sizeof(float); }
  /// Whether it is one of that many layers and channels, and finite.
  bool fits(int layers, int channelCount) const;
  bool operator==(const CommonResponse&) const = default;
};

/// The same for one light.
class CommonAtLight {
 public:
  static constexpr std::size_t kPerChannel = 2 * kTexelFeatures;

  CommonAtLight() = default;
  /// Of all layers, or of one.
  CommonAtLight(const CommonResponse& common, const glm::dvec3& light);
  CommonAtLight(const CommonResponse& common, const glm::dvec3& light, int layer);

  /// [layer][channel][response, coordinate][feature]
  std::span<const float> weights() const { return m_weights; }
  float response(int layer, int channel, const TexelFeatures& features) const {
    return sum(layer, channel, 0, features);
  }
  float coordinate(int layer, int channel, const TexelFeatures& features) const {
    const float g = sum(layer, channel, kTexelFeatures, features);
    return g > 0.0f ? (g < kLargestCoordinate ? g : kLargestCoordinate) : 0.0f;
  }

 private:
  /// In float and in this order, as shaders/relight.
  float sum(int layer, int channel, std::size_t first, const TexelFeatures& f) const {
    const std::size_t set =
        static_cast<std::size_t>(layer - m_firstLayer) * m_channels + static_cast<std::size_t>(channel);
    const float* w = &m_weights[set * kPerChannel + first];
    return w[0] + w[1] * f[1] + w[2] * f[2] + w[3] * f[3] + w[4] * f[4];
  }

  void addSets(const CommonResponse& common, const glm::dvec3& light, std::size_t begin, std::size_t end);

  std::size_t m_channels = 0;
  int m_firstLayer = 0;
  std::vector<float> m_weights;
};

/// Features of the texels of one column, layers ascending.
class ColumnFeatures {
 public:
  TexelFeatures next(float skyReflected, float skyTransmitted, float coverage) {
    const TexelFeatures features{1.0f, skyReflected, skyTransmitted, coverage, m_open};
    m_open *= 1.0f - coverage;
    return features;
  }
  float open() const { return m_open; }

 private:
  float m_open = 1.0f;
};

/// Cache payload. load returns false on damaged data and leaves `common` as it was.
void save(base::ByteWriter& out, const CommonResponse& common);
bool load(base::ByteReader& in, CommonResponse& common);

}  // namespace sward::lpt
