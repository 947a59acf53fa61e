#pragma once

#include "trace/layers.h"
#include "trace/voxel_density.h"

#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

/// Private to the marched representation: what it keeps of a layer texel.
namespace sward::lpt::detail {

/// Where the texels of a layer set lie in the patch: each a box, `across` and `up` along the image's axes, `away` from
/// the viewer.
struct TexelFrame {
  glm::dvec3 corner{0.0};                               ///< of texel (0, 0) of layer 0, nearest the viewer
  glm::dvec3 across{0.0}, up{0.0}, away{0.0};           ///< edges of a texel's box, metres
  glm::dvec3 right{1.0, 0.0, 0.0}, top{0.0, 1.0, 0.0};  ///< unit vectors of the image
  glm::dvec3 viewer{0.0, 0.0, 1.0};                     ///< unit vector toward the viewer

  TexelFrame(trace::LayerSet set, const trace::LayerShape& shape, double sideM, double heightM);
  /// The corner of a texel's box.
  glm::dvec3 cornerOf(int x, int y, int layer) const {
    return corner + static_cast<double>(x) * across + static_cast<double>(y) * up + static_cast<double>(layer) * away;
  }
};

/// How a texel's leaves answer light that reaches them all: the part `sharp` of their normals is one, the rest are
/// those of a sphere as its viewer on the side of that normal sees it.
struct TexelLight {
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< unit, in the image's axes: right, top, toward the viewer (z >= 0)
  float sharp = 1.0f;                  ///< in [0, 1]
  float facing = 1.0f;                 ///< part of the leaves that answer light on the viewer's side
  float behind = 1.0f;                 ///< part of them that answer light on the other: all but the outsides of solids
  glm::vec3 place{0.5f};               ///< mean hit in the texel's box, each in [0, 1]
  bool operator==(const TexelLight&) const = default;
};

/// From the hits of one texel, `corner` its box's. The mean of a sphere's visible normals is 2/3 long, so a mean normal
/// of length R has sharp = 3 R - 2.
TexelLight texelLight(const trace::LayerHits& hits, std::size_t texel, const TexelFrame& frame,
                      const glm::dvec3& corner, const trace::VoxelDensity& density);

/// Four bytes: normal 7 + 7 bits (hemi-octahedral), sharp 4, facing 2, behind 2, place 3 + 3 + 4.
std::uint32_t packTexel(const TexelLight& texel);
TexelLight unpackTexel(std::uint32_t code);

/// Mean of max(n.l, 0) over the normals of a texel, cosine = normal.l; of max(-n.l, 0) at -cosine. A sphere's is
/// 2 / (3 pi) (sin t + (pi - t) cos t) at the angle t.
double unshadowed(double sharp, double cosine);

}  // namespace sward::lpt::detail
