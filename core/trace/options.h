#pragma once

#include <cstdint>

namespace sward::trace {

/// How finely a patch is cut and sampled. Texels are squares of the patch in slices; blades have their own resolution.
struct SamplingOptions {
  int sliceResolution = 256;  ///< texels along each side of the patch
  int slices = 16;            ///< horizontal slabs
  int bladeWidth = 512;       ///< texels along the patch in a blade image
  int bladeHeight = 128;      ///< texels over the patch's height
  int blades = 8;             ///< vertical slabs along x and along y
  int sliceSubSamples = 4;    ///< rays a layer texel; stratified
  int bladeSubSamples = 2;
  int visibilityDirections = 16;  ///< view directions of the visibility, which the sky term shares
  std::uint64_t seed = 1;
  bool operator==(const SamplingOptions&) const = default;
};

}  // namespace sward::trace
