#include "trace/layers.h"

#include "base/parallel.h"
#include "base/random.h"
#include "trace/patch_scene_impl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace sward::trace {
namespace {

constexpr int kLanes = 16;
constexpr int kBandRows = 4;  ///< image rows that are traced together, in blocks of 4 x 4 columns: coherent packets
constexpr std::uint32_t kNoHit = ~0u;
constexpr int kMaxResolution = 16384;  ///< bounds the memory of a band
constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;

/// Rays of a layer set: from origin + u * uAxis + v * vAxis (u, v in [0, 1) over the image) along `direction`, which is
/// one of the axes and parallel to none of the image's; the n slabs share `depth`, beginning at `lead`.
struct SetRays {
  glm::vec3 origin{0.0f}, uAxis{0.0f}, vAxis{0.0f}, direction{0.0f};
  float lead = 0.0f;  ///< distance from the rays' origins to the first slab
  float depth = 0.0f;
  float firstBorder = 0.0f;  ///< where the first slab begins: at its edge, or before it where nothing else lies
  float rounding = 0.0f;     ///< of distances along the rays

  // A plane on the border of two slabs belongs to the one before it, and a plane on the patch's periodic border to one
  // end only. Embree's boxes are half-open by chance of rounding, so the borders are moved on by a few roundings, where
  // no plane is put on purpose, and the search ends a little behind what is accepted.
  float border(int layer, int layers) const {
    const float step = depth / static_cast<float>(layers);
    return (layer == 0 ? firstBorder : lead + step * static_cast<float>(layer)) + rounding;
  }
  float searchEnd(float end) const { return end + 4.0f * rounding; }
};

SetRays raysOf(LayerSet set, const PatchScene::Impl& scene, int layers) {
  const float side = scene.side, height = static_cast<float>(scene.patch->heightM);
  const glm::vec3 alongX(side, 0.0f, 0.0f), alongY(0.0f, side, 0.0f), up(0.0f, 0.0f, height);
  SetRays rays;
  switch (set) {
    case LayerSet::BladesPosX:
      rays = {alongX, alongY, up, {-1.0f, 0.0f, 0.0f}};
      break;
    case LayerSet::BladesNegX:
      rays = {{}, alongY, up, {1.0f, 0.0f, 0.0f}};
      break;
    case LayerSet::BladesPosY:
      rays = {alongY, alongX, up, {0.0f, -1.0f, 0.0f}};
      break;
    case LayerSet::BladesNegY:
      rays = {{}, alongX, up, {0.0f, 1.0f, 0.0f}};
      break;
    default:
      rays = {up, alongX, alongY, {0.0f, 0.0f, -1.0f}};
      break;
  }
  const bool slices = set == LayerSet::Slices;
  rays.depth = slices ? height : side;
  rays.lead = rays.depth / static_cast<float>(layers);
  rays.origin -= rays.lead * rays.direction;
  rays.firstBorder = slices ? 0.0f : rays.lead;
  rays.rounding = 4.0f * std::numeric_limits<float>::epsilon() * (rays.lead + rays.depth);
  return rays;
}

/// Sub-samples lie in the cells of an across x down grid over the texel, as square as their number allows.
struct Strata {
  int across = 1, down = 1;
  explicit Strata(int count) {
    for (int k = 1; k * k <= count; ++k) {
      if (count % k == 0) down = k;
    }
    across = count / down;
  }
};

struct RawHit {
  float t, u, v;
  SurfaceId surface;
};

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
        m_rays(raysOf(set, scene.impl(), shape.layers)),
        m_shape(shape),
        m_subSamples(subSamples),
        m_strata(subSamples),
        m_seed(base::mix64(seed, static_cast<std::uint64_t>(set))) {}

  BandHits sampleBand(int firstRow, const JobContext& job) const;

 private:
  struct Band;
  std::vector<BandRay> order(int rows) const;
  void traceLayer(Band& band, int layer, const std::vector<BandRay>& order) const;
  Hit finish(const Band& band, const RawHit& raw, int row, int column, int layer, int subSample) const;
  BandHits pack(const Band& band) const;

  /// Bits for one ray: 24 for each jitter, the rest for its identity.
  std::uint64_t bitsOf(std::uint64_t columnSeed, int layer, int subSample) const {
    const auto index = static_cast<std::uint64_t>(layer) * static_cast<std::uint64_t>(m_subSamples);
    return base::mix64(columnSeed + (index + static_cast<std::uint64_t>(subSample)) * kGolden);
  }
  glm::vec3 originOf(int x, int y, int subSample, std::uint64_t bits) const {
    const float du = base::unitFloat(bits), dv = base::unitFloat(bits << 24);
    const auto across = static_cast<float>(m_strata.across), down = static_cast<float>(m_strata.down);
    const float u = (static_cast<float>(x) + (static_cast<float>(subSample % m_strata.across) + du) / across) /
                    static_cast<float>(m_shape.width);
    const float v = (static_cast<float>(y) + (static_cast<float>(subSample / m_strata.across) + dv) / down) /
                    static_cast<float>(m_shape.height);
    constexpr float kBelowOne = 1.0f - 0x1.0p-24f;
    return m_rays.origin + std::min(u, kBelowOne) * m_rays.uAxis + std::min(v, kBelowOne) * m_rays.vAxis;
  }

  const PatchScene::Impl& m_scene;
  SetRays m_rays;
  LayerShape m_shape;
  int m_subSamples;
  Strata m_strata;
  std::uint64_t m_seed;
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
  for (std::size_t c = 0; c < columns; ++c) band.columnSeeds[c] = base::mix64(m_seed ^ base::mix64(firstColumn + c));
  band.found.assign(columns * static_cast<std::size_t>(m_shape.layers) * static_cast<std::size_t>(m_subSamples),
                    kNoHit);
  const std::vector<BandRay> rays = order(band.rows);
  for (int layer = 0; layer < m_shape.layers && !job.cancelled(); ++layer) traceLayer(band, layer, rays);
  m_scene.nearestCount.fetch_add(rays.size() * static_cast<std::size_t>(m_shape.layers), std::memory_order_relaxed);
  return pack(band);
}

void HitSampler::traceLayer(Band& band, int layer, const std::vector<BandRay>& order) const {
  const float start = m_rays.border(layer, m_shape.layers), end = m_rays.border(layer + 1, m_shape.layers);
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[kLanes];
  std::size_t slots[kLanes];
  for (std::size_t first = 0; first < order.size(); first += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, order.size() - first));
    for (int i = 0; i < kLanes; ++i) {
      const BandRay& ray = order[first + static_cast<std::size_t>(std::min(i, lanes - 1))];
      const std::size_t column = ray.row * static_cast<std::size_t>(m_shape.width) + ray.column;
      const std::uint64_t bits = bitsOf(band.columnSeeds[column], layer, ray.subSample);
      const glm::vec3 origin = originOf(static_cast<int>(ray.column), band.firstRow + ray.row, ray.subSample, bits);
      slots[i] = (column * static_cast<std::size_t>(m_shape.layers) + static_cast<std::size_t>(layer)) *
                     static_cast<std::size_t>(m_subSamples) +
                 ray.subSample;
      packet.ray.org_x[i] = origin.x;
      packet.ray.org_y[i] = origin.y;
      packet.ray.org_z[i] = origin.z;
      packet.ray.dir_x[i] = m_rays.direction.x;
      packet.ray.dir_y[i] = m_rays.direction.y;
      packet.ray.dir_z[i] = m_rays.direction.z;
      packet.ray.tnear[i] = start;
      packet.ray.tfar[i] = m_rays.searchEnd(end);
      packet.ray.time[i] = 0.0f;
      packet.ray.mask[i] = ~0u;
      packet.ray.id[i] = static_cast<std::uint32_t>(bits ^ (bits >> 16));
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

/// Interpolated normal of the side that a ray along `direction` sees.
glm::vec3 viewerNormal(const scene::Patch& patch, const RawHit& raw, const glm::vec3& direction) {
  const scene::Instance& instance = patch.instances[raw.surface.instance];
  const mesh::Model& model = *patch.models[instance.model];
  const glm::uvec3 corner = model.triangles[raw.surface.triangle];
  const glm::vec3 a = model.positions[corner.x];
  const glm::vec3 face = glm::cross(model.positions[corner.y] - a, model.positions[corner.z] - a);
  glm::vec3 smooth = (1.0f - raw.u - raw.v) * model.normals[corner.x] + raw.u * model.normals[corner.y] +
                     raw.v * model.normals[corner.z];
  const float agreement = glm::dot(smooth, face);
  if (!(glm::dot(smooth, smooth) > 1e-12f) || !std::isfinite(agreement)) smooth = face;
  if (agreement < 0.0f) smooth = -smooth;
  const glm::mat3 rotation(instance.worldFromModel);
  if (glm::dot(rotation * face, direction) > 0.0f) smooth = -smooth;
  const glm::vec3 world = rotation * smooth;
  return world / glm::length(world);
}

Hit HitSampler::finish(const Band& band, const RawHit& raw, int row, int column, int layer, int subSample) const {
  const std::size_t c =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(m_shape.width) + static_cast<std::size_t>(column);
  const glm::vec3 origin =
      originOf(column, band.firstRow + row, subSample, bitsOf(band.columnSeeds[c], layer, subSample));
  Hit hit;
  hit.position = origin + raw.t * m_rays.direction;
  hit.position.x = std::clamp(hit.position.x, 0.0f, m_scene.side);
  hit.position.y = std::clamp(hit.position.y, 0.0f, m_scene.side);
  hit.normal = encodeNormal(viewerNormal(*m_scene.patch, raw, m_rays.direction));
  hit.instance = raw.surface.instance;
  hit.triangle = raw.surface.triangle;
  const auto unorm = [](float x) { return static_cast<int>(std::lround(std::clamp(x, 0.0f, 1.0f) * 65535.0f)); };
  const int u = unorm(raw.u);
  hit.barycentric = {static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(std::min(unorm(raw.v), 65535 - u))};
  return hit;
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
          if (index != kNoHit) out.hits.push_back(finish(band, band.raw[index], row, column, layer, s));
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

Result<void> checkOptions(LayerSet set, const LayerShape& shape, int subSamples) {
  const std::string where = std::string("sampling of the ") + layerSetName(set);
  if (shape.width < 1 || shape.height < 1 || shape.layers < 1 || subSamples < 1) {
    return Error::badInput("a resolution, a number of layers or of sub-samples is not positive", where,
                           "Give at least 1 of each.");
  }
  // Layers are stored as bytes; columns, texels and hits are counted in 32 bits.
  const double rays = 1.0 * shape.width * shape.height * shape.layers * subSamples;
  if (shape.width > kMaxResolution || shape.height > kMaxResolution || shape.layers > 256 || subSamples > 4096 ||
      rays > 4e9) {
    return Error::badInput("there are too many texels, layers or rays", where,
                           "At most 16384 texels a side, 256 layers, 4096 sub-samples and 4 billion rays a layer set.");
  }
  return {};
}

/// The plane z = 0: every sub-sample hits.
void sampleGround(const PatchScene::Impl& scene, std::uint64_t seed, LayerHits& out) {
  const Strata strata(out.subSamples);
  const std::uint64_t base = base::mix64(seed, static_cast<std::uint64_t>(LayerSet::Ground));
  const auto columns = static_cast<std::size_t>(out.shape.columns());
  const auto subSamples = static_cast<std::size_t>(out.subSamples);
  out.columnStart.resize(columns + 1);
  out.hitStart.resize(columns + 1);
  out.layer.assign(columns, 0);
  out.hits.reserve(columns * subSamples);
  for (std::size_t c = 0; c <= columns; ++c) {
    out.columnStart[c] = static_cast<std::uint32_t>(c);
    out.hitStart[c] = static_cast<std::uint32_t>(c * subSamples);
  }
  const std::array<std::int16_t, 2> up = encodeNormal({0.0f, 0.0f, 1.0f});
  const auto side = static_cast<double>(scene.side);
  for (std::size_t c = 0; c < columns; ++c) {
    const auto x = static_cast<double>(c % static_cast<std::size_t>(out.shape.width));
    const auto y = static_cast<double>(c / static_cast<std::size_t>(out.shape.width));
    const std::uint64_t columnSeed = base::mix64(base ^ base::mix64(c));
    for (std::size_t s = 0; s < subSamples; ++s) {
      const std::uint64_t bits = base::mix64(columnSeed + s * kGolden);
      const auto across = static_cast<std::size_t>(strata.across);
      const double u = x + (static_cast<double>(s % across) + base::unitFloat(bits)) / strata.across;
      const double v = y + (static_cast<double>(s / across) + base::unitFloat(bits << 24)) / strata.down;
      Hit hit;
      hit.position = {std::min(static_cast<float>(side * u / out.shape.width), scene.side),
                      std::min(static_cast<float>(side * v / out.shape.height), scene.side), 0.0f};
      hit.normal = up;
      out.hits.push_back(hit);
    }
  }
}

}  // namespace

Result<LayerHits> sampleHits(const PatchScene& scene, LayerSet set, const SamplingOptions& options,
                             const JobContext& job) {
  LayerHits out;
  out.set = set;
  out.shape = layerShape(set, options);
  out.subSamples =
      set == LayerSet::Slices || set == LayerSet::Ground ? options.sliceSubSamples : options.bladeSubSamples;
  SWARD_TRY(checkOptions(set, out.shape, out.subSamples));
  if (job.cancelled()) return Error::cancelled();
  if (set == LayerSet::Ground) {
    sampleGround(scene.impl(), options.seed, out);
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
