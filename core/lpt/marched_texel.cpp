#include "lpt/marched_texel.h"

#include "trace/voxel_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::lpt::detail {
namespace {

std::uint32_t quantised(float value, int bits) {
  const auto largest = static_cast<float>((1u << bits) - 1u);
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * largest));
}

/// Fields of a packed texel, from the lowest bit up.
class Bits {
 public:
  explicit Bits(std::uint32_t code = 0) : m_code(code) {}
  void put(float value, int bits) {
    m_code |= quantised(value, bits) << m_shift;
    m_shift += bits;
  }
  float take(int bits) {
    const std::uint32_t largest = (1u << bits) - 1u;
    const auto value = static_cast<float>((m_code >> m_shift) & largest) / static_cast<float>(largest);
    m_shift += bits;
    return value;
  }
  std::uint32_t code() const { return m_code; }

 private:
  std::uint32_t m_code;
  int m_shift = 0;
};
constexpr int kNormalBits = 7, kSharpBits = 4, kSideBits = 2, kPlaceBits = 3, kDepthBits = 4;

}  // namespace

TexelFrame::TexelFrame(trace::LayerSet set, const trace::LayerShape& shape, double sideM, double heightM) {
  const bool blades = set != trace::LayerSet::Slices && set != trace::LayerSet::Ground;
  if (blades) {
    const bool alongX = set == trace::LayerSet::BladesPosX || set == trace::LayerSet::BladesNegX;
    const bool fromFar = set == trace::LayerSet::BladesPosX || set == trace::LayerSet::BladesPosY;
    const glm::dvec3 axis = alongX ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    viewer = fromFar ? axis : -axis;
    right = alongX ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    top = {0.0, 0.0, 1.0};
    corner = fromFar ? sideM * axis : glm::dvec3(0.0);
  } else if (set == trace::LayerSet::Slices) {
    corner = {0.0, 0.0, heightM};
  }
  across = right * (sideM / shape.width);
  up = top * ((blades ? heightM : sideM) / shape.height);
  const double thickness = (blades ? sideM : heightM) / shape.layers;
  away = set == trace::LayerSet::Ground ? glm::dvec3(0.0) : -viewer * thickness;
}

TexelLight texelLight(const trace::LayerHits& hits, std::size_t texel, const TexelFrame& frame,
                      const glm::dvec3& corner, const trace::VoxelDensity& density) {
  using Seen = trace::VoxelDensity::Seen;
  const std::uint32_t begin = hits.hitStart[texel], end = hits.hitStart[texel + 1];
  const double each = 1.0 / static_cast<double>(end - begin);
  glm::dvec3 normal(0.0), place(0.0);
  double facing = 0.0, behind = 0.0;
  for (std::uint32_t h = begin; h < end; ++h) {
    const trace::Hit& hit = hits.hits[h];
    normal += each * glm::dvec3(trace::decodeNormal(hit.normal));
    place += each * (glm::dvec3(hit.position) - corner);
    const Seen seen = hits.set == trace::LayerSet::Ground ? Seen::Outside : density.seen(hit);
    facing += seen == Seen::Inside ? 0.0 : each;
    behind += seen == Seen::Outside ? 0.0 : each;
  }
  TexelLight light;
  const double length = glm::length(normal);
  light.sharp = static_cast<float>(std::clamp(3.0 * length - 2.0, 0.0, 1.0));
  const glm::dvec3 local(glm::dot(normal, frame.right), glm::dot(normal, frame.top), glm::dot(normal, frame.viewer));
  // A smooth normal may lean away from the viewer a little.
  if (length > 1e-6) light.normal = glm::vec3(glm::normalize(glm::dvec3(local.x, local.y, std::max(local.z, 1e-3))));
  light.facing = static_cast<float>(facing);
  light.behind = static_cast<float>(behind);
  const glm::dvec3 edges[3] = {frame.across, frame.up, frame.away};
  for (int axis = 0; axis < 3; ++axis) {
    const double square = glm::dot(edges[axis], edges[axis]);
    light.place[axis] =
        square > 0.0 ? static_cast<float>(std::clamp(glm::dot(place, edges[axis]) / square, 0.0, 1.0)) : 0.5f;
  }
  return light;
}

std::uint32_t packTexel(const TexelLight& texel) {
  const glm::vec2 normal = trace::hemiOctahedral(texel.normal);
  Bits bits;
  bits.put(normal.x, kNormalBits);
  bits.put(normal.y, kNormalBits);
  bits.put(texel.sharp, kSharpBits);
  bits.put(texel.facing, kSideBits);
  bits.put(texel.behind, kSideBits);
  bits.put(texel.place.x, kPlaceBits);
  bits.put(texel.place.y, kPlaceBits);
  bits.put(texel.place.z, kDepthBits);
  return bits.code();
}

TexelLight unpackTexel(std::uint32_t code) {
  Bits bits(code);
  TexelLight texel;
  glm::vec2 normal;
  normal.x = bits.take(kNormalBits);
  normal.y = bits.take(kNormalBits);
  texel.normal = trace::fromHemiOctahedral(normal);
  texel.sharp = bits.take(kSharpBits);
  texel.facing = bits.take(kSideBits);
  texel.behind = bits.take(kSideBits);
  texel.place.x = bits.take(kPlaceBits);
  texel.place.y = bits.take(kPlaceBits);
  texel.place.z = bits.take(kDepthBits);
  return texel;
}

double unshadowed(double sharp, double cosine) {
  const double c = std::clamp(cosine, -1.0, 1.0);
  const double sphere =
      sharp < 1.0 ? 2.0 / (3.0 * std::numbers::pi) * (std::sqrt(1.0 - c * c) + (std::numbers::pi - std::acos(c)) * c)
                  : 0.0;
  return sharp * std::max(c, 0.0) + (1.0 - sharp) * sphere;
}

}  // namespace sward::lpt::detail
