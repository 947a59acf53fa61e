#include "bake/texel_baker.h"

#include "bake/plants.h"
#include "bake/soil.h"
#include "wither/voxelise.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace sward::bake {

struct TexelBaker::Impl {};

TexelBaker::TexelBaker() : m_impl(std::make_unique<Impl>()) {}
TexelBaker::~TexelBaker() = default;
TexelBaker::TexelBaker(TexelBaker&&) noexcept = default;
TexelBaker& TexelBaker::operator=(TexelBaker&&) noexcept = default;

wither::TexelGrid texelGridOf(double sideM, double heightM, int columns) {
  constexpr int kBrick = wither::TexelGrid::kBrick;
  const double bricks = heightM / sideM * columns / kBrick;
  wither::TexelGrid grid;
  grid.columns = columns;
  grid.layers = kBrick * std::clamp(static_cast<int>(std::ceil(bricks)), 1, 4096 / kBrick);
  grid.sideM = sideM;
  grid.heightM = heightM;
  return grid;
}

Result<std::shared_ptr<const TexelBake>> TexelBaker::texels(const project::Project& project, int columns,
                                                            const JobContext& job, TexelReport* report) {
  const int side = columns > 0 ? columns : project.wither.texel.resolution;
  SWARD_ASSIGN(const scene::Patch patch, growPatch(project));
  const wither::TexelGrid grid = texelGridOf(patch.sideM, patch.heightM, side);
  SWARD_ASSIGN(wither::VoxelisedPatch rest, wither::voxelise(patch, grid, nullptr, job));
  TexelBake bake;
  auto texel = std::make_shared<const wither::Texel>(std::move(rest.texel));
  SWARD_ASSIGN(wither::TexelSky sky, wither::marchedSky(*texel, job));
  bake.levels.push_back({texel, std::move(sky)});
  SWARD_ASSIGN(bake.soil, soilColours(project, side));
  if (report) report->voxels = texel->size();
  return std::make_shared<const TexelBake>(std::move(bake));
}

}  // namespace sward::bake
