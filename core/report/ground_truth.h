#pragma once

#include "bake/ground_bake.h"
#include "base/job.h"
#include "base/result.h"
#include "image/image.h"
#include "project/project.h"
#include "render/renderer.h"
#include "scene/patch.h"
#include "scene/sun_sky.h"
#include "trace/ground_plan.h"
#include "trace/patch_scene.h"
#include "trace/reference.h"

#include <memory>
#include <optional>
#include <vector>

namespace sward::report {

/// What is left out of the truth, to see what leaving it out costs.
struct TruthVariant {
  bool patchShadows = false;  ///< shadows through the periodic patch, as bakes sample them
  bool evenSky = false;       ///< the sky's mean radiance from everywhere, as renderers light with it
  bool pointSun = false;      ///< no disc
  int bounces = 0;            ///< light between leaves, which no bake has
};

/// A picture and what its noise adds to an RMSE.
struct TruthPicture {
  image::Image linear;
  double noiseRmse = 0.0;
};

/// The traced geometry of a project's ground, laid as a bake laid its tiles.
class GroundTruth {
 public:
  static Result<GroundTruth> create(const project::Project& project, const bake::GroundBake& ground,
                                    const scene::Daylight& light, const JobContext& job);
  /// The same of other plants than bake::growPatch gives: a patch of the bake's side.
  static Result<GroundTruth> create(const project::Project& project, const bake::GroundBake& ground, scene::Patch patch,
                                    const scene::Daylight& light, const JobContext& job);

  /// The picture of a frame (camera, size, exposure, bend; samples are `samples`, filtered with the renderer's tent).
  Result<TruthPicture> picture(const render::Frame& frame, const TruthVariant& variant, int samples, std::uint64_t seed,
                               const JobContext& job) const;
  /// Lights what follows otherwise.
  void setDaylight(const scene::Daylight& light) { m_daylight = light; }
  /// Whether another bake laid its tiles the same way.
  bool laysSame(const bake::GroundBake& ground) const;
  std::uint64_t rays() const { return m_rays; }
  double seconds() const { return m_seconds; }

 private:
  GroundTruth(const scene::Daylight& light, double hazeKm) : m_daylight(light), m_hazeKm(hazeKm) {}

  std::unique_ptr<trace::PatchScene> m_patch;
  trace::GroundPlan m_plan;
  std::vector<glm::vec3> m_soil;
  scene::Daylight m_daylight;
  double m_hazeKm;
  mutable std::uint64_t m_rays = 0;
  mutable double m_seconds = 0.0;  ///< of tracing
};

/// RMSE of the mean difference of two pairs whose noise is independent of each other, from the product of both
/// differences: what noise there is has the mean 0 in it. All four pictures of one size; 0 where chance makes the mean
/// product negative.
struct PicturePair {
  const image::Image& reference;
  const image::Image& test;
};
double rmseWithoutNoise(const PicturePair& one, const PicturePair& other);
/// Mean of test - reference over both.
double biasOf(const PicturePair& one, const PicturePair& other);

}  // namespace sward::report
