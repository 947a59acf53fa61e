#include "mesh/measure.h"

#include "mesh/parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace sward::mesh {
namespace {

/// Coverage of a triangle and its luminance times coverage, as means over a lattice of its points.
struct Seen {
  double coverage = 0.0, luminance = 0.0;
};
Seen seenOf(const Model& model, std::uint32_t triangle) {
  constexpr int kSide = 6;
  constexpr glm::dvec3 kLuminance(0.2126, 0.7152, 0.0722);
  Seen seen;
  int points = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; i + j < kSide; ++j, ++points) {
      const SurfaceSample at = surfaceAt(model, triangle, (static_cast<float>(i) + 1.0f / 3.0f) / kSide,
                                         (static_cast<float>(j) + 1.0f / 3.0f) / kSide);
      seen.coverage += static_cast<double>(at.alpha);
      seen.luminance += static_cast<double>(at.alpha) * glm::dot(kLuminance, glm::dvec3(at.reflectance));
    }
  }
  return {seen.coverage / points, seen.luminance / points};
}

}  // namespace

std::vector<Side> triangleSides(const Model& model) {
  constexpr double kLeastVolume = 1e-5;
  const Parts parts = findParts(model);
  std::vector<double> volume(model.positions.size(), 0.0), area(model.positions.size(), 0.0);
  const glm::dvec3 origin = model.positions.empty() ? glm::dvec3(0.0) : glm::dvec3(model.positions.front());
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const glm::uvec3& triangle = model.triangles[t];
    const glm::dvec3 a = glm::dvec3(model.positions[triangle.x]) - origin;
    const glm::dvec3 b = glm::dvec3(model.positions[triangle.y]) - origin;
    const glm::dvec3 c = glm::dvec3(model.positions[triangle.z]) - origin;
    // Signed volumes of the tetrahedra under a closed surface sum to what it encloses, positive where it winds outward.
    volume[parts.ofTriangle[t]] += glm::dot(a, glm::cross(b, c)) / 6.0;
    area[parts.ofTriangle[t]] += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  std::vector<Side> sides;
  sides.reserve(model.triangles.size());
  for (const std::uint32_t part : parts.ofTriangle) {
    const double least = kLeastVolume * area[part] * std::sqrt(area[part]);
    const bool flat = std::abs(volume[part]) <= least;
    sides.push_back(parts.open[part] ? Side::Open : flat ? Side::Flat : volume[part] > 0.0 ? Side::Out : Side::Into);
  }
  return sides;
}

Measure measure(const Model& model) {
  struct Part {
    double leafAreaM2 = 0.0;
    glm::vec3 low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};
  };
  const Parts parts = findParts(model);
  std::map<std::uint32_t, Part> sizes;
  Measure result;
  double surface = 0.0, solid = 0.0, covered = 0.0, light = 0.0;
  for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
    const glm::uvec3& triangle = model.triangles[t];
    const glm::vec3 a = model.positions[triangle.x], b = model.positions[triangle.y], c = model.positions[triangle.z];
    const double area = 0.5 * glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
    const Seen seen = seenOf(model, t);
    const bool open = parts.open[parts.ofTriangle[t]];
    surface += area;
    solid += open ? 0.0 : area;
    covered += area * seen.coverage;
    light += area * seen.luminance;
    Part& part = sizes[parts.ofTriangle[t]];
    part.leafAreaM2 += area * seen.coverage * (open ? 1.0 : 0.5);
    part.low = glm::min(part.low, glm::min(a, glm::min(b, c)));
    part.high = glm::max(part.high, glm::max(a, glm::max(b, c)));
  }
  double widths = 0.0;
  for (const auto& [root, part] : sizes) {
    const double diagonal = glm::length(glm::dvec3(part.high) - glm::dvec3(part.low));
    result.leafAreaM2 += part.leafAreaM2;
    widths += diagonal > 0.0 ? part.leafAreaM2 * part.leafAreaM2 / diagonal : 0.0;
  }
  result.solidShare = surface > 0.0 ? solid / surface : 0.0;
  result.partWidthM = result.leafAreaM2 > 0.0 ? widths / result.leafAreaM2 : 0.0;
  result.luminance = covered > 0.0 ? light / covered : 0.0;
  return result;
}

}  // namespace sward::mesh
