#pragma once

#include "base/result.h"
#include "leaf/options.h"
#include "leaf/prospect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace sward::leaf {

/// An error names the first value of the options that is not finite or outside its range, with its unit.
Result<void> checkOptions(const LeafOptions& options);

/// Linear Rec. 709 RGB under D65, in [0, 1], of which no channel's sum is above 1: a diffuser of these colours. A
/// highlight, if any, comes on top.
struct LeafColour {
  glm::dvec3 reflectance{0.0}, transmittance{0.0};
};

/// The same with what it cost to make it.
struct LeafColourDetail {
  LeafColour colour;
  /// How far the colours were moved into the gamut (GamutColour) and below a sum of 1, 0 where they were there.
  double desaturatedReflectance = 0.0, desaturatedTransmittance = 0.0;
  int clampedSamples = 0;  ///< of the subtraction model
};

/// Of one leaf, from its contents, through plates with the coefficients of PROSPECT-D. Errors of checkContents.
Result<LeafColourDetail> leafColour(const LeafContents& contents, SurfaceLight light = kSurfaceRemoved);

/// What a leaf of these options contains when it is fresh, and when the given shares of its chlorophyll and water
/// remain, each in [0, 1]. Dry matter stays; carotenoids stay while the leaf has its water, as in the paper. Without
/// water, structure, brown pigments and carotenoids are what the options say (...WhenDry): structure moves evenly with
/// the loss (cells collapse as they empty), the pigments with its square (brown ones come of phenols that oxidise in
/// cells that die, late: Feret et al. 2017).
LeafContents freshContents(const LeafOptions& options);
LeafContents agedContents(const LeafOptions& options, double chlorophyllShare, double waterShare);

/// Of an ageing leaf, by options.model; water counts in the plates alone. Errors: shares outside [0, 1]; checkOptions.
Result<LeafColourDetail> agedColour(const LeafOptions& options, double chlorophyllShare, double waterShare);

/// agedColour from a table, for many leaves. Between nodes it is bilinear in the root of chlorophyll's share, as whose
/// function colours change evenly (by Beer's law they change fastest where little is left), and in water's.
class AgeingColours {
 public:
  static constexpr std::size_t kChlorophyllNodes = 65, kWaterNodes = 33;

  /// Errors of agedColour.
  static Result<AgeingColours> build(const LeafOptions& options);

  /// Shares outside [0, 1] count as the nearer end, NaN as 0. Within 0.5 of CIEDE2000 from agedColour at the default
  /// options (leaf tests).
  LeafColour operator()(double chlorophyllShare, double waterShare) const {
    const double u = std::sqrt(limited(chlorophyllShare)) * static_cast<double>(kChlorophyllNodes - 1);
    const double v = limited(waterShare) * static_cast<double>(kWaterNodes - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(u), kChlorophyllNodes - 2);
    const std::size_t j = std::min(static_cast<std::size_t>(v), kWaterNodes - 2);
    const double x = u - static_cast<double>(i), y = v - static_cast<double>(j);
    const Node* low = m_nodes.data() + j * kChlorophyllNodes + i;
    const Node* high = low + kChlorophyllNodes;
    const double a = (1.0 - x) * (1.0 - y), b = x * (1.0 - y), c = (1.0 - x) * y, d = x * y;
    std::array<double, 6> sum{};
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] = a * static_cast<double>(low[0][k]) + b * static_cast<double>(low[1][k]) +
               c * static_cast<double>(high[0][k]) + d * static_cast<double>(high[1][k]);
    }
    return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}};
  }

  /// The same in single precision, for very many leaves: reflectance, transmittance.
  std::array<float, 6> channels(float chlorophyllShare, float waterShare) const {
    const float u = std::sqrt(limited(chlorophyllShare)) * static_cast<float>(kChlorophyllNodes - 1);
    const float v = limited(waterShare) * static_cast<float>(kWaterNodes - 1);
    const auto i = std::min(static_cast<std::int32_t>(u), static_cast<std::int32_t>(kChlorophyllNodes) - 2);
    const auto j = std::min(static_cast<std::int32_t>(v), static_cast<std::int32_t>(kWaterNodes) - 2);
    const float x = u - static_cast<float>(i), y = v - static_cast<float>(j);
    const Node* low = m_nodes.data() + static_cast<std::size_t>(j) * kChlorophyllNodes + static_cast<std::size_t>(i);
    const Node* high = low + kChlorophyllNodes;
    const float a = (1.0f - x) * (1.0f - y), b = x * (1.0f - y), c = (1.0f - x) * y, d = x * y;
    std::array<float, 6> sum;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] = a * low[0][k] + b * low[1][k] + c * high[0][k] + d * high[1][k];
    }
    return sum;
  }

  std::size_t bytes() const { return m_nodes.size() * sizeof(Node); }

 private:
  static double limited(double share) { return share > 0.0 ? std::min(share, 1.0) : 0.0; }
  static float limited(float share) { return share > 0.0f ? std::min(share, 1.0f) : 0.0f; }

  using Node = std::array<float, 6>;  ///< reflectance, transmittance
  std::vector<Node> m_nodes;          ///< rows of kChlorophyllNodes, from no water to all of it
};

}  // namespace sward::leaf
