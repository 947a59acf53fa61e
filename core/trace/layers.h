#pragma once

#include "base/bytes.h"
#include "base/job.h"
#include "base/result.h"
#include "scene/patch.h"
#include "trace/options.h"
#include "trace/patch_scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// The layer sets of a patch. Image axes never mirror: columns run along +x (slices, ground, blades seen along y) or +y
/// (blades seen along x); rows along +y (slices, ground) or +z (blades). Layer 0 is nearest the viewer.
enum class LayerSet : std::uint8_t {
  Slices,      ///< horizontal slabs seen from above; layer 0 the top slab
  BladesPosX,  ///< slabs normal to x, seen by a viewer at +x; layer 0 is [L - L/n, L]
  BladesNegX,  ///< the same slabs seen from -x; layer 0 is [0, L/n]
  BladesPosY,
  BladesNegY,
  Ground  ///< the plane z = 0 under the grass, one layer, always hit
};
inline constexpr std::array kAllLayerSets{LayerSet::Slices,     LayerSet::BladesPosX, LayerSet::BladesNegX,
                                          LayerSet::BladesPosY, LayerSet::BladesNegY, LayerSet::Ground};
const char* layerSetName(LayerSet set);

struct LayerShape {
  int width = 0, height = 0, layers = 0;
  int columns() const { return width * height; }
  bool operator==(const LayerShape&) const = default;
};
LayerShape layerShape(LayerSet set, const SamplingOptions& options);

/// A surface point found by a sub-sample.
struct Hit {
  glm::vec3 position;                          ///< metres, inside the patch square
  std::array<std::int16_t, 2> normal;          ///< octahedral (Meyer et al. 2010), of the side that faces the viewer
  std::uint32_t instance = 0;                  ///< index into Patch::instances
  std::uint32_t triangle = 0;                  ///< index into the model's triangles
  std::array<std::uint16_t, 2> barycentric{};  ///< u, v as unorm16
};
glm::vec3 decodeNormal(const std::array<std::int16_t, 2>& octahedral);
std::array<std::int16_t, 2> encodeNormal(const glm::vec3& normal);

/// Where the geometry of one set is. Sparse: only layer texels that some sub-sample hit ("texels" below) are kept,
/// column by column (column = y * width + x), layers ascending.
struct LayerHits {
  LayerSet set = LayerSet::Slices;
  LayerShape shape;
  int subSamples = 1;
  std::vector<std::uint32_t> columnStart;  ///< columns + 1: texels of column c are [columnStart[c], columnStart[c + 1])
  std::vector<std::uint8_t> layer;         ///< layer of each texel
  std::vector<std::uint32_t> hitStart;     ///< texels + 1: hits of texel t are [hitStart[t], hitStart[t + 1])
  std::vector<Hit> hits;

  std::size_t texels() const { return layer.size(); }
  /// Fraction of the sub-samples that hit, in (0, 1].
  float coverage(std::size_t texel) const {
    return static_cast<float>(hitStart[texel + 1] - hitStart[texel]) / static_cast<float>(subSamples);
  }
};

/// Colours of each texel: means over its hits.
struct LayerSurface {
  std::vector<glm::vec3> reflectance;  ///< linear RGB
  std::vector<glm::vec3> transmittance;
};

/// Response of each texel to one light of unit irradiance (on a plane facing it) with white albedo: means over its hits
/// of V(l) max(n.l, 0) and V(l) max(-n.l, 0), n toward the viewer; in [0, 1]. Multiply by r E / pi and t E / pi for
/// radiance.
struct LayerLuminance {
  std::vector<float> reflected;
  std::vector<float> transmitted;
};

/// Light-independent terms of each texel, all in [0, 1].
struct LayerVisibility {
  std::vector<float> visibility;      ///< delta: fraction of the view directions from which the texel is seen
  std::vector<float> skyReflected;    ///< (1/pi) integral of V(w) max(n.w, 0) dw over the upper hemisphere
  std::vector<float> skyTransmitted;  ///< the same with max(-n.w, 0)
};

/// Each step is a pure function; the same seed gives the same bytes on any number of threads. A cancelled job returns
/// Error::cancelled(). For the ground, `patch` supplies shadows only: normal +z, instance and triangle 0.
Result<LayerHits> sampleHits(const PatchScene& scene, LayerSet set, const SamplingOptions& options,
                             const JobContext& job);
/// Shades hits with the materials of `patch`, which may be newer than the traced scene in colour but not in shape. For
/// the ground `soil` gives the reflectance at each column (one a column), transmittance 0.
Result<LayerSurface> shadeSurface(const LayerHits& hits, const scene::Patch& patch, std::span<const glm::vec3> soil,
                                  const JobContext& job);
/// `light` is a unit vector toward the light, z >= 0.
Result<LayerLuminance> sampleLuminance(const PatchScene& scene, const LayerHits& hits, const glm::dvec3& light,
                                       const JobContext& job);
Result<LayerVisibility> sampleVisibility(const PatchScene& scene, const LayerHits& hits, const SamplingOptions& options,
                                         const JobContext& job);

/// Cache payloads. load returns false on damaged data.
void save(base::ByteWriter& out, const LayerHits& hits);
bool load(base::ByteReader& in, LayerHits& hits);
void save(base::ByteWriter& out, const LayerLuminance& luminance);  ///< as unorm16
bool load(base::ByteReader& in, LayerLuminance& luminance);
void save(base::ByteWriter& out, const LayerVisibility& visibility);
bool load(base::ByteReader& in, LayerVisibility& visibility);

}  // namespace sward::trace
