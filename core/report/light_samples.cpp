#include "report/light_samples.h"

#include "bake/plants.h"
#include "report/light_truth.h"
#include "scene/lights.h"
#include "trace/patch_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace sward::report {
namespace {

constexpr int kHeldOut = 32;
/// By which the lattice of held-out lights is turned: its heights are not those of a lattice of 15 anyway, and no
/// azimuth of the two then agrees by construction.
constexpr double kTurn = 1.0;
/// Held-out lights under which noise and the places between texels are measured.
constexpr std::size_t kBetweenLights = 4;

std::vector<glm::dvec3> heldOutLights() {
  std::vector<glm::dvec3> lights = scene::fibonacciHemisphere(kHeldOut);
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  for (glm::dvec3& l : lights) l = {c * l.x - s * l.y, s * l.x + c * l.y, l.z};
  return lights;
}

double leastAngleDeg(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double least = 180.0;
  for (const glm::dvec3& u : a) {
    for (const glm::dvec3& v : b) {
      const double angle = std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
      least = std::min(least, angle * 180.0 / std::numbers::pi);
    }
  }
  return least;
}

/// The patch with every plant moved so that the corner between four texels comes to the middle of one.
std::shared_ptr<const scene::Patch> movedPatch(const scene::Patch& patch, double byM) {
  auto moved = std::make_shared<scene::Patch>(patch);
  for (scene::Instance& instance : moved->instances) {
    for (int axis = 0; axis < 2; ++axis) {
      float& foot = instance.worldFromModel[3][axis];
      foot = static_cast<float>(static_cast<double>(foot) - byM);
      if (foot < 0.0f) foot = static_cast<float>(static_cast<double>(foot) + patch.sideM);
    }
  }
  return moved;
}

trace::SamplingOptions samplingOf(const SectionInput& input) {
  trace::SamplingOptions options = input.project.sampling;
  options.sliceResolution = input.quick ? 64 : 128;
  options.sliceSubSamples = input.quick ? 4 : 16;
  return options;
}

std::vector<glm::dvec3> lightsBetween(const LightSamples& samples) {
  std::vector<glm::dvec3> lights;
  for (const std::size_t k : samples.betweenLights) lights.push_back(samples.heldOut[k]);
  return lights;
}

Result<void> measureBetween(LightSamples& samples, trace::SamplingOptions options, const JobContext& job) {
  options.sliceSubSamples *= kTruthFactor;
  const double halfTexel = 0.5 * samples.patch->sideM / options.sliceResolution;
  SWARD_ASSIGN(const auto scene, trace::PatchScene::create(movedPatch(*samples.patch, halfTexel), job));
  SWARD_ASSIGN(samples.between, sampleLayers(*scene, options, Columns::WithTruth, lightsBetween(samples), job));
  return {};
}

}  // namespace

Elevation elevationOf(const glm::dvec3& light) {
  const double deg = scene::anglesFromDirection(light).elevationDeg;
  return deg < kLowBelowDeg ? Elevation::Low : deg > kHighAboveDeg ? Elevation::High : Elevation::Middle;
}

lpt::RepresentationInput LightSamples::input(std::optional<std::size_t> without) const {
  lpt::RepresentationInput in;
  in.hits = &train.hits;
  in.density = density;
  in.fit.columns = shape().columns();
  in.fit.layers = shape().layers;
  in.fit.columnStart = train.hits.columnStart;
  in.fit.layer = train.hits.layer;
  in.fit.coverage = train.coverage;
  in.fit.visibility = visibility;
  in.fit.sky = {sky[0], sky[1]};
  in.fit.visibilityDirections = visibilityDirections;
  in.fit.lights = without ? std::span<const glm::dvec3>(lightsWithout[*without]) : training;
  in.fit.channels = 2;
  for (const bool transmitted : {false, true}) {
    for (std::size_t k = 0; k < training.size(); ++k) {
      if (k == without) continue;
      in.fit.samples.emplace_back(transmitted ? train.response[k].transmitted : train.response[k].reflected);
    }
  }
  return in;
}

Result<std::shared_ptr<const LightSamples>> sampleLights(const SectionInput& input, const JobContext& job) {
  const trace::SamplingOptions options = samplingOf(input);
  auto samples = std::make_shared<LightSamples>();
  SWARD_ASSIGN(samples->training, scene::lightDirections(input.project.lights));
  samples->heldOut = heldOutLights();
  for (std::size_t i = 0; i < kBetweenLights; ++i) {
    samples->betweenLights.push_back((2 * i + 1) * samples->heldOut.size() / (2 * kBetweenLights));
  }
  samples->nearestDeg = leastAngleDeg(samples->training, samples->heldOut);
  samples->subSamples = options.sliceSubSamples;
  samples->visibilityDirections = options.visibilityDirections;
  for (std::size_t k = 0; k < samples->training.size(); ++k) {
    samples->lightsWithout.push_back(samples->training);
    samples->lightsWithout.back().erase(samples->lightsWithout.back().begin() + static_cast<std::ptrdiff_t>(k));
  }
  SWARD_ASSIGN(scene::Patch patch, bake::growPatch(input.project));
  samples->patch = std::make_shared<const scene::Patch>(std::move(patch));
  JobContext quiet = job;
  quiet.onProgress = nullptr;
  SWARD_ASSIGN(const auto scene, trace::PatchScene::create(samples->patch, quiet));
  const auto start = std::chrono::steady_clock::now();
  SWARD_ASSIGN(samples->train, sampleLayers(*scene, options, Columns::All, samples->training, quiet));
  SWARD_ASSIGN(trace::LayerVisibility seen, trace::sampleVisibility(*scene, samples->train.hits, options, quiet));
  samples->visibility = std::move(seen.visibility);
  samples->sky = {std::move(seen.skyReflected), std::move(seen.skyTransmitted)};
  samples->sampleSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (samples->texels() == 0) {
    return Error::badInput("the patch has nothing to sample", "report sections of light",
                           "Give the patch some plants.");
  }
  const auto truthStart = std::chrono::steady_clock::now();
  SWARD_ASSIGN(HeldOutTruth truth, sampleTruth(*scene, options, samples->train.hits, samples->heldOut, quiet));
  samples->truth = std::move(truth.response);
  samples->truthCoverage = std::move(truth.coverage);
  samples->noiseVariance = truth.noiseVariance;
  samples->truthSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - truthStart).count();
  SWARD_ASSIGN(samples->density, trace::VoxelDensity::create(samples->patch, trace::VoxelOptions::of(options), quiet));
  SWARD_TRY(measureBetween(*samples, options, quiet));
  return std::shared_ptr<const LightSamples>(std::move(samples));
}

Result<std::shared_ptr<const LightSamples>> LightSampleSource::get(const SectionInput& input, const JobContext& job) {
  const std::scoped_lock lock(m_mutex);
  if (m_samples && m_quick == input.quick && m_project == input.project) return m_samples;
  m_samples.reset();
  SWARD_ASSIGN(m_samples, sampleLights(input, job));
  m_quick = input.quick;
  m_project = input.project;
  return m_samples;
}

}  // namespace sward::report
