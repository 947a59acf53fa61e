#include "trace/reference.h"

#include "base/check.h"
#include "base/parallel.h"
#include "trace/path_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

namespace sward::trace {
namespace {

constexpr int kTilePixels = 16;  ///< along the side of what a worker traces at a time
constexpr int kMaxSide = 32768;  ///< as the largest image
constexpr int kSequences = PathTracer::kSequences;

/// Of one pixel, by sequence: sums over samples. Doubles added in the order of the samples, so that how they are dealt
/// to calls and threads changes nothing.
using PixelSums = std::array<glm::dvec3, kSequences>;

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A rectangle of pixels.
struct PixelTile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

class TracedReference final : public Reference {
 public:
  explicit TracedReference(PathScene scene) : m_scene(std::move(scene)) {
    m_sums.assign(static_cast<std::size_t>(m_scene.options.width) * static_cast<std::size_t>(m_scene.options.height),
                  PixelSums{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)});
  }

  Result<void> addSamples(int count, const JobContext& job) override;
  int samples() const override { return m_samples; }
  image::Image mean() const override;
  image::Image variance() const override;
  std::uint64_t rays() const override { return m_rays; }
  std::uint64_t segments() const override { return m_segments; }

 private:
  std::vector<PixelTile> tiles() const;
  void addTile(const PixelTile& tile, int count, PathTracer& tracer, std::vector<PixelSums>& sums,
               const JobContext& job) const;
  /// Samples of a sequence among the first `samples`.
  static int countOf(int sequence, int samples) { return (samples + kSequences - 1 - sequence) / kSequences; }
  image::Image blank() const { return image::Image(m_scene.options.width, m_scene.options.height, 3); }

  PathScene m_scene;
  std::vector<PixelSums> m_sums;
  int m_samples = 0;
  std::uint64_t m_rays = 0, m_segments = 0;
};

std::vector<PixelTile> TracedReference::tiles() const {
  std::vector<PixelTile> out;
  const int width = m_scene.options.width, height = m_scene.options.height;
  for (int y = 0; y < height; y += kTilePixels) {
    for (int x = 0; x < width; x += kTilePixels) {
      out.push_back({x, y, std::min(x + kTilePixels, width), std::min(y + kTilePixels, height)});
    }
  }
  return out;
}

void TracedReference::addTile(const PixelTile& tile, int count, PathTracer& tracer, std::vector<PixelSums>& sums,
                              const JobContext& job) const {
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (int x = tile.x0; x < tile.x1 && !job.cancelled(); ++x) {
      PixelSums& pixel = sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(m_scene.options.width) +
                              static_cast<std::size_t>(x)];
      for (int sample = m_samples; sample < m_samples + count; ++sample) {
        pixel[static_cast<std::size_t>(sample % kSequences)] += tracer.trace(x, y, sample);
      }
    }
  }
}

Result<void> TracedReference::addSamples(int count, const JobContext& job) {
  SWARD_CHECK_GE(count, 0);
  const std::vector<PixelTile> all = tiles();
  std::vector<PixelSums> sums = m_sums;
  std::atomic<std::uint64_t> rays{0}, nearest{0}, occlusion{0};
  base::ProgressCounter progress(job, "reference", all.size());
  base::parallelFor(job, all.size(), 1, [&](std::size_t begin, std::size_t end) {
    PathTracer tracer(m_scene);
    for (std::size_t tile = begin; tile < end; ++tile) {
      addTile(all[tile], count, tracer, sums, job);
      progress.add();
    }
    rays += tracer.rays().rays();
    nearest += tracer.rays().nearestSegments();
    occlusion += tracer.rays().occlusionSegments();
  });
  if (job.cancelled()) return Error::cancelled();
  m_sums = std::move(sums);
  m_samples += count;
  m_rays += rays;
  m_segments += nearest + occlusion;
  const PatchScene::Impl& patch = m_scene.scene.patch->impl();
  patch.nearestCount += nearest;
  patch.occlusionCount += occlusion;
  return {};
}

image::Image TracedReference::mean() const {
  image::Image out = blank();
  const double scale = m_samples > 0 ? 1.0 / m_samples : 0.0;
  for (std::size_t pixel = 0; pixel < m_sums.size(); ++pixel) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& part : m_sums[pixel]) sum += part;
    for (int c = 0; c < 3; ++c)
      out.pixels[pixel * 3 + static_cast<std::size_t>(c)] = static_cast<float>(sum[c] * scale);
  }
  return out;
}

// With K sequences of n_k of n samples and means m_k, the mean is sum (n_k / n) m_k and its variance
// [ sum (n_k / n)^2 (m_k - mean)^2 K / (K - 1) ], without bias where all n_k are equal.
image::Image TracedReference::variance() const {
  image::Image out = blank();
  const int used = std::min(m_samples, kSequences);
  if (used < 2) return out;
  for (std::size_t pixel = 0; pixel < m_sums.size(); ++pixel) {
    glm::dvec3 mean(0.0), sum(0.0);
    for (const glm::dvec3& part : m_sums[pixel]) mean += part / static_cast<double>(m_samples);
    for (int k = 0; k < used; ++k) {
      const double share = static_cast<double>(countOf(k, m_samples)) / m_samples;
      const glm::dvec3 deviation = m_sums[pixel][static_cast<std::size_t>(k)] / static_cast<double>(m_samples) -
                                   share * mean;  // (n_k / n) (m_k - mean)
      sum += deviation * deviation;
    }
    sum *= static_cast<double>(used) / (used - 1);
    for (int c = 0; c < 3; ++c) out.pixels[pixel * 3 + static_cast<std::size_t>(c)] = static_cast<float>(sum[c]);
  }
  return out;
}

Error badReference(const std::string& what, const std::string& remedy) {
  return Error::badInput(what, "reference", remedy);
}

Result<void> checkScene(const ReferenceScene& scene, const scene::Camera& camera, const ReferenceOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kMaxSide || options.height > kMaxSide) {
    return badReference("a picture of " + std::to_string(options.width) + " x " + std::to_string(options.height),
                        "Use 1 to " + std::to_string(kMaxSide) + " pixels a side.");
  }
  const bool numbers = std::isfinite(options.exposure) && std::isfinite(options.gridBendM) &&
                       std::isfinite(scene.hazeKm) && options.sunRadiusDeg >= 0.0 && options.sunRadiusDeg < 90.0 &&
                       options.bounces >= 0;
  if (!numbers || !finite(camera.position) || !finite(camera.forward) || !std::isfinite(camera.tanHalfWidth)) {
    return badReference("a setting is out of range", "Give finite numbers, a sun below 90 degrees, bounces from 0.");
  }
  const GroundPlan& plan = *scene.plan;
  const std::size_t columns = static_cast<std::size_t>(plan.patchTexels) * static_cast<std::size_t>(plan.patchTexels);
  if (scene.soil.size() != columns) {
    return badReference("there are " + std::to_string(scene.soil.size()) + " soil colours for " +
                            std::to_string(columns) + " patch texels",
                        "Ask for the soil at the patch's own resolution.");
  }
  if (!(std::abs(plan.patchSideM - scene.patch->patch().sideM) <= 1e-9 * plan.patchSideM)) {
    return badReference("the ground plan's patch is not as wide as the traced one", "Make both of one project.");
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Reference>> Reference::create(ReferenceScene scene, const scene::Camera& camera,
                                                     const ReferenceOptions& options) {
  SWARD_CHECK(scene.patch != nullptr && scene.plan != nullptr);
  SWARD_ASSIGN(TiledGround ground, TiledGround::create(*scene.plan, scene.patch->patch()));
  SWARD_TRY(checkScene(scene, camera, options));
  SkyLight sky(scene.daylight, scene.evenSkyLight ? scene.evenSkyLight : scene.uniformSky);
  SunLight sun(scene.daylight, options.sunRadiusDeg);
  HorizonSky horizon(scene.daylight, scene.uniformSky);
  return std::unique_ptr<Reference>(std::make_unique<TracedReference>(
      PathScene{std::move(scene), options, camera, std::move(ground), std::move(sky), sun, std::move(horizon)}));
}

}  // namespace sward::trace
