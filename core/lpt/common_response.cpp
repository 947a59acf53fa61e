#include "lpt/common_response.h"

#include "lpt/polynomial.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt {

bool CommonResponse::fits(int layers, int channelCount) const {
  return channels == channelCount &&
         values.size() ==
             static_cast<std::size_t>(layers) * static_cast<std::size_t>(channels) * kFunctions * kTexelFeatures &&
         std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); });
}

CommonAtLight::CommonAtLight(const CommonResponse& common, const glm::dvec3& light)
    : m_channels(static_cast<std::size_t>(common.channels)) {
  addSets(common, light, 0, common.values.size() / (CommonResponse::kFunctions * kTexelFeatures));
}

CommonAtLight::CommonAtLight(const CommonResponse& common, const glm::dvec3& light, int layer)
    : m_channels(static_cast<std::size_t>(common.channels)), m_firstLayer(layer) {
  const std::size_t first = static_cast<std::size_t>(layer) * m_channels;
  addSets(common, light, first, first + m_channels);
}

void CommonAtLight::addSets(const CommonResponse& common, const glm::dvec3& light, std::size_t begin, std::size_t end) {
  constexpr std::size_t kFeatures = kTexelFeatures, kSet = CommonResponse::kFunctions * kFeatures;
  const auto functions = ptmBasis(light.x, light.y);
  m_weights.reserve((end - begin) * kPerChannel);
  for (std::size_t set = begin; set < end; ++set) {
    const float* values = &common.values[set * kSet];
    for (std::size_t f = 0; f < kFeatures; ++f) {
      double sum = 0.0;
      for (std::size_t p = 0; p < functions.size(); ++p) {
        sum += functions[p] * static_cast<double>(values[p * kFeatures + f]);
      }
      m_weights.push_back(static_cast<float>(sum));
    }
    const float* coordinate = values + functions.size() * kFeatures;
    m_weights.insert(m_weights.end(), coordinate, coordinate + kFeatures);
  }
}

void save(base::ByteWriter& out, const CommonResponse& common) {
  out.value(common.channels);
  out.array(common.values);
}

bool load(base::ByteReader& in, CommonResponse& common) {
  CommonResponse read;
  in.value(read.channels);
  in.array(read.values);
  if (!in.ok() || read.channels < 0 || read.channels > 256) return false;
  common = std::move(read);
  return true;
}

}  // namespace sward::lpt
