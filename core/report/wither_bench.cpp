#include "report/wither_bench.h"

#include "base/parallel.h"
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
constexpr int kRays = 4;  ///< along a cell
constexpr double kDeep = 30.0;

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

Result<Cover> coverOf(const wither::Texel& texel, const JobContext& job) {
  const std::array<glm::dvec3, Cover::kViews> views{
      glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(std::numbers::sqrt2 / 2.0, 0.0, std::numbers::sqrt2 / 2.0)};
  Cover cover;
  cover.cells = std::max(texel.grid().columns / kCell, 1);
  const auto cells = static_cast<std::size_t>(cover.cells);
  const double step = texel.grid().sideM / (cover.cells * kRays);
  for (std::size_t view = 0; view < views.size(); ++view) {
    SWARD_ASSIGN(const auto medium, wither::TexelExtinction::create(texel, views[view], job));
    std::vector<double>& opacity = cover.opacity[view];
    opacity.assign(cells * cells, 0.0);
    base::parallelFor(job, cells * cells, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec2 corner(static_cast<double>(i % cells * kRays), static_cast<double>(i / cells * kRays));
        for (int ray = 0; ray < kRays * kRays; ++ray) {
          const glm::dvec2 at = step * (corner + glm::dvec2(ray % kRays + 0.5, ray / kRays + 0.5));
          const double depth = wither::opticalDepth(texel, medium, {at, 0.0}, views[view], kDeep);
          opacity[i] -= std::expm1(-depth) / (kRays * kRays);
        }
      }
    });
  }
  if (job.cancelled()) return Error::cancelled();
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
