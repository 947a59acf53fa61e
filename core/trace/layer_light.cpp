#include "trace/layers.h"

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "scene/lights.h"
#include "trace/layer_pattern.h"
#include "trace/occlusion.h"
#include "trace/tile_order.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

namespace sward::trace {
namespace {

/// A number of its own for each ray, for the chance of alpha.
std::uint32_t rayId(std::uint64_t directionSeed, std::uint32_t hit) {
  return static_cast<std::uint32_t>(base::mix64(directionSeed + hit));
}

std::uint64_t seedOf(const glm::dvec3& direction) {
  return base::mix64(std::bit_cast<std::uint64_t>(direction.x), std::bit_cast<std::uint64_t>(direction.y),
                     std::bit_cast<std::uint64_t>(direction.z));
}

void checkDirection(const glm::dvec3& direction) {
  SWARD_CHECK_GE(direction.z, 0.0);
  SWARD_CHECK_LT(std::abs(glm::length(direction) - 1.0), 1e-3);
}

/// The luminance of one tile at a time; a worker's own.
class LuminanceWorker {
 public:
  LuminanceWorker(const PatchScene::Impl& scene, const LayerHits& hits, const glm::dvec3& light)
      : m_scene(scene), m_hits(hits), m_light(light), m_lightFloat(light), m_seed(seedOf(light)), m_order(hits.shape) {}

  void runTile(std::size_t tile, LayerLuminance& out) {
    m_order.texelsOf(tile, m_hits, m_texels, m_columns);
    m_batch.clear();
    m_cosines.clear();
    m_texelOfRay.clear();
    for (const std::uint32_t texel : m_texels) {
      for (std::uint32_t h = m_hits.hitStart[texel]; h < m_hits.hitStart[texel + 1]; ++h) addHit(texel, h);
    }
    m_batch.trace(m_scene, m_light);
    for (std::size_t i = 0; i < m_batch.size(); ++i) {
      if (m_batch.occluded(i)) continue;
      const float cosine = m_cosines[i];
      (cosine > 0.0f ? out.reflected : out.transmitted)[m_texelOfRay[i]] += std::abs(cosine);
    }
    for (const std::uint32_t texel : m_texels) {
      const float scale = 1.0f / static_cast<float>(m_hits.hitStart[texel + 1] - m_hits.hitStart[texel]);
      out.reflected[texel] = std::min(out.reflected[texel] * scale, 1.0f);
      out.transmitted[texel] = std::min(out.transmitted[texel] * scale, 1.0f);
    }
  }

 private:
  void addHit(std::uint32_t texel, std::uint32_t h) {
    const Hit& hit = m_hits.hits[h];
    const float cosine = glm::dot(decodeNormal(hit.normal), m_lightFloat);
    if (cosine == 0.0f) return;  // lit along its plane: no response, so no ray
    m_batch.add(hit.position, rayId(m_seed, h));
    m_cosines.push_back(cosine);
    m_texelOfRay.push_back(texel);
  }

  const PatchScene::Impl& m_scene;
  const LayerHits& m_hits;
  glm::dvec3 m_light;
  glm::vec3 m_lightFloat;
  std::uint64_t m_seed;
  TileOrder m_order;
  OcclusionBatch m_batch;
  std::vector<std::uint32_t> m_texels, m_columns, m_texelOfRay;
  std::vector<float> m_cosines;
};

/// Directions over the upper hemisphere, turned about z by quarters: one set for each column of every 2 x 2, so that
/// neighbours see different directions and their mean sees four times as many, while rays stay in few directions.
constexpr int kTurns = 4;
struct TurnedDirections {
  std::vector<glm::dvec3> directions;
  std::vector<char> seesBlade;  ///< whether a viewer of this layer set looks from there
};

std::array<TurnedDirections, kTurns> turnedDirections(LayerSet set, int count) {
  std::array<TurnedDirections, kTurns> turns;
  for (int turn = 0; turn < kTurns; ++turn) {
    TurnedDirections& out = turns[static_cast<std::size_t>(turn)];
    for (const glm::dvec3& d : scene::fibonacciHemisphere(count)) {
      glm::dvec3 turned = d;
      for (int quarter = 0; quarter < turn; ++quarter) turned = {-turned.y, turned.x, turned.z};
      out.directions.push_back(turned);
    }
    out.seesBlade = viewersOf(set, out.directions);
  }
  return turns;
}

/// Visibility and sky of one tile at a time; a worker's own.
class VisibilityWorker {
 public:
  VisibilityWorker(const PatchScene::Impl& scene, const LayerHits& hits, int directions, std::uint64_t seed)
      : m_scene(scene),
        m_hits(hits),
        m_seed(base::mix64(seed, static_cast<std::uint64_t>(hits.set))),
        m_turns(turnedDirections(hits.set, directions)),
        m_order(hits.shape) {}

  void runTile(std::size_t tile, LayerVisibility& out) {
    m_order.texelsOf(tile, m_hits, m_texels, m_columns);
    for (auto& group : m_groups) group.clear();
    const auto width = static_cast<std::uint32_t>(m_hits.shape.width);
    for (std::size_t i = 0; i < m_texels.size(); ++i) {
      const std::uint32_t x = m_columns[i] % width, y = m_columns[i] / width;
      m_groups[(x & 1u) + 2u * (y & 1u)].push_back(m_texels[i]);
    }
    for (std::size_t turn = 0; turn < kTurns; ++turn) runGroup(m_groups[turn], m_turns[turn], out);
  }

 private:
  void runGroup(const std::vector<std::uint32_t>& texels, const TurnedDirections& turn, LayerVisibility& out) {
    const std::size_t count = turn.directions.size();
    for (std::size_t d = 0; d < count; ++d) {
      const std::uint64_t directionSeed = base::mix64(m_seed ^ seedOf(turn.directions[d]));
      m_batch.clear();
      for (const std::uint32_t texel : texels) {
        const std::uint32_t h = hitFor(texel, d);
        m_batch.add(m_hits.hits[h].position, rayId(directionSeed, h));
      }
      m_batch.trace(m_scene, turn.directions[d]);
      const glm::vec3 direction(turn.directions[d]);
      for (std::size_t i = 0; i < texels.size(); ++i) {
        if (m_batch.occluded(i)) continue;
        const std::uint32_t texel = texels[i];
        const float cosine = glm::dot(decodeNormal(m_hits.hits[hitFor(texel, d)].normal), direction);
        (cosine > 0.0f ? out.skyReflected : out.skyTransmitted)[texel] += std::abs(cosine);
        out.visibility[texel] += turn.seesBlade[d] != 0 ? 1.0f : 0.0f;
      }
    }
    // The directions share the hemisphere's 2 pi: (1 / pi) sum cos 2 pi / m. For a plate under a free sky the sum of
    // the lattice's heights 1 - (i + 1/2) / m is m / 2, so the result is 1 exactly.
    const float skyWeight = 2.0f / static_cast<float>(count);
    const auto seen = static_cast<float>(std::count(turn.seesBlade.begin(), turn.seesBlade.end(), char{1}));
    for (const std::uint32_t texel : texels) {
      out.visibility[texel] /= seen;
      out.skyReflected[texel] = std::min(out.skyReflected[texel] * skyWeight, 1.0f);
      out.skyTransmitted[texel] = std::min(out.skyTransmitted[texel] * skyWeight, 1.0f);
    }
  }

  /// The texel's hits take turns, so that each direction costs one ray and yet all hits count.
  std::uint32_t hitFor(std::uint32_t texel, std::size_t direction) const {
    const std::uint32_t first = m_hits.hitStart[texel], count = m_hits.hitStart[texel + 1] - first;
    return first + static_cast<std::uint32_t>(direction + texel) % count;
  }

  const PatchScene::Impl& m_scene;
  const LayerHits& m_hits;
  std::uint64_t m_seed;
  std::array<TurnedDirections, kTurns> m_turns;
  TileOrder m_order;
  OcclusionBatch m_batch;
  std::vector<std::uint32_t> m_texels, m_columns;
  std::array<std::vector<std::uint32_t>, kTurns> m_groups;
};

}  // namespace

Result<LayerLuminance> sampleLuminance(const PatchScene& scene, const LayerHits& hits, const glm::dvec3& light,
                                       const JobContext& job) {
  checkDirection(light);
  LayerLuminance out;
  out.reflected.resize(hits.texels(), 0.0f);
  out.transmitted.resize(hits.texels(), 0.0f);
  const std::size_t tiles = TileOrder(hits.shape).tiles();
  base::ProgressCounter progress(job, std::string("light on the ") + layerSetName(hits.set), tiles);
  base::parallelFor(job, tiles, 1, [&](std::size_t begin, std::size_t end) {
    LuminanceWorker worker(scene.impl(), hits, light);
    for (std::size_t tile = begin; tile < end; ++tile) {
      worker.runTile(tile, out);
      progress.add();
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return out;
}

Result<LayerVisibility> sampleVisibility(const PatchScene& scene, const LayerHits& hits, const SamplingOptions& options,
                                         const JobContext& job) {
  if (options.visibilityDirections < 1 || options.visibilityDirections > 65536) {
    return Error::badInput("the number of view directions is not between 1 and 65536", "sampling.visibilityDirections",
                           "Give 16, or more for a smoother sky.");
  }
  LayerVisibility out;
  out.visibility.resize(hits.texels(), 0.0f);
  out.skyReflected.resize(hits.texels(), 0.0f);
  out.skyTransmitted.resize(hits.texels(), 0.0f);
  const std::size_t tiles = TileOrder(hits.shape).tiles();
  base::ProgressCounter progress(job, std::string("sky over the ") + layerSetName(hits.set), tiles);
  base::parallelFor(job, tiles, 1, [&](std::size_t begin, std::size_t end) {
    VisibilityWorker worker(scene.impl(), hits, options.visibilityDirections, options.seed);
    for (std::size_t tile = begin; tile < end; ++tile) {
      worker.runTile(tile, out);
      progress.add();
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return out;
}

}  // namespace sward::trace
