#include "report/texel_truth.h"

#include "bake/plants.h"
#include "bake/texel_baker.h"
#include "bake/withering.h"
#include "wither/strand.h"
#include "wither/texel_lod.h"
#include "wither/voxelise.h"
#include "wither/withered_model.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sward::report {
namespace {

/// The same texel with the gloss of every voxel at 0.
wither::Texel withoutGloss(const wither::Texel& texel, const JobContext& job) {
  std::vector<std::uint32_t> bricks(texel.stored().size());
  std::vector<std::array<std::uint64_t, 8>> masks(texel.stored().size());
  for (std::size_t place = 0; place < texel.bricks().size(); ++place) {
    const std::int32_t stored = texel.bricks()[place];
    if (stored < 0) continue;
    bricks[static_cast<std::size_t>(stored)] = static_cast<std::uint32_t>(place);
    masks[static_cast<std::size_t>(stored)] = texel.stored()[static_cast<std::size_t>(stored)].mask;
  }
  const auto fill = [&](std::size_t brick, std::span<wither::Voxel> voxels) {
    const auto from = texel.voxels().subspan(texel.stored()[brick].first, voxels.size());
    std::copy(from.begin(), from.end(), voxels.begin());
    for (wither::Voxel& voxel : voxels) voxel.specular = 0.0f;
  };
  return wither::Texel::fromMasks(texel.grid(), bricks, masks, fill, job);
}

std::shared_ptr<const bake::GroundBake> withTexels(const bake::GroundBake& ground, bake::TexelBake texels) {
  bake::GroundBake made = ground;
  made.texels = std::make_shared<const bake::TexelBake>(std::move(texels));
  return std::make_shared<const bake::GroundBake>(std::move(made));
}

/// Of the soil's columns blocks of ratio x ratio, their means.
std::vector<glm::vec3> coarserSoil(const std::vector<glm::vec3>& soil, int columns, int ratio) {
  const int coarse = columns / ratio;
  std::vector<glm::vec3> out(static_cast<std::size_t>(coarse) * static_cast<std::size_t>(coarse), glm::vec3(0.0f));
  const float part = 1.0f / static_cast<float>(ratio * ratio);
  for (int y = 0; y < coarse * ratio; ++y) {
    for (int x = 0; x < coarse * ratio; ++x) {
      out[static_cast<std::size_t>(y / ratio * coarse + x / ratio)] +=
          part * soil[static_cast<std::size_t>(y * columns + x)];
    }
  }
  return out;
}

}  // namespace

Result<scene::Patch> witheredBlades(const project::Project& project) {
  project::Project rest = project;
  rest.wither.weathering = 0.0;
  rest.wither.mingle.clear();
  SWARD_ASSIGN(const scene::Patch patch, bake::growPatch(rest));
  SWARD_ASSIGN(const wither::PatchStrands strands, wither::strandsOf(patch, project.wither, project.patch.seed));
  SWARD_ASSIGN(const bake::Ageing ageing, bake::ageingOf(project));
  return wither::withered(patch, strands, ageing.season, project.wither.mingle, project.wither.weathering,
                          ageing.colour);
}

std::shared_ptr<const bake::GroundBake> coarserGround(const std::shared_ptr<const bake::GroundBake>& ground,
                                                      int columns) {
  const bake::TexelBake& whole = *ground->texels;
  const auto first = std::find_if(whole.levels.begin(), whole.levels.end(),
                                  [columns](const auto& level) { return level.texel->grid().columns == columns; });
  if (first == whole.levels.end()) return nullptr;
  if (first == whole.levels.begin()) return ground;
  bake::TexelBake texels;
  texels.levels.assign(first, whole.levels.end());
  texels.weathering = whole.weathering;
  texels.soil = coarserSoil(whole.soil, whole.grid().columns, whole.grid().columns / texels.grid().columns);
  return withTexels(*ground, std::move(texels));
}

std::shared_ptr<const bake::GroundBake> dullGround(const bake::GroundBake& ground, const JobContext& job) {
  bake::TexelBake texels = *ground.texels;
  for (auto& level : texels.levels) {
    level.texel = std::make_shared<const wither::Texel>(withoutGloss(*level.texel, job));
  }
  return withTexels(ground, std::move(texels));
}

Result<std::shared_ptr<const bake::GroundBake>> voxelisedGround(const bake::GroundBake& ground,
                                                                const scene::Patch& blades, const JobContext& job) {
  SWARD_ASSIGN(const wither::VoxelisedPatch voxels, wither::voxelise(blades, ground.texels->grid(), nullptr, job));
  SWARD_ASSIGN(wither::Texel finest, wither::opaque(voxels.texel, job));
  bake::TexelBake texels;
  SWARD_ASSIGN(texels.levels, bake::texelLevels(std::move(finest), job));
  texels.soil = ground.texels->soil;
  texels.weathering = ground.texels->weathering;
  return withTexels(ground, std::move(texels));
}

TexelBytes bytesOf(const bake::TexelBake& texels) {
  TexelBytes bytes;
  for (const auto& level : texels.levels) {
    bytes.sky += (level.sky.front.size() + level.sky.back.size() + level.sky.ground.size()) * sizeof(float);
    bytes.total += level.texel->bytes();
  }
  bytes.total += bytes.sky + texels.soil.size() * sizeof(glm::vec3);
  return bytes;
}

}  // namespace sward::report
