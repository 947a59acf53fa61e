#pragma once

#include "base/random.h"
#include "trace/layers.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/trace: where the sub-samples of a layer set lie, whatever finds what they hit.
namespace sward::trace {

inline constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15ULL;  ///< 2^64 over the golden ratio: spreads counters

/// Which triangle of which instance was hit.
struct SurfaceId {
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
};

/// A hit at distance t along its ray, at barycentric (u, v) of the triangle: p = (1 - u - v) a + u b + v c.
struct RawHit {
  float t, u, v;
  SurfaceId surface;
};

/// Interpolated unit normal at a hit, on the side that a ray along `direction` sees.
glm::vec3 viewerNormal(const scene::Patch& patch, const RawHit& raw, const glm::vec3& direction);

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
/// Of a patch `side` metres square and `height` metres high.
SetRays raysOf(LayerSet set, float side, float height, int layers);

/// Sub-samples lie in the cells of an across x down grid over the texel, as square as their number allows.
struct Strata {
  int across = 1, down = 1;
  explicit Strata(int count);
};

/// The jittered rays of one layer set.
class SamplePattern {
 public:
  SamplePattern(LayerSet set, float side, float height, const LayerShape& shape, int subSamples, std::uint64_t seed)
      : m_rays(raysOf(set, side, height, shape.layers)),
        m_side(side),
        m_shape(shape),
        m_subSamples(subSamples),
        m_strata(subSamples),
        m_seed(base::mix64(seed, static_cast<std::uint64_t>(set))) {}

  const SetRays& rays() const { return m_rays; }
  /// Of a column (y * width + x), for bitsOf.
  std::uint64_t columnSeed(std::size_t column) const { return base::mix64(m_seed ^ base::mix64(column)); }
  /// Bits for one ray: 24 for each jitter, the rest for its identity.
  std::uint64_t bitsOf(std::uint64_t columnSeed, int layer, int subSample) const {
    const auto index = static_cast<std::uint64_t>(layer) * static_cast<std::uint64_t>(m_subSamples);
    return base::mix64(columnSeed + (index + static_cast<std::uint64_t>(subSample)) * kGolden);
  }
  /// What decides about alpha.
  static std::uint32_t rayId(std::uint64_t bits) { return static_cast<std::uint32_t>(bits ^ (bits >> 16)); }
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
  /// The hit of a sub-sample as it is kept: its place, the normal that its viewer sees, its surface.
  Hit finish(const scene::Patch& patch, const RawHit& raw, int x, int y, int layer, int subSample) const;

 private:
  SetRays m_rays;
  float m_side;
  LayerShape m_shape;
  int m_subSamples;
  Strata m_strata;
  std::uint64_t m_seed;
};

/// Of each direction, 1 when a viewer of this layer set looks from there: any from above, those on the viewer's side
/// for blades (all of them where none is).
std::vector<char> viewersOf(LayerSet set, std::span<const glm::dvec3> directions);

/// An empty LayerHits of a set's shape, and whether that can be sampled at all.
Result<LayerHits> startHits(LayerSet set, const SamplingOptions& options);
/// The plane z = 0 of a patch `side` metres square: every sub-sample hits.
void sampleGround(double side, std::uint64_t seed, LayerHits& out);

}  // namespace sward::trace
