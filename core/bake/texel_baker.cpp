#include "bake/texel_baker.h"

#include "bake/asset_hashes.h"
#include "bake/keys.h"
#include "bake/payload.h"
#include "bake/plants.h"
#include "bake/soil.h"
#include "bake/texel_payload.h"
#include "bake/withering.h"
#include "project/value_hash.h"
#include "wither/points.h"
#include "wither/pose.h"
#include "wither/texel_lod.h"
#include "wither/voxelise.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <list>
#include <optional>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

constexpr int kRestVersion = 1;   ///< raise it when what texels are aged from changes for the same project
constexpr int kTexelVersion = 4;  ///< the same of the texels
constexpr const char* kRestKind = "rest";
constexpr int kCoarsest = 8;  ///< columns of the coarsest level: a voxel is then as wide as a tuft
/// Bent blades and the round of a splat's edge reach a little over the tallest plant.
constexpr double kHeadroom = 1.02;

/// A project whose plants stand as they grew.
project::Project atRest(const project::Project& project) {
  project::Project rest = project;
  rest.wither.weathering = 0.0;
  rest.wither.mingle.clear();
  return rest;
}

/// What every weathering degree of a sward is aged from.
struct Rest {
  base::Hash128 key;
  wither::TexelGrid grid;
  std::vector<wither::Strand> strands;
  wither::Points points;
  std::vector<glm::vec3> soil;
  std::uint64_t storedBytes = 0;
};

Result<base::Hash128> restKey(const project::Project& project, AssetHashes& assets) {
  // No light is part of this; some fits want a sun.
  GroundSettings settings;
  settings.sun = glm::dvec3(0.0, 0.0, 1.0);
  SWARD_ASSIGN(const GroundKeys keys, groundKeys(atRest(project), {}, settings, assets));
  base::Hasher hasher;
  hasher.add(std::string_view("rest")).add(kRestVersion).add(keys.patch).add(keys.of(trace::LayerSet::Slices).surface);
  hasher.add(keys.of(trace::LayerSet::Ground).surface).add(project.wither.texel.resolution);
  hasher.add(project.wither.texel.proportion);
  hasher.add(project.wither.ageing.variation).add(project.wither.body.droopVariation);
  for (const wither::MingleSample& sample : project.wither.mingle) hasher.add(sample.share);
  return hasher.finish();
}

Result<TexelRest> makeRest(const project::Project& project, const JobContext& job) {
  const int columns = project.wither.texel.resolution;
  TexelRest rest;
  SWARD_ASSIGN(const scene::Patch patch, growPatch(atRest(project)));
  const wither::TexelGrid grid = texelGridOf(patch.sideM, patch.heightM * kHeadroom, columns);
  SWARD_ASSIGN(wither::PatchStrands strands, wither::strandsOf(patch, project.wither, project.patch.seed));
  SWARD_ASSIGN(wither::VoxelisedPatch voxels, wither::voxelise(patch, grid, &strands, job));
  rest.texel = std::move(voxels.texel);
  rest.attachments = std::move(voxels.attachments);
  rest.strands = std::move(strands.strands);
  SWARD_ASSIGN(rest.soil, soilColours(project, columns));
  return rest;
}

/// From what is stored to what is held.
Result<Rest> heldRest(const project::Project& project, const base::Hash128& key, TexelRest stored,
                      std::uint64_t storedBytes, const JobContext& job) {
  Rest rest;
  rest.key = key;
  rest.grid = stored.texel.grid();
  SWARD_ASSIGN(rest.points, wither::texelToPoints(stored.texel, stored.attachments, stored.strands,
                                                  project.wither.texel.proportion, project.patch.seed, job));
  rest.strands = std::move(stored.strands);
  rest.soil = std::move(stored.soil);
  rest.storedBytes = storedBytes;
  return rest;
}

/// What load() cannot know: blades of samples that the project has, voxels of its resolution.
bool fits(const TexelRest& rest, const project::Project& project) {
  const auto samples = static_cast<int>(sampleCount(project));
  return rest.texel.grid().columns == project.wither.texel.resolution &&
         std::all_of(rest.strands.begin(), rest.strands.end(),
                     [&](const wither::Strand& strand) { return strand.sample < samples; });
}

/// Splatting is linear: samples that are denser than their share are mingled by the leaf area of their points.
void scaleByDensity(const project::Project& project, const std::vector<wither::Strand>& strands,
                    wither::Points& points) {
  const auto& samples = project.wither.mingle;
  if (samples.empty()) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::int32_t strand = points.attachments[i].strand;
    if (strand < 0) continue;
    const int sample = strands[static_cast<std::size_t>(strand)].sample;
    points.areaM2[i] *= static_cast<float>(samples[static_cast<std::size_t>(sample)].density);
  }
}

Result<std::vector<TexelBake::Level>> makeLevels(wither::Texel finest, const JobContext& job) {
  SWARD_ASSIGN(std::vector<wither::Texel> texels, wither::levels(finest, kCoarsest, job));
  std::vector<TexelBake::Level> levels(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    levels[i].texel = std::make_shared<const wither::Texel>(std::move(texels[i]));
    SWARD_ASSIGN(levels[i].sky, wither::sweptSky(*levels[i].texel, job));
  }
  return levels;
}

double secondsSince(std::chrono::steady_clock::time_point& start) {
  const auto now = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(now - std::exchange(start, now)).count();
}

}  // namespace

struct TexelBaker::Impl {
  AssetHashes assets;
  std::list<Rest> held;  ///< the last kHeld: one of every quality
  static constexpr std::size_t kHeld = 3;

  Result<const Rest*> rest(const project::Project& project, const JobContext& job, DiskCache* disk,
                           TexelReport& report) {
    SWARD_ASSIGN(const base::Hash128 key, restKey(project, assets));
    const auto found = std::find_if(held.begin(), held.end(), [&](const Rest& rest) { return rest.key == key; });
    if (found != held.end()) {
      held.splice(held.begin(), held, found);
      report.rest = TexelReport::Rest::Held;
    } else {
      SWARD_ASSIGN(Rest made, newRest(project, key, job, disk, report));
      held.push_front(std::move(made));
      if (held.size() > kHeld) held.resize(kHeld);
    }
    report.restBytes = held.front().storedBytes;
    return &held.front();
  }

  /// From disk, or made and stored there.
  static Result<Rest> newRest(const project::Project& project, const base::Hash128& key, const JobContext& job,
                              DiskCache* disk, TexelReport& report) {
    if (disk != nullptr) {
      const auto payload = disk->get(kRestKind, key);
      auto value = payload ? fromPayload<TexelRest>(*payload) : std::nullopt;
      if (value && fits(*value, project)) {
        report.rest = TexelReport::Rest::FromDisk;
        return heldRest(project, key, std::move(*value), payload->size(), job);
      }
    }
    report.rest = TexelReport::Rest::Made;
    SWARD_ASSIGN(TexelRest made, makeRest(project, job));
    // Loops that were cancelled leave ranges out without saying so.
    if (job.cancelled()) return Error::cancelled();
    const std::vector<std::byte> payload = payloadOf(made);
    // What the disk gives back, whether there is one or not: texels must not depend on it.
    auto stored = fromPayload<TexelRest>(payload);
    if (!stored) {  // values that packing has no codes for, which no valid project should give
      report.warnings.emplace_back("the blades at rest cannot be packed, and are grown anew by the next run");
      return heldRest(project, key, std::move(made), 0, job);
    }
    if (disk != nullptr) {
      if (const auto kept = disk->put(kRestKind, key, payload); !kept.ok()) {
        report.warnings.push_back(kept.error().text());
      }
    }
    return heldRest(project, key, std::move(*stored), payload.size(), job);
  }
};

TexelBaker::TexelBaker() : m_impl(std::make_unique<Impl>()) {}
TexelBaker::~TexelBaker() = default;
TexelBaker::TexelBaker(TexelBaker&&) noexcept = default;
TexelBaker& TexelBaker::operator=(TexelBaker&&) noexcept = default;

Result<std::vector<TexelBake::Level>> texelLevels(wither::Texel finest, const JobContext& job) {
  return makeLevels(std::move(finest), job);
}

wither::TexelGrid texelGridOf(double sideM, double heightM, int columns) {
  constexpr int kBrick = wither::TexelGrid::kBrick;
  // A power of two of bricks, so that levels can halve them as often as the columns: a texel of one level alone would
  // be drawn far away as it is near. Voxels are higher or lower than they are wide by 1.42 at most.
  const double bricks = std::max(heightM / sideM * columns / kBrick, 1.0);
  const double power = std::clamp(std::round(std::log2(bricks)), 0.0, 9.0);
  wither::TexelGrid grid;
  grid.columns = columns;
  grid.layers = kBrick << static_cast<int>(power);
  grid.sideM = sideM;
  grid.heightM = heightM;
  return grid;
}

Result<base::Hash128> TexelBaker::key(const project::Project& project) {
  SWARD_ASSIGN(const base::Hash128 rest, restKey(project, m_impl->assets));
  base::Hasher hasher;
  hasher.add(rest).add(kTexelVersion).add(project.wither.weathering).add(project.wither.mingle.size());
  project::hashValues(hasher, project.wither.body, project::Role::Shape);
  project::hashValues(hasher, project.wither.texel, project::Role::Shape);
  for (const project::Role role : {project::Role::Shape, project::Role::Colour}) {
    project::hashValues(hasher, project.wither.ageing, role);
    project::hashValues(hasher, project.leaf, role);
  }
  for (const wither::MingleSample& sample : project.wither.mingle) {
    project::hashValues(hasher, sample, project::Role::Shape);
  }
  return hasher.finish();
}

Result<std::shared_ptr<const TexelBake>> TexelBaker::texels(const project::Project& project, const JobContext& job,
                                                            TexelReport* report, DiskCache* disk) {
  SWARD_TRY(project::requireValid(project));
  auto start = std::chrono::steady_clock::now();
  TexelReport done;
  SWARD_ASSIGN(const Rest* rest, m_impl->rest(project, job, disk, done));
  done.restSeconds = secondsSince(start);
  SWARD_ASSIGN(const Ageing ageing, ageingOf(project));
  wither::Points moved;
  SWARD_TRY(wither::pose(rest->points, rest->strands, ageing.season, project.wither.mingle, project.wither.weathering,
                         ageing.colour, moved, job));
  scaleByDensity(project, rest->strands, moved);
  SWARD_ASSIGN(wither::Texel finest, wither::pointsToTexel(moved, rest->grid, project.wither.texel.splatVoxels, job));
  moved = {};  // hundreds of megabytes, while levels are made
  done.ageSeconds = secondsSince(start);
  TexelBake bake;
  bake.weathering = project.wither.weathering;
  bake.soil = rest->soil;
  done.points = rest->points.size();
  done.voxels = finest.size();
  SWARD_ASSIGN(bake.levels, makeLevels(std::move(finest), job));
  done.levelSeconds = secondsSince(start);
  for (const TexelBake::Level& level : bake.levels) done.bytes += level.texel->bytes();
  if (report != nullptr) *report = done;
  return std::make_shared<const TexelBake>(std::move(bake));
}

}  // namespace sward::bake
