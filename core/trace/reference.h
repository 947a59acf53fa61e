#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/image.h"
#include "scene/camera.h"
#include "scene/sun_sky.h"
#include "trace/ground_plan.h"
#include "trace/patch_scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// What the reference renders. What is pointed to must outlive it.
struct ReferenceScene {
  const PatchScene* patch = nullptr;
  const GroundPlan* plan = nullptr;
  std::vector<glm::vec3> soil;  ///< linear reflectance of the soil at each patch texel, [y][x] over plan->patchTexels^2
  scene::Daylight daylight;
  double hazeKm = 0.0;  ///< distance at which aerial perspective hides 63 %, as the renderer has it; 0: none
  /// Radiance of the sky in all directions instead of the daylight's: for a furnace and other closed forms.
  std::optional<glm::dvec3> uniformSky{};
  /// The same of the sky as a light alone; what is seen of it stays the daylight's.
  std::optional<glm::dvec3> evenSkyLight{};
};

/// Where shadow rays and bounces go.
enum class ShadowGround : std::uint8_t {
  Tiled,  ///< through the ground as it is tiled: the truth
  Patch   ///< through the periodic patch round the place that a hit was cut from: what a bake samples
};

/// How samples of a pixel are weighted, by importance: all of equal weight.
enum class PixelFilter : std::uint8_t {
  Tent,  ///< two pixels wide, as the renderer's pictures have it
  Box    ///< the pixel's own square
};

struct ReferenceOptions {
  int width = 640, height = 360;
  int bounces = 0;  ///< of light between leaves and soil; 0: sun and sky alone
  ShadowGround shadows = ShadowGround::Tiled;
  bool sky = true;               ///< light of the sky on the ground; the sky behind it is drawn in any case
  double sunRadiusDeg = 0.2666;  ///< of the sun's disc as a source; 0: a point, as bakes have it
  double gridBendM = 0.0;  ///< render::RenderOptions::gridBendM: a ray takes the shift of where it enters the shell
  double exposure = 1.0;   ///< multiplies radiance
  PixelFilter filter = PixelFilter::Tent;
  std::uint64_t seed = 1;
};

/// A path tracer of the real geometry of a ground: progressive, deterministic (same bytes on any number of threads),
/// cancellable between samples. Leaves are two-sided diffuse reflectors and transmitters; alpha is a chance. Samples
/// are four interleaved sequences, each a padded, Owen-scrambled (0, 2)-sequence of its own (sample_sequence.h): fully
/// stratified at 4 times a power of two.
class Reference {
 public:
  /// Errors: a plan that does not fit the patch, the soil or itself, sizes below 1, values that are not finite.
  static Result<std::unique_ptr<Reference>> create(ReferenceScene scene, const scene::Camera& camera,
                                                   const ReferenceOptions& options);
  virtual ~Reference() = default;

  /// Adds `count` samples to every pixel. Cancelled: Error::cancelled(), and the picture is as before the call.
  virtual Result<void> addSamples(int count, const JobContext& job) = 0;
  virtual int samples() const = 0;
  /// Linear radiance times exposure, RGB; means over the samples so far.
  virtual image::Image mean() const = 0;
  /// Estimated variance of each value of mean(), from the spread of the means of the four sequences: stratification
  /// counts, which the spread of single samples would not see. Three degrees of freedom a pixel: a picture's mean is
  /// good, a pixel's own is rough. Unbiased at multiples of four samples; zero below two.
  virtual image::Image variance() const = 0;
  /// Traced so far: of cameras, shadows and bounces; and the pieces of the patch that they were cut to.
  virtual std::uint64_t rays() const = 0;
  virtual std::uint64_t segments() const = 0;
};

}  // namespace sward::trace
