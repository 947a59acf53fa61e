#pragma once

#include "base/job.h"
#include "base/result.h"
#include "report/light_samples.h"
#include "trace/options.h"
#include "trace/patch_scene.h"

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::report {

/// Whether a column is one of those that have a truth: every second block of kTruthBlock^2, like a chessboard's black
/// fields. Half the columns say as much of a method as all of them, and take half the rays.
bool hasTruth(int column, const trace::LayerShape& shape);
inline constexpr int kTruthBlock = 8;

/// Slices of a patch and what they answer to lights, of all columns or of those that have a truth. Errors: those of
/// trace::sampleHits; Error::cancelled().
enum class Columns { All, WithTruth };
Result<SampledLight> sampleLayers(const trace::PatchScene& scene, const trace::SamplingOptions& options,
                                  Columns columns, std::span<const glm::dvec3> lights, const JobContext& job);

/// What some layer texels answer to lights, by rays that no fit has seen.
struct HeldOutTruth {
  std::vector<trace::LayerLuminance> response;  ///< [light]: of `texels`, in their order; 0 where no ray met anything
  std::vector<float> coverage;                  ///< of `texels`, 0 to 1; 0 in columns without a truth
  double noiseVariance = 0.0;                   ///< of a response, weighted by coverage
};
/// Samples twice, each time with half of kTruthFactor times as many rays as options.sliceSubSamples and a seed of its
/// own. Both together are the truth; what they differ by is its noise: of n and m hits with means a and b the mean of
/// all has the variance (a - b)^2 n m / (n + m)^2, if hits are independent. They are stratified, so it is a little too
/// high. `texels`: hits of the same shape. Errors as sampleLayers().
Result<HeldOutTruth> sampleTruth(const trace::PatchScene& scene, trace::SamplingOptions options,
                                 const trace::LayerHits& texels, std::span<const glm::dvec3> lights,
                                 const JobContext& job);

}  // namespace sward::report
