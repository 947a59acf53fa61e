#include "trace/layers.h"

#include "base/parallel.h"
#include "trace/layer_pattern.h"
#include "trace/patch_scene_impl.h"

#include <algorithm>
#include <string>

namespace sward::trace {
namespace {

constexpr int kLanes = 16;
constexpr int kBandRows = 4;  ///< image rows that are traced together, in blocks of 4 x 4 columns: coherent packets
constexpr std::uint32_t kNoHit = ~0u;

/// One ray of a band, by its place in the image.
struct BandRay {
  std::uint16_t row;
  std::uint16_t subSample;
  std::uint32_t column;
};

/// Packed form of what a band of rows found.
struct BandHits {
  std::vector<std::uint32_t> texelsOfColumn;
  std::vector<std::uint8_t> layer;
  std::vector<std::uint32_t> hitsOfTexel;
  std::vector<Hit> hits;
};

class HitSampler {
 public:
  HitSampler(const PatchScene& scene, LayerSet set, const LayerShape& shape, int subSamples, std::uint64_t seed)
      : m_scene(scene.impl()),
        m_pattern(set, scene.impl().side, static_cast<float>(scene.patch().heightM), shape, subSamples, seed),
        m_shape(shape),
        m_subSamples(subSamples) {}

  BandHits sampleBand(int firstRow, const JobContext& job) const;

 private:
  struct Band;
  std::vector<BandRay> order(int rows) const;
  void traceLayer(Band& band, int layer, const std::vector<BandRay>& order) const;
  BandHits pack(const Band& band) const;

  const PatchScene::Impl& m_scene;
  SamplePattern m_pattern;
  LayerShape m_shape;
  int m_subSamples;
};

/// Work space of one band; `found` holds an index into `raw`, by (row, column, layer, sub-sample).
struct HitSampler::Band {
  int firstRow = 0, rows = 0;
  std::vector<std::uint64_t> columnSeeds;
  std::vector<std::uint32_t> found;
  std::vector<RawHit> raw;
};

std::vector<BandRay> HitSampler::order(int rows) const {
  std::vector<BandRay> order;
  order.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(m_shape.width) *
                static_cast<std::size_t>(m_subSamples));
  constexpr int kBlock = 2;
  for (int y0 = 0; y0 < rows; y0 += kBlock) {
    for (int x0 = 0; x0 < m_shape.width; x0 += kBlock) {
      for (int y = y0; y < std::min(y0 + kBlock, rows); ++y) {
        for (int x = x0; x < std::min(x0 + kBlock, m_shape.width); ++x) {
          for (int s = 0; s < m_subSamples; ++s) {
            order.push_back(
                {static_cast<std::uint16_t>(y), static_cast<std::uint16_t>(s), static_cast<std::uint32_t>(x)});
          }
        }
      }
    }
  }
  return order;
}

BandHits HitSampler::sampleBand(int firstRow, const JobContext& job) const {
  Band band;
  band.firstRow = firstRow;
  band.rows = std::min(kBandRows, m_shape.height - firstRow);
  const auto columns = static_cast<std::size_t>(band.rows) * static_cast<std::size_t>(m_shape.width);
  const std::size_t firstColumn = static_cast<std::size_t>(firstRow) * static_cast<std::size_t>(m_shape.width);
  band.columnSeeds.resize(columns);
  for (std::size_t c = 0; c < columns; ++c) band.columnSeeds[c] = m_pattern.columnSeed(firstColumn + c);
  band.found.assign(columns * static_cast<std::size_t>(m_shape.layers) * static_cast<std::size_t>(m_subSamples),
                    kNoHit);
  const std::vector<BandRay> rays = order(band.rows);
  for (int layer = 0; layer < m_shape.layers && !job.cancelled(); ++layer) traceLayer(band, layer, rays);
  m_scene.nearestCount.fetch_add(rays.size() * static_cast<std::size_t>(m_shape.layers), std::memory_order_relaxed);
  return pack(band);
}

void HitSampler::traceLayer(Band& band, int layer, const std::vector<BandRay>& order) const {
  const SetRays& rays = m_pattern.rays();
  const float start = rays.border(layer, m_shape.layers), end = rays.border(layer + 1, m_shape.layers);
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[kLanes];
  std::size_t slots[kLanes];
  for (std::size_t first = 0; first < order.size(); first += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, order.size() - first));
    for (int i = 0; i < kLanes; ++i) {
      const BandRay& ray = order[first + static_cast<std::size_t>(std::min(i, lanes - 1))];
      const std::size_t column = ray.row * static_cast<std::size_t>(m_shape.width) + ray.column;
      const std::uint64_t bits = m_pattern.bitsOf(band.columnSeeds[column], layer, ray.subSample);
      const glm::vec3 origin =
          m_pattern.originOf(static_cast<int>(ray.column), band.firstRow + ray.row, ray.subSample, bits);
      slots[i] = (column * static_cast<std::size_t>(m_shape.layers) + static_cast<std::size_t>(layer)) *
                     static_cast<std::size_t>(m_subSamples) +
                 ray.subSample;
      packet.ray.org_x[i] = origin.x;
      packet.ray.org_y[i] = origin.y;
      packet.ray.org_z[i] = origin.z;
      packet.ray.dir_x[i] = rays.direction.x;
      packet.ray.dir_y[i] = rays.direction.y;
      packet.ray.dir_z[i] = rays.direction.z;
      packet.ray.tnear[i] = start;
      packet.ray.tfar[i] = rays.searchEnd(end);
      packet.ray.time[i] = 0.0f;
      packet.ray.mask[i] = ~0u;
      packet.ray.id[i] = SamplePattern::rayId(bits);
      packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      valid[i] = i < lanes ? -1 : 0;
    }
    m_scene.intersect(valid, packet);
    for (int i = 0; i < lanes; ++i) {
      if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID || packet.ray.tfar[i] > end) continue;
      band.found[slots[i]] = static_cast<std::uint32_t>(band.raw.size());
      band.raw.push_back({packet.ray.tfar[i], packet.hit.u[i], packet.hit.v[i],
                          m_scene.surfaceOf(packet.hit.geomID[i], packet.hit.primID[i], packet.hit.instID[0][i])});
    }
  }
}

BandHits HitSampler::pack(const Band& band) const {
  BandHits out;
  out.hits.reserve(band.raw.size());
  std::size_t slot = 0;
  for (int row = 0; row < band.rows; ++row) {
    for (int column = 0; column < m_shape.width; ++column) {
      std::uint32_t texels = 0;
      for (int layer = 0; layer < m_shape.layers; ++layer) {
        const std::size_t before = out.hits.size();
        for (int s = 0; s < m_subSamples; ++s, ++slot) {
          const std::uint32_t index = band.found[slot];
          if (index != kNoHit) {
            out.hits.push_back(
                m_pattern.finish(*m_scene.patch, band.raw[index], column, band.firstRow + row, layer, s));
          }
        }
        if (out.hits.size() == before) continue;
        ++texels;
        out.layer.push_back(static_cast<std::uint8_t>(layer));
        out.hitsOfTexel.push_back(static_cast<std::uint32_t>(out.hits.size() - before));
      }
      out.texelsOfColumn.push_back(texels);
    }
  }
  return out;
}

/// Joins bands in order and frees them on the way.
void join(std::vector<BandHits> bands, LayerHits& out) {
  std::size_t texels = 0, hits = 0;
  for (const BandHits& band : bands) {
    texels += band.layer.size();
    hits += band.hits.size();
  }
  out.columnStart.reserve(static_cast<std::size_t>(out.shape.columns()) + 1);
  out.layer.reserve(texels);
  out.hitStart.reserve(texels + 1);
  out.hits.reserve(hits);
  out.columnStart.push_back(0);
  out.hitStart.push_back(0);
  for (BandHits& band : bands) {
    for (const std::uint32_t n : band.texelsOfColumn) out.columnStart.push_back(out.columnStart.back() + n);
    for (const std::uint32_t n : band.hitsOfTexel) out.hitStart.push_back(out.hitStart.back() + n);
    out.layer.insert(out.layer.end(), band.layer.begin(), band.layer.end());
    out.hits.insert(out.hits.end(), band.hits.begin(), band.hits.end());
    band = {};
  }
}

}  // namespace

Result<LayerHits> sampleHits(const PatchScene& scene, LayerSet set, const SamplingOptions& options,
                             const JobContext& job) {
  SWARD_ASSIGN(LayerHits out, startHits(set, options));
  if (job.cancelled()) return Error::cancelled();
  if (set == LayerSet::Ground) {
    sampleGround(scene.patch().sideM, options.seed, out);
    return out;
  }
  if (!scene.impl().top || !(scene.patch().heightM > 0.0)) {
    out.columnStart.assign(static_cast<std::size_t>(out.shape.columns()) + 1, 0);
    out.hitStart.assign(1, 0);
    return out;
  }
  const HitSampler sampler(scene, set, out.shape, out.subSamples, options.seed);
  const std::size_t count = static_cast<std::size_t>((out.shape.height + kBandRows - 1) / kBandRows);
  std::vector<BandHits> bands(count);
  base::ProgressCounter progress(job, std::string("hits of the ") + layerSetName(set), count);
  base::parallelFor(job, count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t band = begin; band < end; ++band) {
      bands[band] = sampler.sampleBand(static_cast<int>(band) * kBandRows, job);
      progress.add();
    }
  });
  if (job.cancelled()) return Error::cancelled();
  join(std::move(bands), out);
  return out;
}

}  // namespace sward::trace
