#pragma once

#include "base/job.h"
#include "base/result.h"
#include "lpt/representation.h"
#include "report/section.h"
#include "scene/patch.h"
#include "trace/layers.h"

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::report {

/// Held-out lights by the sun's elevation.
enum class Elevation { Low, Middle, High };
inline constexpr double kLowBelowDeg = 25.0, kHighAboveDeg = 50.0;
Elevation elevationOf(const glm::dvec3& light);

/// Layer samples that are a truth: the responses of each texel under some lights.
struct SampledLight {
  trace::LayerHits hits;
  std::vector<float> coverage;                  ///< alpha of each texel
  std::vector<trace::LayerLuminance> response;  ///< [light]
};

/// What the light sections are measured on: slices of the project's patch, sampled once.
struct LightSamples {
  std::shared_ptr<const scene::Patch> patch;
  int subSamples = 16;
  int visibilityDirections = 16;
  std::vector<glm::dvec3> training;  ///< the project's lights
  /// A Fibonacci lattice of 32, turned by a fixed angle: no light of it is a training light.
  std::vector<glm::dvec3> heldOut;
  double nearestDeg = 0.0;  ///< least angle between a held-out and a training light

  SampledLight train;  ///< of the training lights
  std::vector<float> visibility;
  std::array<std::vector<float>, 2> sky;  ///< terms of train's texels, reflected and transmitted
  /// Train's texels under the held-out lights, by rays of their own, kTruthFactor times as many: a method that follows
  /// the very leaves that its own rays met would else be compared with those leaves, not with the texel.
  std::vector<trace::LayerLuminance> truth;
  std::vector<float> truthCoverage;  ///< of train's texels by the truth's rays; 0 without a truth (half the columns)
  /// Held-out lights, evenly chosen from high to low, under which places between texels are compared.
  std::vector<std::size_t> betweenLights;
  /// The patch moved by half a texel in x and y: its texel (x, y) lies between the four at x, x + 1, y, y + 1. One
  /// response for each of betweenLights, by as many rays as the truth.
  SampledLight between;
  double noiseVariance = 0.0;  ///< of a truth value, weighted by coverage: from the two halves of the truth's rays
  double truthSeconds = 0.0;
  double sampleSeconds = 0.0;  ///< of the training lights and the visibility

  std::shared_ptr<const trace::VoxelDensity> density;  ///< of the patch, for marched; none: marched is left out

  const trace::LayerShape& shape() const { return train.hits.shape; }
  std::size_t texels() const { return train.hits.texels(); }
  /// The training samples as a fit reads them, of all lights or all but one.
  lpt::RepresentationInput input(std::optional<std::size_t> without = std::nullopt) const;

  std::vector<std::vector<glm::dvec3>> lightsWithout;  ///< [training light]: all others
};

/// The truth's rays a layer texel, over those of the training samples.
inline constexpr int kTruthFactor = 4;

/// Samples a project's slices. Errors: no lights, a patch without plants, assets that cannot be read; cancelled.
Result<std::shared_ptr<const LightSamples>> sampleLights(const SectionInput& input, const JobContext& job);

/// Sections that share one sampling: made by the first that asks, kept for the others.
class LightSampleSource {
 public:
  Result<std::shared_ptr<const LightSamples>> get(const SectionInput& input, const JobContext& job);

 private:
  std::mutex m_mutex;
  bool m_quick = false;
  std::optional<project::Project> m_project;
  std::shared_ptr<const LightSamples> m_samples;
};

}  // namespace sward::report
