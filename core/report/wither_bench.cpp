#include "report/wither_bench.h"

#include "leaf/ageing.h"
#include "wither/cones.h"
#include "wither/extinction.h"
#include "wither/leaf_ageing.h"
#include "wither/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sward::report {
namespace {

constexpr int kCell = 8;  ///< columns along a cell
constexpr int kFine = 4;  ///< rays a column along x, under 45 degrees

/// Optical depths of rays that rise from the ground, one a column: [y][x].
std::vector<double> depthsAbove(const wither::Texel& texel) {
  const auto row = static_cast<std::size_t>(texel.grid().columns);
  std::vector<double> depths(row * row, 0.0);
  const double length = texel.grid().voxelM().z;
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::u16vec3 at = texel.places()[i];
    depths[at.y * row + at.x] += length * wither::extinction(texel.voxels()[i], {0.0, 0.0, 1.0});
  }
  return depths;
}

/// The same along (1, 0, 1), kFine a column along x: such a ray stays in its row y, and passes a voxel on a chord that
/// its start says, so that going through the voxels once is enough.
std::vector<double> depthsTilted(const wither::Texel& texel) {
  constexpr double kDiagonal = std::numbers::sqrt2;
  const glm::dvec3 size = texel.grid().voxelM();
  const int row = texel.grid().columns * kFine;
  const double step = size.x / kFine;
  std::vector<double> depths(static_cast<std::size_t>(texel.grid().columns) * static_cast<std::size_t>(row), 0.0);
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::u16vec3 at = texel.places()[i];
    const double sigma = wither::extinction(texel.voxels()[i], glm::dvec3(1.0, 0.0, 1.0) / kDiagonal);
    const double x = at.x * size.x, z = at.z * size.z;
    const int first = static_cast<int>(std::floor((x - z - size.z) / step));
    const int last = static_cast<int>(std::ceil((x + size.x - z) / step));
    for (int ray = first; ray <= last; ++ray) {
      const double from = (ray + 0.5) * step;  // x = from + z along the ray
      const double chord = std::min(z + size.z, x + size.x - from) - std::max(z, x - from);
      if (!(chord > 0.0)) continue;
      const int wrapped = (ray % row + row) % row;
      depths[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(row) + static_cast<std::size_t>(wrapped)] +=
          kDiagonal * chord * sigma;
    }
  }
  return depths;
}

/// Mean opacity of cells from the depths of `fine` rays a column along x.
std::vector<double> cellsOf(const std::vector<double>& depths, int columns, int fine) {
  const int cells = columns / kCell, row = columns * fine;
  std::vector<double> opacity(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells), 0.0);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const int x = static_cast<int>(i) % row / (kCell * fine), y = static_cast<int>(i) / row / kCell;
    opacity[static_cast<std::size_t>(y * cells + x)] -= std::expm1(-depths[i]) / (kCell * kCell * fine);
  }
  return opacity;
}

}  // namespace

Result<WitherBench> WitherBench::create(int blades, int resolution, std::uint64_t seed, const JobContext& job) {
  wither::ConeOptions cones;
  cones.count = blades;
  WitherBench bench;
  bench.m_patch = wither::growCones(cones, seed);
  bench.m_grid = {resolution, resolution, cones.sideM, cones.heightM};
  SWARD_ASSIGN(bench.m_strands, wither::strandsOf(bench.m_patch, wither::WitherOptions{}, seed));
  SWARD_ASSIGN(bench.m_rest, wither::voxelise(bench.m_patch, bench.m_grid, &bench.m_strands, job));
  SWARD_ASSIGN(bench.m_season, wither::Season::create({}, {}));
  SWARD_ASSIGN(const leaf::AgeingColours colours, leaf::AgeingColours::build({}));
  bench.m_colour = wither::ageColour(colours);
  return bench;
}

Result<WitherBench> WitherBench::together(const std::vector<const WitherBench*>& parts, const JobContext& job) {
  if (parts.empty()) return Error::badInput("there are no parts", "wither bench", "Give at least one.");
  WitherBench bench = *parts.front();
  for (std::size_t p = 1; p < parts.size(); ++p) {
    const WitherBench& part = *parts[p];
    const auto models = static_cast<std::uint32_t>(bench.m_patch.models.size());
    const auto strands = static_cast<std::uint32_t>(bench.m_strands.strands.size());
    for (const auto& model : part.m_patch.models) bench.m_patch.models.push_back(model);
    for (scene::Instance instance : part.m_patch.instances) {
      instance.model += models;
      bench.m_patch.instances.push_back(instance);
    }
    for (const wither::Strands& model : part.m_strands.models) bench.m_strands.models.push_back(model);
    for (wither::Strand strand : part.m_strands.strands) {
      strand.sample = static_cast<int>(p);
      bench.m_strands.strands.push_back(std::move(strand));
    }
    for (const std::uint32_t first : part.m_strands.firstStrand) bench.m_strands.firstStrand.push_back(strands + first);
  }
  SWARD_ASSIGN(bench.m_rest, wither::voxelise(bench.m_patch, bench.m_grid, &bench.m_strands, job));
  return bench;
}

Result<wither::Points> WitherBench::points(double proportion, std::uint64_t seed, const JobContext& job) const {
  return wither::texelToPoints(m_rest.texel, m_rest.attachments, m_strands.strands, proportion, seed, job);
}

Result<wither::Texel> WitherBench::texel(const wither::Points& points, double weathering,
                                         std::span<const wither::MingleSample> samples, const JobContext& job) const {
  wither::Points moved;
  SWARD_TRY(wither::pose(points, m_strands.strands, m_season, samples, weathering, m_colour, moved, job));
  return wither::pointsToTexel(moved, m_grid, wither::TexelOptions{}.splatVoxels, job);
}

Result<wither::Texel> WitherBench::paperTexel(const wither::Points& points, double weathering,
                                              const JobContext& job) const {
  wither::Points moved;
  SWARD_TRY(wither::paperPose(points, m_strands.strands, m_season, {}, weathering, moved, job));
  return wither::pointsToTexel(moved, m_grid, wither::TexelOptions{}.splatVoxels, job);
}

Result<wither::Texel> WitherBench::direct(double weathering, const JobContext& job) const {
  SWARD_ASSIGN(const scene::Patch bent, wither::withered(m_patch, m_strands, m_season, {}, weathering, m_colour));
  SWARD_ASSIGN(wither::VoxelisedPatch voxels, wither::voxelise(bent, m_grid, nullptr, job));
  return std::move(voxels.texel);
}

double Cover::mean(std::size_t view) const {
  double sum = 0.0;
  for (const double value : opacity[view]) sum += value;
  return opacity[view].empty() ? 0.0 : sum / static_cast<double>(opacity[view].size());
}

Cover coverOf(const wither::Texel& texel) {
  Cover cover;
  cover.cells = texel.grid().columns / kCell;
  cover.opacity[0] = cellsOf(depthsAbove(texel), texel.grid().columns, 1);
  cover.opacity[1] = cellsOf(depthsTilted(texel), texel.grid().columns, kFine);
  double weights = 0.0;
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const auto weight = static_cast<double>(texel.voxels()[i].density);
    cover.meanHeightM += weight * (texel.places()[i].z + 0.5) * texel.grid().voxelM().z;
    weights += weight;
  }
  if (weights > 0.0) cover.meanHeightM /= weights;
  cover.areaM2 = texel.areaM2();
  return cover;
}

CoverError coverError(const Cover& cover, const Cover& truth) {
  CoverError error;
  for (std::size_t view = 0; view < Cover::kViews; ++view) {
    const auto& a = cover.opacity[view];
    const auto& b = truth.opacity[view];
    const std::size_t count = std::min(a.size(), b.size());
    for (std::size_t i = 0; i < count; ++i) {
      const double difference = a[i] - b[i];
      error.rmse[view] += difference * difference;
      error.bias[view] += difference;
      error.max[view] = std::max(error.max[view], std::abs(difference));
    }
    if (count == 0) continue;
    error.rmse[view] = std::sqrt(error.rmse[view] / static_cast<double>(count));
    error.bias[view] /= static_cast<double>(count);
  }
  if (truth.areaM2 > 0.0) error.area = cover.areaM2 / truth.areaM2 - 1.0;
  error.meanHeightM = cover.meanHeightM - truth.meanHeightM;
  return error;
}

}  // namespace sward::report
