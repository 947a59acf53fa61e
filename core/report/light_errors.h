#pragma once

#include "base/job.h"
#include "base/result.h"
#include "lpt/representation.h"
#include "report/light_samples.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::report {

/// Weighted sums of differences, predicted less true.
struct ErrorSum {
  std::uint64_t count = 0;
  double weights = 0.0, squares = 0.0, errors = 0.0, max = 0.0;

  void add(double weight, double difference);  ///< a weight of 0 counts as nothing, whatever the difference
  void add(const ErrorSum& other);
  double mse() const { return weights > 0.0 ? squares / weights : 0.0; }
  double rmse() const;
  double bias() const { return weights > 0.0 ? errors / weights : 0.0; }
  double psnrDb() const;  ///< of a peak of 1
};
ErrorSum total(std::span<const ErrorSum> sums);

/// What weighs a texel: its coverage by the truth's rays alone, or what a fit weighs it by: coverage times the
/// visibility, at least half a view direction.
enum class TexelWeight { Covered, Seen };
double texelWeight(const LightSamples& samples, std::size_t texel, TexelWeight weight);

/// Responses of all texels to a light, both channels, clamped at 0 as everything that draws clamps them.
struct Predicted {
  std::vector<float> reflected, transmitted;
};
Result<Predicted> predict(const lpt::Representation& representation, const LightSamples& samples,
                          const glm::dvec3& light, const JobContext& job);

/// Over the texels and both channels.
ErrorSum errorOf(const Predicted& predicted, const trace::LayerLuminance& truth, const LightSamples& samples,
                 TexelWeight weight);

/// One for each held-out light.
struct HeldOutErrors {
  std::vector<ErrorSum> covered, seen;
};
Result<HeldOutErrors> heldOutErrors(const lpt::Representation& representation, const LightSamples& samples,
                                    const JobContext& job);
/// Of the held-out lights of an elevation.
ErrorSum ofElevation(const LightSamples& samples, std::span<const ErrorSum> heldOut, Elevation elevation);

/// Half-way between texels, against samples of the patch moved by half a texel; one sum for each of the lights
/// LightSamples::betweenLights.
struct BetweenErrors {
  std::vector<ErrorSum> drawn;   ///< mean of the four texels around by their coverage, as layers are drawn
  std::vector<ErrorSum> filled;  ///< plain mean of the four, values of uncovered texels included, as a texture filters
};
Result<BetweenErrors> betweenErrors(const lpt::Representation& representation, const LightSamples& samples,
                                    const JobContext& job);
/// The same of the samples themselves, as they would be drawn without any representation: what interpolation costs.
ErrorSum betweenSamples(const LightSamples& samples);

}  // namespace sward::report
