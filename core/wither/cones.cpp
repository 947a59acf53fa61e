#include "wither/cones.h"

#include "base/check.h"
#include "base/random.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace sward::wither {
namespace {

/// A cone from the origin to `tip`: rings from the root up, then the tip, then the foot's middle.
mesh::Model cone(const ConeOptions& options, const glm::dvec3& tip) {
  mesh::Model model;
  mesh::Material material;
  material.name = "blade";
  material.baseColour = glm::vec4(options.colour, 1.0f);
  model.materials.push_back(material);
  const auto vertex = [&](const glm::dvec3& at, const glm::dvec3& normal, double u, double v) {
    model.positions.emplace_back(at);
    model.normals.emplace_back(glm::normalize(normal));
    model.uvs.emplace_back(u, v);
    model.colours.emplace_back(1.0f);
  };
  const auto sides = static_cast<std::uint32_t>(options.sides), segments = static_cast<std::uint32_t>(options.segments);
  for (std::uint32_t ring = 0; ring < segments; ++ring) {
    const double s = static_cast<double>(ring) / segments, radius = options.radiusM * (1.0 - s);
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / sides;
      const glm::dvec3 out(std::cos(angle), std::sin(angle), 0.0);
      vertex(s * tip + radius * out, out, static_cast<double>(side) / sides, s);
    }
  }
  vertex(tip, tip, 0.5, 1.0);
  vertex(glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.5, 0.0);
  const std::uint32_t top = segments * sides, foot = top + 1;
  for (std::uint32_t side = 0; side < sides; ++side) {
    const std::uint32_t next = (side + 1) % sides;
    model.triangles.emplace_back(foot, next, side);
    for (std::uint32_t ring = 0; ring + 1 < segments; ++ring) {
      const std::uint32_t low = ring * sides, high = low + sides;
      model.triangles.emplace_back(low + side, low + next, high + next);
      model.triangles.emplace_back(low + side, high + next, high + side);
    }
    model.triangles.emplace_back(top - sides + side, top - sides + next, top);
  }
  model.triangleMaterial.assign(model.triangles.size(), 0u);
  return model;
}

}  // namespace

scene::Patch growCones(const ConeOptions& options, std::uint64_t seed) {
  SWARD_CHECK(options.sides >= 3 && options.segments >= 1 && options.count >= 0);
  scene::Patch patch;
  patch.sideM = options.sideM;
  patch.heightM = options.heightM;
  for (int i = 0; i < options.count; ++i) {
    base::Random random(base::mix64(seed, static_cast<std::uint64_t>(i)));
    const glm::vec3 foot(random.uniform(0.0, options.sideM), random.uniform(0.0, options.sideM), 0.0);
    const double height = options.heightM * (1.0 - random.uniform(0.0, options.variation));
    const double azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
    // Evenly over the cap of directions: the tangent of the inclination as the root of an even number.
    const double lean = std::tan(options.leanDeg * std::numbers::pi / 180.0) * std::sqrt(random.uniform());
    const glm::dvec3 tip = height * glm::dvec3(lean * std::cos(azimuth), lean * std::sin(azimuth), 1.0);
    scene::Instance instance;
    instance.model = static_cast<std::uint32_t>(patch.models.size());
    instance.worldFromModel[3] = foot;
    patch.models.push_back(std::make_shared<mesh::Model>(cone(options, tip)));
    patch.instances.push_back(instance);
  }
  return patch;
}

}  // namespace sward::wither
