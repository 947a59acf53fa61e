#include "trace/model_light.h"

#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace sward::trace {
namespace {

constexpr std::size_t kGrain = 256;
/// Of the model's extent: hides the rounding of places and of neighbouring triangles' edges.
constexpr double kOffset = 1e-4;

float offsetOf(const mesh::Model& model) {
  const mesh::Bounds box = mesh::bounds(model);
  return static_cast<float>(kOffset * static_cast<double>(glm::length(box.high - box.low)));
}

}  // namespace

Result<std::vector<float>> sunOnVertices(const ModelScene& scene, const glm::dvec3& toSun, const JobContext& job) {
  const mesh::Model& model = scene.model();
  std::vector<float> seen(model.positions.size(), 0.0f);
  if (!(toSun.z > 0.0)) return seen;
  const glm::vec3 direction(toSun);
  const float offset = offsetOf(model);
  const int rays = mesh::hasAlpha(model) ? kAlphaRays : 1;
  base::parallelFor(job, seen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      int free = 0;
      for (int i = 0; i < rays; ++i) {
        const float chance = base::unitFloat(base::mix64(v, static_cast<std::uint64_t>(i)));
        free += scene.occluded(model.positions[v], direction, offset, chance) ? 0 : 1;
      }
      seen[v] = static_cast<float>(free) / static_cast<float>(rays);
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return seen;
}

Result<VertexSky> skyOnVertices(const ModelScene& scene, int directions, const JobContext& job) {
  constexpr double kGolden = 2.399963229728653;  // radians, pi (3 - sqrt 5)
  const mesh::Model& model = scene.model();
  const int count = std::clamp(directions, 1, 1024);
  VertexSky sky{std::vector<float>(model.positions.size(), 0.0f), std::vector<float>(model.positions.size(), 0.0f)};
  const float offset = offsetOf(model);
  // (1 / pi) integral of cosine dw over 2 pi: each of n directions of equal solid angle stands for 2 cosine / n.
  const double each = 2.0 / count;
  base::parallelFor(job, model.positions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const std::uint64_t bits = base::mix64(v, 0x736b79);
      const double turn = 2.0 * std::numbers::pi * base::unitDouble(bits), lift = base::unitDouble(base::mix64(bits));
      const glm::dvec3 normal(model.normals[v]);
      double front = 0.0, back = 0.0;
      for (int i = 0; i < count; ++i) {
        const double z = (i + lift) / count, across = std::sqrt(1.0 - z * z), azimuth = turn + kGolden * i;
        const glm::dvec3 l(across * std::cos(azimuth), across * std::sin(azimuth), z);
        const float chance = base::unitFloat(base::mix64(bits, static_cast<std::uint64_t>(i)));
        if (scene.occluded(model.positions[v], glm::vec3(l), offset, chance)) continue;
        const double cosine = glm::dot(normal, l);
        (cosine > 0.0 ? front : back) += std::abs(cosine) * each;
      }
      sky.front[v] = static_cast<float>(front);
      sky.back[v] = static_cast<float>(back);
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return sky;
}

}  // namespace sward::trace
