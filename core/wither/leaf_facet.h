#pragma once

#include "mesh/measure.h"
#include "trace/triangle_field.h"
#include "wither/strand.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/wither: what a triangle of a patch is as a part of a leaf.
namespace sward::wither {

struct LeafFacet {
  double areaM2 = 0.0;      ///< one-sided: half of it where the part is closed
  glm::dvec3 normal{0.0};   ///< unit
  bool oriented = false;    ///< the normal's sign is known; else it points upward, for want of better
  glm::dvec3 tangent{0.0};  ///< unit, the rise of s over the triangle; zero where s does not rise
  std::int32_t strand = -1;
  double s = 0.0, du = 0.0, dv = 0.0;  ///< s at the triangle's (u, v): s + du u + dv v
};

/// Normals point out of closed parts; on open ones away from the vein where they face it (tubes), else to the upper
/// side of the strand, which is the outer one of its bend: the same all along a leaf. Flat parts, both sides of which
/// are modelled, count as open.
class LeafFacets {
 public:
  LeafFacets(const trace::TriangleField& field, const PatchStrands* strands);
  /// Of a triangle of the field; no area: it is degenerate.
  LeafFacet of(std::uint32_t number) const;

 private:
  void attach(LeafFacet& facet, const trace::TriangleField::Part& part, const glm::uvec3& corner, const glm::dvec3& ab,
              const glm::dvec3& ac, const glm::dvec3& twice) const;
  void orient(LeafFacet& facet, mesh::Side side, const glm::dvec3& centre) const;

  const trace::TriangleField& m_field;
  const PatchStrands* m_strands;
  std::vector<std::vector<mesh::Side>> m_sides;  ///< [model][triangle]
};

}  // namespace sward::wither
