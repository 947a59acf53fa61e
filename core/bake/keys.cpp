#include "bake/keys.h"

#include "bake/plants.h"
#include "bake/withering.h"
#include "project/value_hash.h"

#include <algorithm>

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
constexpr int kFitVersion = 3;
constexpr int kRepresentationVersion = 1;
constexpr int kTilesVersion = 2;
constexpr int kStackVersion = 2;
constexpr int kGroundVersion = 2;
constexpr int kWitherVersion = 2;  ///< of how plants age

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

struct PlantHash {
  Hash128 shape, colour;
};

Result<PlantHash> plantHash(const project::Project& project, const project::Plant& plant, AssetHashes& assets) {
  Hash128 file{};
  if (plant.kind == project::PlantKind::Gltf) {
    SWARD_ASSIGN(file, assets.gltf(project.resolve(plant.gltf.path)));
  }
  const auto hashRole = [&](Role role) {
    Hasher hasher;
    hasher.add(file);
    project::hashValues(hasher, plant, role);
    return hasher.finish();
  };
  return PlantHash{hashRole(Role::Shape), hashRole(Role::Colour)};
}

/// What withering does to the plants' forms and colours; nothing to plants that stand as they grew.
void addWithering(const project::Project& project, Role role, Hasher& hasher) {
  if (!withers(project)) return;
  const wither::WitherOptions& wither = project.wither;
  hasher.add(std::string_view("wither")).add(kWitherVersion).add(wither.weathering).add(wither.mingle.size());
  project::hashValues(hasher, wither.ageing, role);
  project::hashValues(hasher, wither.body, role);
  for (const wither::MingleSample& sample : wither.mingle) project::hashValues(hasher, sample, role);
  project::hashValues(hasher, project.leaf, role);
}

struct PatchHash {
  Hash128 shape, colour, soil;
  std::vector<Hash128> plants;
};

Result<PatchHash> patchHash(const project::Project& project, AssetHashes& assets) {
  std::vector<Hash128> plants;
  Hasher shape = start("patch", kPatchVersion), colour = start("colours", kSurfaceVersion);
  shape.add(project.patch.sideM).add(project.patch.seed).add(project.patch.plants.size());
  for (std::size_t i = 0; i < project.patch.plants.size(); ++i) {
    SWARD_ASSIGN(const PlantHash plant, plantHash(project, project.patch.plants[i], assets));
    Hasher model = start("model", kPatchVersion);
    model.add(plant.shape).add(plant.colour);
    for (const Role role : {Role::Shape, Role::Colour}) addWithering(project, role, model);
    plants.push_back(model.finish());
    shape.add(plantCount(project, i)).add(plant.shape);
    colour.add(plant.colour);
  }
  addWithering(project, Role::Shape, shape);
  addWithering(project, Role::Colour, colour);
  Hasher soil = start("soil", kSurfaceVersion);
  soil.add(project.patch.sideM).add(project.patch.seed);
  project::hashValues(soil, project.patch.soil, Role::Colour);
  if (!project.patch.soil.texture.empty()) {
    SWARD_ASSIGN(const Hash128 texture, assets.file(project.resolve(project.patch.soil.texture)));
    soil.add(texture);
  }
  return PatchHash{shape.finish(), colour.finish(), soil.finish(), std::move(plants)};
}

bool isBlade(trace::LayerSet set) {
  return set != trace::LayerSet::Slices && set != trace::LayerSet::Ground;
}

Hash128 hitsKey(const Hash128& patch, trace::LayerSet set, const trace::SamplingOptions& options, Sampler sampler) {
  const trace::LayerShape shape = trace::layerShape(set, options);
  Hasher hasher = start("hits", kHitsVersion);
  hasher.add(patch).add(set).add(shape.width).add(shape.height).add(shape.layers);
  hasher.add(isBlade(set) ? options.bladeSubSamples : options.sliceSubSamples).add(options.seed);
  if (sampler == Sampler::Passes) {
    hasher.add(std::string_view("passes"));
  } else {
    hasher.add(instructionSet()).add(RTC_VERSION);
  }
  return hasher.finish();
}

/// Of a representation that is relit on the processor.
Hash128 representationKey(const SetKeys& keys, const Hash128& patch, const lpt::FitOptions& options) {
  Hasher hasher = start("representation", kRepresentationVersion);
  hasher.add(keys.hits).add(keys.visibility).add(options.basis).add(options.clusters).add(options.layerRidge);
  hasher.add(options.lightRidge).add(options.bits).add(options.clampQuantile);
  if (options.basis == lpt::Basis::Marched) return hasher.add(patch).finish();
  for (const Hash128& light : keys.luminance) hasher.add(light);
  return hasher.finish();
}

Hash128 fitKey(const SetKeys& keys, const lpt::FitOptions& options, const std::optional<glm::dvec3>& sun) {
  Hasher hasher = start("fit", kFitVersion);
  if (lpt::needsSun(options.basis)) {
    hasher.add(keys.hits).add(keys.visibility).add(options.basis);
    if (options.basis == lpt::Basis::Sampled) return hasher.add(keys.sunLuminance).finish();
    return hasher.add(keys.representation).add(sun->x).add(sun->y).add(sun->z).finish();
  }
  hasher.add(keys.hits).add(keys.visibility).add(keys.luminance.size());
  for (const Hash128& light : keys.luminance) hasher.add(light);
  hasher.add(options.basis).add(options.paper).add(options.layerRidge).add(options.lightRidge);
  if (options.basis == lpt::Basis::Lpt) hasher.add(options.coordinate);
  return hasher.finish();
}

SetKeys setKeys(const project::Project& project, const PatchHash& patch, trace::LayerSet set,
                std::span<const glm::dvec3> lights, const GroundSettings& settings) {
  const Sampler sampler = settings.sampler;
  SetKeys keys;
  keys.hits = hitsKey(patch.shape, set, project.sampling, sampler);
  const auto luminanceKey = [&](const glm::dvec3& light) {
    Hasher hasher = start("luminance", kLuminanceVersion);
    hasher.add(keys.hits).add(light.x).add(light.y).add(light.z);
    if (sampler == Sampler::Passes) hasher.add(project.sampling.sliceResolution).add(project.sampling.slices);
    return hasher.finish();
  };
  for (const glm::dvec3& light : lights) keys.luminance.push_back(luminanceKey(light));
  if (settings.sun) keys.sunLuminance = luminanceKey(*settings.sun);
  Hasher visibility = start("visibility", kVisibilityVersion);
  visibility.add(keys.hits).add(project.sampling.visibilityDirections).add(project.sampling.seed);
  if (sampler == Sampler::Passes) {
    // Seen from the lights; and the medium has a voxel for some texels of the slices.
    visibility.add(project.sampling.sliceResolution).add(project.sampling.slices).add(lights.size());
    for (const Hash128& light : keys.luminance) visibility.add(light);
  }
  keys.visibility = visibility.finish();
  Hasher surface = start("surface", kSurfaceVersion);
  keys.surface = surface.add(keys.hits).add(set == trace::LayerSet::Ground ? patch.soil : patch.colour).finish();
  const lpt::FitOptions options = fitOptionsOf(project, set);
  if (lpt::needsSun(options.basis)) keys.representation = representationKey(keys, patch.shape, options);
  keys.fit = fitKey(keys, options, settings.sun);
  return keys;
}

Hash128 mapKey(const tiles::TileOptions& t) {
  // Of the tiles only the colours of their edges count.
  Hasher hasher = start("map", kGroundVersion);
  hasher.add(t.coloursPerAxis).add(t.tilesPerPair).add(t.mapWidth).add(t.mapHeight).add(t.map).add(t.seed);
  return hasher.finish();
}

Hash128 tilesKey(const GroundKeys& keys, const project::Project& project, const std::vector<glm::ivec2>& layout) {
  const tiles::TileOptions& t = project.tiles;
  Hasher hasher = start("tiles", kTilesVersion);
  hasher.add(keys.seamFit).add(keys.of(trace::LayerSet::Slices).surface).add(project.sampling.blades);
  hasher.add(t.resolution).add(t.coloursPerAxis).add(t.tilesPerPair).add(t.overlap).add(t.apron);
  hasher.add(t.seam).add(t.domain).add(t.seed);
  for (const glm::ivec2& diamond : layout) hasher.add(diamond.x).add(diamond.y);
  return hasher.finish();
}

Hash128 stackKey(const GroundKeys& keys, const project::Project& project, trace::LayerSet set) {
  const SetKeys& inputs = keys.of(set);
  Hasher hasher = start("stack", kStackVersion);
  hasher.add(inputs.fit).add(inputs.surface).add(inputs.visibility);
  const lpt::FitOptions options = stackOptionsOf(project, set);
  hasher.add(options.bits).add(options.clampQuantile);
  if (!isBlade(set)) hasher.add(keys.tiles);
  return hasher.finish();
}

}  // namespace

lpt::FitOptions fitOptionsOf(const project::Project& project, trace::LayerSet set) {
  lpt::FitOptions options = project.fit;
  const bool layered = options.basis == lpt::Basis::Lpt || options.basis == lpt::Basis::Clustered;
  if (set == trace::LayerSet::Ground && layered) options.basis = lpt::Basis::Ptm;
  return options;
}

lpt::FitOptions stackOptionsOf(const project::Project& project, trace::LayerSet set) {
  lpt::FitOptions options = fitOptionsOf(project, set);
  if (!lpt::needsSun(options.basis)) return options;
  options.bits = 16;
  options.clampQuantile = 0.0;
  return options;
}

lpt::FitOptions seamOptionsOf(const project::Project& project) {
  lpt::FitOptions options = project.fit;
  options.basis = lpt::Basis::Lpt;
  options.coordinate = lpt::LayerCoordinate::Depth;
  return options;
}

namespace {

bool sameWithering(const project::Project& a, const project::Project& b) {
  if (drawnAsTexels(a) != drawnAsTexels(b)) return false;
  if (drawnAsTexels(a)) return a.wither == b.wither && a.leaf == b.leaf;
  if (!withers(a) && !withers(b)) return true;
  return a.wither.weathering == b.wither.weathering && a.wither.ageing == b.wither.ageing &&
         a.wither.body == b.wither.body && a.wither.mingle == b.wither.mingle && a.leaf == b.leaf;
}

}  // namespace

bool sameGroundValues(const project::Project& a, const project::Project& b) {
  const auto samePlant = [](const project::Plant& p, project::Plant q) {
    q.name = p.name;
    return p == q;
  };
  return a.folder == b.folder && a.patch.sideM == b.patch.sideM && a.patch.seed == b.patch.seed &&
         a.patch.soil == b.patch.soil && a.lights == b.lights && a.sampling == b.sampling && a.fit == b.fit &&
         a.tiles == b.tiles && sameWithering(a, b) && (!lpt::needsSun(a.fit.basis) || a.sun == b.sun) &&
         std::equal(a.patch.plants.begin(), a.patch.plants.end(), b.patch.plants.begin(), b.patch.plants.end(),
                    samePlant);
}

Result<GroundKeys> groundKeys(const project::Project& project, std::span<const glm::dvec3> lights,
                              const GroundSettings& settings, AssetHashes& assets) {
  SWARD_ASSIGN(PatchHash patch, patchHash(project, assets));
  GroundKeys keys;
  keys.patch = patch.shape;
  keys.plants = std::move(patch.plants);
  keys.map = mapKey(project.tiles);
  for (const trace::LayerSet set : trace::kAllLayerSets) {
    keys.sets[static_cast<std::size_t>(set)] = setKeys(project, patch, set, lights, settings);
  }
  keys.seamFit = fitKey(keys.of(trace::LayerSet::Slices), seamOptionsOf(project), {});
  keys.tiles = tilesKey(keys, project, settings.layout);
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
