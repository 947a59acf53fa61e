#pragma once

#include "bake/asset_hashes.h"
#include "base/hash.h"
#include "base/result.h"
#include "project/project.h"
#include "trace/layers.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::bake {

/// Keys of what is baked of one layer set.
struct SetKeys {
  base::Hash128 hits;
  std::vector<base::Hash128> luminance;  ///< one a light, by its direction
  base::Hash128 visibility;
  base::Hash128 surface;
  base::Hash128 sunLuminance;    ///< of the sun, where the basis needs one (lpt::needsSun)
  base::Hash128 representation;  ///< of such a basis, whatever the sun
  base::Hash128 fit;
  base::Hash128 stack;
};

/// Keys of a whole project's ground. Each is the hash of its kind, that kind's version, the values it reads and its
/// inputs' keys, so they are known before anything is baked. Assets enter by their bytes.
struct GroundKeys {
  base::Hash128 patch;                ///< geometry alone
  std::vector<base::Hash128> plants;  ///< shape and colours of each plant's models, without their number and places
  std::array<SetKeys, trace::kAllLayerSets.size()> sets;
  base::Hash128 seamFit;  ///< ten coefficients a column, whatever the basis drawn
  base::Hash128 tiles;
  base::Hash128 map;
  base::Hash128 ground;

  const SetKeys& of(trace::LayerSet set) const { return sets[static_cast<std::size_t>(set)]; }
};

/// The fit options of one layer set: the soil is a single layer, of which LPT in any form is a PTM.
lpt::FitOptions fitOptionsOf(const project::Project& project, trace::LayerSet set);
/// How the same set's stack is quantised: what was relit for one sun keeps 16 bits, its own rounding is in it already.
lpt::FitOptions stackOptionsOf(const project::Project& project, trace::LayerSet set);
/// What seams are cut by, whatever the layers keep: an LPT in depth, whose coefficients alone tell two columns apart.
lpt::FitOptions seamOptionsOf(const project::Project& project);

/// Whether two projects say the same about the ground, so that their grounds are the same as long as their asset files
/// are. Reads no file and hashes nothing: for a thread that must not wait. Two that differ may still give equal
/// grounds.
bool sameGroundValues(const project::Project& a, const project::Project& b);

/// How a ground is sampled: by rays, or by passing over all triangles with light as in a turbid medium.
enum class Sampler { Rays, Passes };

/// What decides about a ground beside its project.
struct GroundSettings {
  Sampler sampler = Sampler::Rays;
  std::vector<glm::ivec2> layout;  ///< diamonds to keep, in slabs of blades; empty: they are chosen
  std::optional<glm::dvec3> sun;   ///< unit, z >= 0; where the basis needs one
};

/// Reads asset files (errors: one is missing or unreadable), bakes nothing.
Result<GroundKeys> groundKeys(const project::Project& project, std::span<const glm::dvec3> lights,
                              const GroundSettings& settings, AssetHashes& assets);

}  // namespace sward::bake
