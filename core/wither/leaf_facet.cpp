#include "wither/leaf_facet.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>

namespace sward::wither {
namespace {

/// Where and in which direction a vein is at s.
struct VeinPoint {
  glm::dvec3 at, tangent;
};
VeinPoint veinAt(const std::vector<glm::dvec3>& vein, double s) {
  const double place = std::clamp(s, 0.0, 1.0) * static_cast<double>(vein.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), vein.size() - 2);
  const glm::dvec3 along = vein[i + 1] - vein[i];
  return {vein[i] + (place - static_cast<double>(i)) * along, along};
}

}  // namespace

LeafFacets::LeafFacets(const trace::TriangleField& field, const PatchStrands* strands)
    : m_field(field), m_strands(strands) {
  const scene::Patch& patch = field.patch();
  if (strands != nullptr) {
    SWARD_CHECK_EQ(strands->models.size(), patch.models.size());
    SWARD_CHECK_EQ(strands->firstStrand.size(), patch.instances.size());
  }
  for (const auto& model : patch.models) {
    m_sides.push_back(model ? mesh::triangleSides(*model) : std::vector<mesh::Side>());
  }
}

LeafFacet LeafFacets::of(std::uint32_t number) const {
  const trace::TriangleField::Part& part = m_field.partOf(number);
  const std::uint32_t triangle = number - part.firstTriangle;
  const glm::uvec3 corner = part.model->triangles[triangle];
  const glm::vec3* vertices = m_field.positions().data() + part.firstVertex;
  const glm::dvec3 a(vertices[corner.x]), ab = glm::dvec3(vertices[corner.y]) - a,
                                          ac = glm::dvec3(vertices[corner.z]) - a;
  const glm::dvec3 twice = glm::cross(ab, ac);
  const double length = glm::length(twice);
  LeafFacet facet;
  if (!(length > 0.0)) return facet;
  const mesh::Side side = m_sides[m_field.patch().instances[part.instance].model][triangle];
  facet.areaM2 = (side == mesh::Side::Open ? 0.5 : 0.25) * length;
  facet.normal = twice / length;
  if (m_strands != nullptr) attach(facet, part, corner, ab, ac, twice);
  orient(facet, side, a + (ab + ac) / 3.0);
  return facet;
}

void LeafFacets::attach(LeafFacet& facet, const trace::TriangleField::Part& part, const glm::uvec3& corner,
                        const glm::dvec3& ab, const glm::dvec3& ac, const glm::dvec3& twice) const {
  const Strands& model = m_strands->models[m_field.patch().instances[part.instance].model];
  const Attachment &a = model.attachments[corner.x], &b = model.attachments[corner.y], &c = model.attachments[corner.z];
  if (a.strand < 0) return;
  facet.strand = a.strand + static_cast<std::int32_t>(m_strands->firstStrand[part.instance]);
  facet.s = static_cast<double>(a.s);
  if (b.strand != a.strand || c.strand != a.strand) return;
  facet.du = static_cast<double>(b.s) - facet.s;
  facet.dv = static_cast<double>(c.s) - facet.s;
  // The gradient g in the triangle's plane has g.ab = du and g.ac = dv: g = (du ac x n + dv n x ab) / |n|^2.
  const glm::dvec3 gradient = facet.du * glm::cross(ac, twice) + facet.dv * glm::cross(twice, ab);
  const double length = glm::length(gradient);
  if (length > 0.0) facet.tangent = gradient / length;
}

void LeafFacets::orient(LeafFacet& facet, mesh::Side side, const glm::dvec3& centre) const {
  if (side == mesh::Side::Out || side == mesh::Side::Into) {
    facet.oriented = true;
    if (side == mesh::Side::Into) facet.normal = -facet.normal;
    return;
  }
  glm::dvec3 toward(0.0, 0.0, 1.0);
  if (facet.strand >= 0) {
    const Strand& strand = m_strands->strands[static_cast<std::size_t>(facet.strand)];
    const VeinPoint vein = veinAt(strand.vein, facet.s + (facet.du + facet.dv) / 3.0);
    const glm::dvec3 away = centre - vein.at, bend(strand.bendTo, 0.0);
    constexpr double kFaces = 0.5;  // a flat leaf's vein lies in its plane, a tube's under its surface
    facet.oriented = true;
    if (std::abs(glm::dot(away, facet.normal)) > kFaces * glm::length(away)) {
      toward = away;
    } else {
      toward = glm::dot(vein.tangent, bend) * toward - vein.tangent.z * bend;
    }
  }
  if (glm::dot(facet.normal, toward) < 0.0) facet.normal = -facet.normal;
}

}  // namespace sward::wither
