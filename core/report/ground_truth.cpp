#include "report/ground_truth.h"

#include "bake/ground_plan.h"
#include "bake/plants.h"
#include "bake/soil.h"
#include "base/check.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace sward::report {

Result<GroundTruth> GroundTruth::create(const project::Project& project, const bake::GroundBake& ground,
                                        const scene::Daylight& light, const JobContext& job) {
  SWARD_ASSIGN(scene::Patch grown, bake::growPatch(project));
  return create(project, ground, std::move(grown), light, job);
}

Result<GroundTruth> GroundTruth::create(const project::Project& project, const bake::GroundBake& ground,
                                        scene::Patch patch, const scene::Daylight& light, const JobContext& job) {
  GroundTruth truth(light, project.sky.hazeKm);
  truth.m_plan = bake::groundPlan(ground);
  SWARD_ASSIGN(truth.m_patch, trace::PatchScene::create(std::make_shared<const scene::Patch>(std::move(patch)),
                                                        {job.stop, {}, job.threads}));
  SWARD_ASSIGN(truth.m_soil, bake::soilColours(project, truth.m_plan.patchTexels));
  return truth;
}

Result<TruthPicture> GroundTruth::picture(const render::Frame& frame, const TruthVariant& variant, int samples,
                                          std::uint64_t seed, const JobContext& job) const {
  const auto start = std::chrono::steady_clock::now();
  trace::ReferenceScene scene{m_patch.get(), &m_plan, m_soil, m_daylight, m_hazeKm, {}};
  // Haze and the sky behind stay as they are: the light alone is what is varied.
  if (variant.evenSky) scene.evenSkyLight = m_daylight.meanSkyRadiance();
  trace::ReferenceOptions options;
  options.width = frame.width;
  options.height = frame.height;
  options.exposure = frame.exposure;
  options.gridBendM = frame.options.gridBendM;
  options.bounces = variant.bounces;
  options.seed = seed;
  if (variant.patchShadows) options.shadows = trace::ShadowGround::Patch;
  if (variant.pointSun) options.sunRadiusDeg = 0.0;
  SWARD_ASSIGN(const auto reference, trace::Reference::create(std::move(scene), frame.camera, options));
  SWARD_TRY(reference->addSamples(samples, job));
  m_rays += reference->rays();
  m_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  TruthPicture out{reference->mean(), 0.0};
  double sum = 0.0;
  const image::Image variance = reference->variance();
  for (const float value : variance.pixels) sum += static_cast<double>(value);
  out.noiseRmse = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(variance.pixels.size(), 1)));
  return out;
}

bool GroundTruth::laysSame(const bake::GroundBake& ground) const {
  const trace::GroundPlan other = bake::groundPlan(ground);
  return other.patchTexels == m_plan.patchTexels && other.tileTexels == m_plan.tileTexels &&
         other.offsets == m_plan.offsets && other.owner == m_plan.owner && other.mapWidth == m_plan.mapWidth &&
         other.map == m_plan.map;
}

double rmseWithoutNoise(const PicturePair& one, const PicturePair& other) {
  const std::size_t count = one.test.pixels.size();
  SWARD_CHECK_EQ(one.reference.pixels.size(), count);
  SWARD_CHECK_EQ(other.test.pixels.size(), count);
  SWARD_CHECK_EQ(other.reference.pixels.size(), count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += static_cast<double>(one.test.pixels[i] - one.reference.pixels[i]) *
           static_cast<double>(other.test.pixels[i] - other.reference.pixels[i]);
  }
  return std::sqrt(std::max(sum / static_cast<double>(std::max<std::size_t>(count, 1)), 0.0));
}

double biasOf(const PicturePair& one, const PicturePair& other) {
  double sum = 0.0;
  for (const PicturePair* pair : {&one, &other}) {
    for (std::size_t i = 0; i < pair->test.pixels.size(); ++i) {
      sum += static_cast<double>(pair->test.pixels[i] - pair->reference.pixels[i]);
    }
  }
  return sum / (2.0 * static_cast<double>(std::max<std::size_t>(one.test.pixels.size(), 1)));
}

}  // namespace sward::report
