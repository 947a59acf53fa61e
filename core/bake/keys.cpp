#include "bake/keys.h"

#include "bake/plants.h"
#include "base/file.h"
#include "mesh/gltf_read.h"
#include "project/value_hash.h"

#include <embree3/rtcore.h>

namespace sward::bake {
namespace {

using base::Hash128;
using base::Hasher;
using project::Role;

// Versions of the kinds: raise one when its result changes for the same inputs.
constexpr int kPatchVersion = 1;
constexpr int kHitsVersion = 1;
constexpr int kLuminanceVersion = 1;
constexpr int kVisibilityVersion = 1;
constexpr int kSurfaceVersion = 1;
constexpr int kFitVersion = 1;
constexpr int kTilesVersion = 2;
constexpr int kStackVersion = 1;
constexpr int kGroundVersion = 2;

Hasher start(std::string_view kind, int version) {
  Hasher hasher;
  hasher.add(kind).add(version);
  return hasher;
}

/// Embree picks its kernels by the processor, and their last bits differ.
std::string_view instructionSet() {
  if (__builtin_cpu_supports("avx512f")) return "avx512";
  if (__builtin_cpu_supports("avx2")) return "avx2";
  if (__builtin_cpu_supports("avx")) return "avx";
  return "sse";
}

Result<Hash128> fileHash(const std::filesystem::path& path) {
  SWARD_ASSIGN(const std::vector<std::byte> data, base::readFile(path));
  return base::hashBytes(data);
}

/// The bytes of the file and of everything it draws in.
Result<Hash128> gltfHash(const std::filesystem::path& path) {
  SWARD_ASSIGN(const std::vector<std::filesystem::path> files, mesh::gltfClosure(path));
  Hasher hasher;
  for (const auto& file : files) {
    SWARD_ASSIGN(const Hash128 hash, fileHash(file));
    hasher.add(std::string_view(file.filename().native())).add(hash);
  }
  return hasher.finish();
}

struct PlantHash {
  Hash128 shape, colour;
};

Result<PlantHash> plantHash(const project::Project& project, const project::Plant& plant) {
  Hash128 file{};
  if (plant.kind == project::PlantKind::Gltf) {
    SWARD_ASSIGN(file, gltfHash(project.resolve(plant.gltf.path)));
  }
  const auto hashRole = [&](Role role) {
    Hasher hasher;
    hasher.add(file);
    project::hashValues(hasher, plant, role);
    return hasher.finish();
  };
  return PlantHash{hashRole(Role::Shape), hashRole(Role::Colour)};
}

struct PatchHash {
  Hash128 shape, colour, soil;
};

Result<PatchHash> patchHash(const project::Project& project) {
  Hasher shape = start("patch", kPatchVersion), colour = start("colours", kSurfaceVersion);
  shape.add(project.patch.sideM).add(project.patch.seed).add(project.patch.plants.size());
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    SWARD_ASSIGN(const PlantHash plant, plantHash(project, project.patch.plants[i]));
    shape.add(plantCount(project, i)).add(plant.shape);
    colour.add(plant.colour);
  }
  Hasher soil = start("soil", kSurfaceVersion);
  soil.add(project.patch.sideM).add(project.patch.seed);
  project::hashValues(soil, project.patch.soil, Role::Colour);
  if (!project.patch.soil.texture.empty()) {
    SWARD_ASSIGN(const Hash128 texture, fileHash(project.resolve(project.patch.soil.texture)));
    soil.add(texture);
  }
  return PatchHash{shape.finish(), colour.finish(), soil.finish()};
}

bool isBlade(trace::LayerSet set) {
  return set != trace::LayerSet::Slices && set != trace::LayerSet::Ground;
}

Hash128 hitsKey(const Hash128& patch, trace::LayerSet set, const trace::SamplingOptions& options) {
  const trace::LayerShape shape = trace::layerShape(set, options);
  Hasher hasher = start("hits", kHitsVersion);
  hasher.add(patch).add(set).add(shape.width).add(shape.height).add(shape.layers);
  hasher.add(isBlade(set) ? options.bladeSubSamples : options.sliceSubSamples).add(options.seed);
  hasher.add(instructionSet()).add(RTC_VERSION);
  return hasher.finish();
}

Hash128 fitKey(const SetKeys& keys, const lpt::FitOptions& options) {
  Hasher hasher = start("fit", kFitVersion);
  hasher.add(keys.hits).add(keys.visibility).add(keys.luminance.size());
  for (const Hash128& light : keys.luminance) hasher.add(light);
  hasher.add(options.basis).add(options.paper).add(options.layerRidge).add(options.lightRidge);
  return hasher.finish();
}

SetKeys setKeys(const project::Project& project, const PatchHash& patch, trace::LayerSet set,
                std::span<const glm::dvec3> lights) {
  SetKeys keys;
  keys.hits = hitsKey(patch.shape, set, project.sampling);
  for (const glm::dvec3& light : lights) {
    Hasher hasher = start("luminance", kLuminanceVersion);
    keys.luminance.push_back(hasher.add(keys.hits).add(light.x).add(light.y).add(light.z).finish());
  }
  Hasher visibility = start("visibility", kVisibilityVersion);
  keys.visibility =
      visibility.add(keys.hits).add(project.sampling.visibilityDirections).add(project.sampling.seed).finish();
  Hasher surface = start("surface", kSurfaceVersion);
  keys.surface = surface.add(keys.hits).add(set == trace::LayerSet::Ground ? patch.soil : patch.colour).finish();
  keys.fit = fitKey(keys, fitOptionsOf(project, set));
  return keys;
}

Hash128 tilesKey(const GroundKeys& keys, const project::Project& project) {
  const tiles::TileOptions& t = project.tiles;
  Hasher hasher = start("tiles", kTilesVersion);
  hasher.add(keys.seamFit).add(keys.of(trace::LayerSet::Slices).surface).add(project.sampling.blades);
  hasher.add(t.resolution).add(t.coloursPerAxis).add(t.tilesPerPair).add(t.overlap).add(t.apron);
  hasher.add(t.seam).add(t.domain).add(t.seed);
  return hasher.finish();
}

Hash128 stackKey(const GroundKeys& keys, const project::Project& project, trace::LayerSet set) {
  const SetKeys& inputs = keys.of(set);
  Hasher hasher = start("stack", kStackVersion);
  hasher.add(inputs.fit).add(inputs.surface).add(inputs.visibility);
  hasher.add(project.fit.bits).add(project.fit.clampQuantile);
  if (!isBlade(set)) hasher.add(keys.tiles);
  return hasher.finish();
}

}  // namespace

lpt::FitOptions fitOptionsOf(const project::Project& project, trace::LayerSet set) {
  lpt::FitOptions options = project.fit;
  if (set == trace::LayerSet::Ground) options.basis = lpt::Basis::Ptm;
  return options;
}

Result<GroundKeys> groundKeys(const project::Project& project, std::span<const glm::dvec3> lights) {
  SWARD_ASSIGN(const PatchHash patch, patchHash(project));
  GroundKeys keys;
  keys.patch = patch.shape;
  for (const trace::LayerSet set : trace::kAllLayerSets) {
    keys.sets[static_cast<std::size_t>(set)] = setKeys(project, patch, set, lights);
  }
  lpt::FitOptions seam = project.fit;
  seam.basis = lpt::Basis::Lpt;
  keys.seamFit = fitKey(keys.of(trace::LayerSet::Slices), seam);
  keys.tiles = tilesKey(keys, project);
  Hasher ground = start("ground", kGroundVersion);
  for (const trace::LayerSet set : trace::kAllLayerSets) {
    SetKeys& entry = keys.sets[static_cast<std::size_t>(set)];
    entry.stack = stackKey(keys, project, set);
    ground.add(entry.stack);
  }
  const tiles::TileOptions& t = project.tiles;
  ground.add(keys.tiles).add(project.sampling.blades).add(t.mapWidth).add(t.mapHeight).add(t.map).add(t.seed);
  keys.ground = ground.finish();
  return keys;
}

}  // namespace sward::bake
