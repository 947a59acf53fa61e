#include "mesh/ribbon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::mesh {
namespace {

constexpr int kStepsPerSegment = 8;  // midpoint steps; the axis is then smooth far below a blade's width

std::uint32_t addVertex(Model& model, glm::dvec3 position, const glm::dvec3& normal, const glm::dvec2& uv,
                        const glm::dvec3& colour) {
  position.z = std::max(position.z, 0.0);
  model.positions.emplace_back(position);
  model.normals.emplace_back(glm::vec3(glm::normalize(normal)));
  model.uvs.emplace_back(uv);
  model.colours.emplace_back(glm::vec4(glm::vec3(glm::clamp(colour, 0.0, 1.0)), 1.0f));
  return static_cast<std::uint32_t>(model.positions.size() - 1);
}

/// Adds a triangle unless it has no area.
void addTriangle(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
  const glm::dvec3 pa(model.positions[a]), pb(model.positions[b]), pc(model.positions[c]);
  if (glm::length(glm::cross(pb - pa, pc - pa)) < 1e-12) return;
  model.triangles.emplace_back(a, b, c);
  model.triangleMaterial.push_back(material);
}

glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& unitAxis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return v * c + glm::cross(unitAxis, v) * s + unitAxis * glm::dot(unitAxis, v) * (1.0 - c);
}

/// One half of a ribbon, or all of it: from `from` to `to` across (-1 to 1).
struct Strip {
  double from = -1.0;
  double to = 1.0;
};

struct StripVertices {
  std::uint32_t left = 0;
  std::uint32_t right = 0;
};

StripVertices addStripRow(Model& model, const Ribbon& ribbon, const AxisRow& row, const Strip& strip) {
  const double half = ribbon.halfWidth(row.s);
  const glm::dvec3 upper = glm::normalize(glm::cross(row.tangent, row.side));
  const auto edge = [&](double across) {
    return row.centre +
           half * (across * std::cos(ribbon.fold) * row.side + std::abs(across) * std::sin(ribbon.fold) * upper);
  };
  // The left half leans its upper side toward the right, and the other way round.
  const double lean = 0.5 * (strip.from + strip.to);
  const glm::dvec3 normal =
      ribbon.fold > 0.0 ? upper * std::cos(ribbon.fold) - 2.0 * lean * row.side * std::sin(ribbon.fold) : upper;
  const auto vertex = [&](double across) {
    return addVertex(model, edge(across), normal, {0.5 + 0.5 * across, row.s}, ribbon.colour(row.s, across));
  };
  const std::uint32_t left = vertex(strip.from);
  return {left, vertex(strip.to)};
}

}  // namespace

std::vector<AxisRow> axisRows(const Axis& axis) {
  const int segments = std::max(axis.segments, 1);
  const int steps = segments * kStepsPerSegment;
  const double ds = 1.0 / steps;
  const auto rowAt = [&](const glm::dvec3& centre, double s) {
    const double azimuth = axis.azimuth + axis.drift * s;
    const double inclination = axis.lean + axis.bend * std::pow(s, axis.power);
    const glm::dvec3 outward(std::cos(azimuth), std::sin(azimuth), 0.0);
    glm::dvec3 tangent = std::sin(inclination) * outward + glm::dvec3(0.0, 0.0, std::cos(inclination));
    if (centre.z <= 0.0 && tangent.z < 0.0 && s > 0.0) tangent = outward;
    const glm::dvec3 side(-std::sin(azimuth), std::cos(azimuth), 0.0);
    return AxisRow{centre, tangent, rotated(side, tangent, axis.turn + axis.twist * s), s};
  };
  std::vector<AxisRow> rows;
  rows.reserve(static_cast<std::size_t>(segments) + 1);
  glm::dvec3 centre = axis.foot;
  rows.push_back(rowAt(centre, 0.0));
  for (int i = 0; i < steps; ++i) {
    centre += rowAt(centre, (i + 0.5) * ds).tangent * (axis.length * ds);
    centre.z = std::max(centre.z, 0.0);
    if ((i + 1) % kStepsPerSegment == 0) rows.push_back(rowAt(centre, (i + 1) * ds));
  }
  return rows;
}

void appendRibbon(Model& model, const Ribbon& ribbon) {
  static constexpr Strip kWhole[] = {{-1.0, 1.0}};
  static constexpr Strip kHalves[] = {{-1.0, 0.0}, {0.0, 1.0}};
  const std::span<const Strip> strips =
      ribbon.fold > 0.0 ? std::span<const Strip>(kHalves) : std::span<const Strip>(kWhole);
  for (const Strip& strip : strips) {
    StripVertices below = addStripRow(model, ribbon, ribbon.rows.front(), strip);
    for (const AxisRow& row : ribbon.rows.subspan(1)) {
      const StripVertices above = addStripRow(model, ribbon, row, strip);
      addTriangle(model, below.left, above.left, below.right, ribbon.material);
      addTriangle(model, below.right, above.left, above.right, ribbon.material);
      below = above;
    }
  }
}

void appendTube(Model& model, const Tube& tube) {
  const int sides = std::max(tube.sides, 3);
  const auto ring = [&](const AxisRow& row) {
    const glm::dvec3 other = glm::cross(row.tangent, row.side);
    const double radius = tube.radius(row.s);
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const glm::dvec3 outward = std::cos(angle) * row.side + std::sin(angle) * other;
      addVertex(model, row.centre + radius * outward, outward, {static_cast<double>(i) / sides, row.s},
                tube.colour(row.s, 0.0));
    }
    return first;
  };
  std::uint32_t below = ring(tube.rows.front());
  for (const AxisRow& row : tube.rows.subspan(1)) {
    const std::uint32_t above = ring(row);
    for (int i = 0; i < sides; ++i) {
      const auto here = static_cast<std::uint32_t>(i), next = static_cast<std::uint32_t>((i + 1) % sides);
      addTriangle(model, below + here, below + next, above + here, tube.material);
      addTriangle(model, below + next, above + next, above + here, tube.material);
    }
    below = above;
  }
}

void appendScale(Model& model, const glm::dvec3& base, const glm::dvec3& along, const glm::dvec3& face,
                 double halfWidth, const glm::dvec3& baseColour, const glm::dvec3& tipColour, std::uint32_t material) {
  const glm::dvec3 side = glm::normalize(glm::cross(face, along));
  const glm::dvec3 normal = glm::normalize(glm::cross(along, side));
  const glm::dvec3 middle = base + 0.45 * along;
  const glm::dvec3 middleColour = glm::mix(baseColour, tipColour, 0.45);
  // The edges' normals turn outward, so that the flat scale shades like a rounded one.
  const std::uint32_t root = addVertex(model, base, normal, {0.5, 0.0}, baseColour);
  const std::uint32_t left =
      addVertex(model, middle - halfWidth * side, normal - 0.6 * side, {0.0, 0.45}, middleColour);
  const std::uint32_t right =
      addVertex(model, middle + halfWidth * side, normal + 0.6 * side, {1.0, 0.45}, middleColour);
  const std::uint32_t tip = addVertex(model, base + along, normal, {0.5, 1.0}, tipColour);
  addTriangle(model, root, right, left, material);
  addTriangle(model, left, right, tip, material);
}

Material plantMaterial(const char* name, const LeafOptics& optics) {
  Material material;
  material.name = name;
  material.optics = optics;
  return material;
}

double cutNormal(base::Random& random) {
  return std::clamp(random.normal(), -2.0, 2.0);
}

double variedLength(base::Random& random, double mean, double variation) {
  return mean * std::max(1.0 + variation * cutNormal(random), 0.1);
}

glm::dvec3 variedColour(base::Random& random, const glm::dvec3& colour, double variation) {
  const double brightness = 1.0 + variation * cutNormal(random);
  const double warmth = 0.5 * variation * cutNormal(random);  // toward yellow or toward blue-green
  const glm::dvec3 varied = colour * std::max(brightness, 0.1) * glm::dvec3(1.0 + warmth, 1.0, 1.0 - warmth);
  return glm::clamp(varied, 0.0, 1.0);
}

glm::dvec3 dryColour(const glm::dvec3& leaf) {
  const double luminance = 0.2126 * leaf.r + 0.7152 * leaf.g + 0.0722 * leaf.b;
  return glm::clamp(luminance * glm::dvec3(1.65, 1.28, 0.60), 0.0, 1.0);
}

}  // namespace sward::mesh
