#include "bake/import.h"

#include "mesh/gltf_read.h"
#include "project/assets.h"

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

/// Files drawn in other units than metres are scaled to this height.
constexpr double kUsualHeightM = 0.3;

/// Area of leaves over a unit of ground in a dense sward (one side).
constexpr double kLeafAreaIndex = 3.0;

double surfaceArea(const mesh::Model& model) {
  double area = 0.0;
  for (const glm::uvec3& triangle : model.triangles) {
    const glm::dvec3 a = model.positions[triangle.x], b = model.positions[triangle.y], c = model.positions[triangle.z];
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}

}  // namespace

Result<project::Plant> plantFromMesh(const std::filesystem::path& mesh, const std::filesystem::path& folder) {
  SWARD_ASSIGN(const mesh::Model model, mesh::readGltf(mesh));
  const mesh::Bounds box = mesh::bounds(model);
  const glm::dvec3 size = glm::dvec3(box.high) - glm::dvec3(box.low);
  project::Plant plant;
  plant.name = mesh.stem().string();
  plant.kind = project::PlantKind::Gltf;
  plant.gltf.path = project::assetPath(mesh, folder);
  double scale = 1.0;
  if (!(size.z >= 0.02 && size.z <= 2.0)) {
    plant.gltf.heightM = kUsualHeightM;
    scale = kUsualHeightM / std::max(size.z, 1e-9);
  }
  const double areaM2 = std::max(scale * scale * surfaceArea(model), 1e-6);
  plant.densityPerM2 = std::round(std::clamp(kLeafAreaIndex / areaM2, 4.0, 1500.0));
  plant.variants = 1;
  plant.share = 0.0;
  return plant;
}

}  // namespace sward::bake
