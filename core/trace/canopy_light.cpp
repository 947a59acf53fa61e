#include "trace/canopy_light.h"

#include "base/check.h"
#include "base/parallel.h"
#include "trace/fast_floor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::trace {
namespace {

/// Triangles are summed in this many shares, each in order, and the shares after one another: the same sums on any
/// number of threads.
constexpr std::size_t kShares = 8;
constexpr float kMostPathCells = 24.0f;  ///< samples of a path through one layer

/// For the mean over a texel's hits.
float meanScale(const LayerHits& hits, std::size_t texel) {
  return 1.0f / static_cast<float>(hits.hitStart[texel + 1] - hits.hitStart[texel]);
}

}  // namespace

CanopyLight::CanopyLight(const TriangleField& field, int cells, int layers, std::span<const glm::dvec3> directions,
                         const JobContext& job)
    : m_directions(directions.begin(), directions.end()),
      m_cells(cells),
      m_layers(layers),
      m_cellsPerMetre(static_cast<float>(cells / field.patch().sideM)),
      m_layerM(static_cast<float>(field.patch().heightM / layers)),
      m_heightM(static_cast<float>(field.patch().heightM)) {
  SWARD_CHECK_GT(cells, 0);
  SWARD_CHECK_GT(layers, 0);
  for (const glm::dvec3& direction : directions) SWARD_CHECK_GE(direction.z, kLowestZ);
  deposit(field, job);
  const std::size_t plane = static_cast<std::size_t>(m_cells) * static_cast<std::size_t>(m_cells);
  m_light.assign(m_directions.size() * static_cast<std::size_t>(m_layers + 1) * plane, 1.0f);
  base::parallelFor(job, m_directions.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t d = begin; d < end; ++d) spread(d);
  });
}

/// Periodic; values belong to the middles of cells, x and y count cells.
float CanopyLight::bilinear(const float* plane, float x, float y) const {
  const int ix = floorOf(x - 0.5f), iy = floorOf(y - 0.5f);
  const float tx = x - 0.5f - static_cast<float>(ix), ty = y - 0.5f - static_cast<float>(iy);
  const int x0 = wrapped(ix, m_cells), x1 = x0 + 1 == m_cells ? 0 : x0 + 1;
  const int y0 = wrapped(iy, m_cells), y1 = y0 + 1 == m_cells ? 0 : y0 + 1;
  const float *southern = plane + y0 * m_cells, *northern = plane + y1 * m_cells;
  const float low = southern[x0] * (1.0f - tx) + southern[x1] * tx;
  const float high = northern[x0] * (1.0f - tx) + northern[x1] * tx;
  return low * (1.0f - ty) + high * ty;
}

void CanopyLight::deposit(const TriangleField& field, const JobContext& job) {
  const std::size_t plane = static_cast<std::size_t>(m_cells) * static_cast<std::size_t>(m_cells);
  const std::size_t count = m_directions.size();
  const std::size_t voxels = plane * static_cast<std::size_t>(m_layers);
  const float cellM = 1.0f / m_cellsPerMetre;
  // Area across the light over the voxel's own across it, cellM^2 lz.
  std::vector<glm::vec3> scaled;
  for (const glm::dvec3& d : m_directions) scaled.push_back(glm::vec3(d) / (cellM * cellM * static_cast<float>(d.z)));
  std::vector<std::vector<float>> shares(kShares);
  const auto parts = field.parts();
  const auto addTriangle = [&](std::vector<float>& sums, std::vector<float>& shadow, const std::array<glm::vec3, 3>& p,
                               float alpha) {
    const glm::vec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const glm::vec3 area = (0.5f * alpha) * glm::cross(e1, e2);
    // A long triangle counts in all the voxels along it.
    const glm::vec3 along = glm::dot(e1, e1) > glm::dot(e2, e2) ? e1 : e2;
    const float least = std::min(cellM, m_layerM);
    const int points = std::clamp(static_cast<int>(std::sqrt(glm::dot(along, along)) / least) + 1, 1, 8);
    const glm::vec3 middle = (p[0] + p[1] + p[2]) * (1.0f / 3.0f);
    const float share = 1.0f / static_cast<float>(points);
    for (std::size_t d = 0; d < count; ++d) shadow[d] = share * std::abs(glm::dot(area, scaled[d]));
    for (int i = 0; i < points; ++i) {
      const float offset = (static_cast<float>(i) + 0.5f) * share - 0.5f;
      const glm::vec3 at = middle + 0.6f * offset * along;
      const int layer = std::clamp(static_cast<int>((m_heightM - at.z) / m_layerM), 0, m_layers - 1);
      const int x = wrapped(floorOf(at.x * m_cellsPerMetre), m_cells);
      const int y = wrapped(floorOf(at.y * m_cellsPerMetre), m_cells);
      const std::size_t voxel = static_cast<std::size_t>(layer) * plane + static_cast<std::size_t>(y * m_cells + x);
      float* out = &sums[voxel * count];
      for (std::size_t d = 0; d < count; ++d) out[d] += shadow[d];
    }
  };
  const std::size_t grain = (parts.size() + kShares - 1) / kShares;
  base::parallelFor(job, parts.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::vector<float>& sums = shares[begin / std::max<std::size_t>(grain, 1)];
    sums.assign(voxels * count, 0.0f);
    std::vector<float> shadow(count);  // of one point of a triangle, toward each direction
    for (std::size_t i = begin; i < end && !job.cancelled(); ++i) {
      const TriangleField::Part& part = parts[i];
      const glm::vec3* vertices = field.positions().data() + part.firstVertex;
      for (std::uint32_t t = 0; t < part.model->triangles.size(); ++t) {
        const glm::uvec3 c = part.model->triangles[t];
        const float alpha = part.alpha ? mesh::alphaAt(*part.model, t, 1.0f / 3.0f, 1.0f / 3.0f) : 1.0f;
        addTriangle(sums, shadow, {vertices[c.x], vertices[c.y], vertices[c.z]}, alpha);
      }
    }
  });
  m_depth.assign(count * voxels, 0.0f);
  for (const std::vector<float>& sums : shares) {
    if (sums.empty()) continue;
    for (std::size_t voxel = 0; voxel < voxels; ++voxel) {
      for (std::size_t d = 0; d < count; ++d) m_depth[d * voxels + voxel] += sums[voxel * count + d];
    }
  }
}

void CanopyLight::spread(std::size_t direction) {
  const std::size_t plane = static_cast<std::size_t>(m_cells) * static_cast<std::size_t>(m_cells);
  const auto layers = static_cast<std::size_t>(m_layers);
  const glm::vec2 step = glm::vec2(m_directions[direction] / m_directions[direction].z) * (m_layerM * m_cellsPerMetre);
  const float longest = std::max(std::abs(step.x), std::abs(step.y));
  const int samples = static_cast<int>(std::clamp(std::ceil(longest), 1.0f, kMostPathCells));
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const float* above = &m_light[(direction * (layers + 1) + layer) * plane];
    const float* depth = &m_depth[(direction * layers + layer) * plane];
    float* below = &m_light[(direction * (layers + 1) + layer + 1) * plane];
    for (int y = 0; y < m_cells; ++y) {
      for (int x = 0; x < m_cells; ++x) {
        const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        float path = 0.0f;
        for (int s = 0; s < samples; ++s) {
          const glm::vec2 p = at + step * ((static_cast<float>(s) + 0.5f) / static_cast<float>(samples));
          path += bilinear(depth, p.x, p.y);
        }
        const glm::vec2 from = at + step;
        below[y * m_cells + x] = bilinear(above, from.x, from.y) * std::exp(-path / static_cast<float>(samples));
      }
    }
  }
}

float CanopyLight::at(std::size_t direction, const glm::vec3& position, LayerSet seenBy) const {
  const std::size_t plane = static_cast<std::size_t>(m_cells) * static_cast<std::size_t>(m_cells);
  const auto layers = static_cast<std::size_t>(m_layers);
  const float below = std::max((m_heightM - position.z) / m_layerM, 0.0f);
  const std::size_t layer = std::min(static_cast<std::size_t>(below), layers - 1);
  const float inLayer = std::min(below - static_cast<float>(layer), 1.0f);
  const glm::vec2 step = glm::vec2(m_directions[direction] / m_directions[direction].z) * (m_layerM * m_cellsPerMetre);
  const glm::vec2 p = glm::vec2(position) * m_cellsPerMetre;
  const glm::vec2 from = p + inLayer * step, middle = p + 0.5f * inLayer * step;
  const float above = bilinear(&m_light[(direction * (layers + 1) + layer) * plane], from.x, from.y);
  const float depth = bilinear(&m_depth[(direction * layers + layer) * plane], middle.x, middle.y);
  // A hit of the slices is the first that is seen from above, so that nothing of its own layer stands right over it,
  // and little of it in a slanted way. Measured against rays on the samples: light within 5 % from all heights.
  const float own = seenBy == LayerSet::Slices ? 0.6f : seenBy == LayerSet::Ground ? 1.0f : 0.85f;
  return std::min(above * std::exp(-own * inLayer * depth), 1.0f);
}

ArrivingLight CanopyLight::arriving(const LayerHits& hits, const JobContext& job) const {
  const std::size_t count = hits.hits.size();
  ArrivingLight light;
  light.share.assign(m_directions.size(), std::vector<float>(count));
  light.cosine.assign(m_directions.size(), std::vector<float>(count));
  base::parallelFor(job, count, 512, [&](std::size_t begin, std::size_t end) {
    std::vector<glm::vec3> normals;
    for (std::size_t h = begin; h < end; ++h) normals.push_back(decodeNormal(hits.hits[h].normal));
    for (std::size_t d = 0; d < m_directions.size(); ++d) {
      const glm::vec3 direction(m_directions[d]);
      for (std::size_t h = begin; h < end; ++h) {
        light.share[d][h] = at(d, hits.hits[h].position, hits.set);
        light.cosine[d][h] = glm::dot(normals[h - begin], direction);
      }
    }
  });
  return light;
}

LayerLuminance luminanceOf(const LayerHits& hits, const ArrivingLight& arriving, std::size_t direction) {
  LayerLuminance out;
  out.reflected.resize(hits.texels(), 0.0f);
  out.transmitted.resize(hits.texels(), 0.0f);
  const std::vector<float>&share = arriving.share[direction], &cosine = arriving.cosine[direction];
  for (std::size_t texel = 0; texel < hits.texels(); ++texel) {
    for (std::uint32_t h = hits.hitStart[texel]; h < hits.hitStart[texel + 1]; ++h) {
      (cosine[h] > 0.0f ? out.reflected : out.transmitted)[texel] += std::abs(cosine[h]) * share[h];
    }
    const float scale = meanScale(hits, texel);
    out.reflected[texel] = std::min(out.reflected[texel] * scale, 1.0f);
    out.transmitted[texel] = std::min(out.transmitted[texel] * scale, 1.0f);
  }
  return out;
}

LayerVisibility visibilityOf(const LayerHits& hits, const ArrivingLight& arriving,
                             std::span<const glm::dvec3> directions) {
  LayerVisibility out;
  out.visibility.resize(hits.texels(), 0.0f);
  out.skyReflected.resize(hits.texels(), 0.0f);
  out.skyTransmitted.resize(hits.texels(), 0.0f);
  const std::vector<char> seesBlade = viewersOf(hits.set, directions);
  const auto viewers = static_cast<float>(std::count(seesBlade.begin(), seesBlade.end(), char{1}));
  // As in sampleVisibility: the directions share the hemisphere's 2 pi.
  const float skyWeight = 2.0f / static_cast<float>(directions.size());
  for (std::size_t texel = 0; texel < hits.texels(); ++texel) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      for (std::uint32_t h = hits.hitStart[texel]; h < hits.hitStart[texel + 1]; ++h) {
        const float cosine = arriving.cosine[d][h], share = arriving.share[d][h];
        (cosine > 0.0f ? out.skyReflected : out.skyTransmitted)[texel] += share * std::abs(cosine);
        out.visibility[texel] += seesBlade[d] != 0 ? share : 0.0f;
      }
    }
    const float scale = meanScale(hits, texel);
    out.visibility[texel] = std::min(out.visibility[texel] * scale / viewers, 1.0f);
    out.skyReflected[texel] = std::min(out.skyReflected[texel] * scale * skyWeight, 1.0f);
    out.skyTransmitted[texel] = std::min(out.skyTransmitted[texel] * scale * skyWeight, 1.0f);
  }
  return out;
}

}  // namespace sward::trace
