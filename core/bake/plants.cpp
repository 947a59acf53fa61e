#include "bake/plants.h"

#include "bake/withering.h"
#include "base/random.h"
#include "mesh/gltf_read.h"
#include "mesh/procedural.h"

#include <algorithm>

namespace sward::bake {

int variantCount(const project::Plant& plant) {
  return plant.kind == project::PlantKind::Gltf ? 1 : plant.variants;
}

double plantCount(const project::Project& project, std::size_t plant) {
  const project::Patch& patch = project.patch;
  double shares = 0.0;
  for (const project::Plant& p : patch.plants) shares += p.share;
  const project::Plant& p = patch.plants[plant];
  return shares > 0.0 ? p.densityPerM2 * patch.sideM * patch.sideM * p.share / shares : 0.0;
}

Result<mesh::Model> plantModel(const project::Project& project, std::size_t plant, int variant) {
  const project::Plant& p = project.patch.plants[plant];
  const std::uint64_t seed =
      base::mix64(project.patch.seed, plant, static_cast<std::uint64_t>(variant), 0x706c616e74);  // "plant"
  switch (p.kind) {
    case project::PlantKind::Grass:
      return mesh::growGrass(p.grass, seed);
    case project::PlantKind::Flower:
      return mesh::growFlower(p.flower, seed);
    case project::PlantKind::Clover:
      return mesh::growClover(p.clover, seed);
    case project::PlantKind::Gltf:
      break;
  }
  mesh::GltfReadOptions options;
  options.heightM = p.gltf.heightM;
  options.material = p.gltf.material;
  return mesh::readGltf(project.resolve(p.gltf.path), options);
}

Result<mesh::Model> patchModel(const project::Project& project, std::size_t plant, int index) {
  const int variants = variantCount(project.patch.plants[plant]);
  SWARD_ASSIGN(mesh::Model grown, plantModel(project, plant, index % variants));
  if (!withers(project)) return grown;
  const std::uint64_t seed =
      base::mix64(project.patch.seed, plant, static_cast<std::uint64_t>(index), 0x776974686572);  // "wither"
  return witheredModel(project, grown, static_cast<std::size_t>(index / variants), seed);
}

Result<scene::Patch> growPatch(const project::Project& project) {
  return growPatch(project, [&](std::size_t plant, int variant) -> Result<std::shared_ptr<const mesh::Model>> {
    SWARD_ASSIGN(mesh::Model model, patchModel(project, plant, variant));
    return std::make_shared<const mesh::Model>(std::move(model));
  });
}

Result<scene::Patch> growPatch(const project::Project& project, const ModelSource& source) {
  std::vector<std::shared_ptr<const mesh::Model>> models;
  std::vector<scene::PlantScatter> plants;
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    const project::Plant& plant = project.patch.plants[i];
    const int variants = variantCount(plant);
    for (std::size_t sample = 0; sample < sampleCount(project); ++sample) {
      scene::PlantScatter scatter;
      scatter.count = plantCount(project, i) * samplePart(project, sample);
      scatter.sizeVariation = plant.sizeVariation;
      scatter.tiltDeg = plant.tiltDeg;
      scatter.clumping = plant.clumping;
      for (int variant = 0; variant < variants; ++variant) {
        SWARD_ASSIGN(std::shared_ptr<const mesh::Model> model,
                     source(i, variant + static_cast<int>(sample) * variants));
        scatter.models.push_back(static_cast<std::uint32_t>(models.size()));
        models.push_back(std::move(model));
      }
      plants.push_back(std::move(scatter));
    }
  }
  scene::Patch patch = scene::scatter(project.patch.sideM, std::move(models), plants, project.patch.seed);
  patch.heightM = std::max(patch.heightM, kMinHeightM);
  return patch;
}

}  // namespace sward::bake
