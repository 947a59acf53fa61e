#include "trace/layers.h"

#include "base/check.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace sward::trace {
namespace {

constexpr float kNormalScale = 32767.0f;

float signOf(float x) {
  return x < 0.0f ? -1.0f : 1.0f;
}

std::int16_t toSnorm(float x) {
  return static_cast<std::int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * kNormalScale));
}

}  // namespace

const char* layerSetName(LayerSet set) {
  switch (set) {
    case LayerSet::Slices:
      return "slices";
    case LayerSet::BladesPosX:
      return "blades +x";
    case LayerSet::BladesNegX:
      return "blades -x";
    case LayerSet::BladesPosY:
      return "blades +y";
    case LayerSet::BladesNegY:
      return "blades -y";
    case LayerSet::Ground:
      return "ground";
  }
  return "unknown";
}

LayerShape layerShape(LayerSet set, const SamplingOptions& options) {
  switch (set) {
    case LayerSet::Slices:
      return {options.sliceResolution, options.sliceResolution, options.slices};
    case LayerSet::Ground:
      return {options.sliceResolution, options.sliceResolution, 1};
    default:
      return {options.bladeWidth, options.bladeHeight, options.blades};
  }
}

// Octahedral unit vectors: the sphere projected on |x| + |y| + |z| = 1, the lower half folded over the upper's corners
// (Meyer, Suessmuth, Sussner, Stamminger 2010).
std::array<std::int16_t, 2> encodeNormal(const glm::vec3& normal) {
  const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  if (!(sum > 0.0f) || !std::isfinite(sum)) return encodeNormal({0.0f, 0.0f, 1.0f});
  const float x = normal.x / sum, y = normal.y / sum;
  if (normal.z >= 0.0f) return {toSnorm(x), toSnorm(y)};
  return {toSnorm((1.0f - std::abs(y)) * signOf(x)), toSnorm((1.0f - std::abs(x)) * signOf(y))};
}

glm::vec3 decodeNormal(const std::array<std::int16_t, 2>& octahedral) {
  glm::vec3 n(octahedral[0] / kNormalScale, octahedral[1] / kNormalScale, 0.0f);
  n.z = 1.0f - std::abs(n.x) - std::abs(n.y);
  const float fold = std::max(-n.z, 0.0f);
  n.x -= fold * signOf(n.x);
  n.y -= fold * signOf(n.y);
  return glm::normalize(n);
}

Result<LayerSurface> shadeSurface(const LayerHits& hits, const scene::Patch& patch, std::span<const glm::vec3> soil,
                                  const JobContext& job) {
  LayerSurface surface;
  surface.reflectance.resize(hits.texels());
  surface.transmittance.resize(hits.texels());
  if (hits.set == LayerSet::Ground) {
    SWARD_CHECK_EQ(soil.size(), hits.texels());
    std::copy(soil.begin(), soil.end(), surface.reflectance.begin());
    return surface;
  }
  base::parallelFor(job, hits.texels(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      glm::vec3 reflectance(0.0f), transmittance(0.0f);
      for (std::uint32_t h = hits.hitStart[texel]; h < hits.hitStart[texel + 1]; ++h) {
        const Hit& hit = hits.hits[h];
        SWARD_CHECK_LT(hit.instance, patch.instances.size());
        const mesh::Model& model = *patch.models[patch.instances[hit.instance].model];
        SWARD_CHECK_LT(hit.triangle, model.triangles.size());
        const mesh::SurfaceSample sample = mesh::surfaceAt(model, hit.triangle, hit.barycentric[0] * (1.0f / 65535.0f),
                                                           hit.barycentric[1] * (1.0f / 65535.0f));
        reflectance += sample.reflectance;
        transmittance += sample.transmittance;
      }
      const float scale = 1.0f / static_cast<float>(hits.hitStart[texel + 1] - hits.hitStart[texel]);
      surface.reflectance[texel] = reflectance * scale;
      surface.transmittance[texel] = transmittance * scale;
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return surface;
}

}  // namespace sward::trace
