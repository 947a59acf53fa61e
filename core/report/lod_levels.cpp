#include "report/lod_levels.h"

#include "base/parallel.h"
#include "base/random.h"
#include "trace/occlusion.h"
#include "wither/extinction.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace sward::report {
namespace {

constexpr std::uint64_t kSeed = 0x6c6f64;  // "lod"
constexpr double kDeep = 16.0;             ///< depths beyond let 1e-7 through
constexpr std::size_t kGrain = 2048;

/// A place over cell i of side x side cells, in metres.
glm::dvec3 startOf(std::size_t i, int side, double sideM, double heightM) {
  base::Random random(base::mix64(kSeed, i, static_cast<std::uint64_t>(side)));
  const auto cells = static_cast<std::size_t>(side);
  const double x = random.uniform(), y = random.uniform();
  const double step = sideM / side;
  // Most of the variance is the height's: steps of the golden ratio are even over it, and over neighbouring cells.
  const double up = static_cast<double>(i) * 0.6180339887498949;
  return {step * (static_cast<double>(i % cells) + x), step * (static_cast<double>(i / cells) + y),
          heightM * (up - std::floor(up))};
}

/// `range(begin, end, value)` gives the transmittance of rays [begin, end) of one direction.
using Range = std::function<void(std::size_t begin, std::size_t end, double* value)>;

void addDirection(std::size_t count, const Range& range, const JobContext& job, LetThrough& out) {
  std::vector<double> values(count);
  base::parallelFor(job, count, kGrain,
                    [&](std::size_t begin, std::size_t end) { range(begin, end, values.data() + begin); });
  double sum = 0.0, squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(count);
  out.mean.push_back(sum / n);
  out.error.push_back(std::sqrt(std::max(squares / n - sum / n * sum / n, 0.0) / n));
}

}  // namespace

Result<wither::Texel> meanDensityHalved(const wither::Texel& texel) {
  wither::TexelGrid grid = texel.grid();
  grid.columns /= 2;
  grid.layers /= 2;
  std::vector<std::int32_t> index(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.columns) *
                                      static_cast<std::size_t>(grid.layers),
                                  -1);
  std::vector<wither::Texel::Entry> entries;
  const auto row = static_cast<std::size_t>(grid.columns);
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::ivec3 at = glm::ivec3(texel.places()[i]) / 2;
    std::int32_t& known = index[(static_cast<std::size_t>(at.z) * row + static_cast<std::size_t>(at.y)) * row +
                                static_cast<std::size_t>(at.x)];
    if (known < 0) {
      known = static_cast<std::int32_t>(entries.size());
      entries.push_back({at, {}});
    }
    wither::Voxel& sum = entries[static_cast<std::size_t>(known)].voxel;
    const wither::Voxel& child = texel.voxels()[i];
    sum.density += child.density / 8.0f;
    for (std::size_t k = 0; k < sum.spread.size(); ++k) sum.spread[k] += child.spread[k] / 8.0f;
  }
  return wither::Texel::fromEntries(grid, std::move(entries));
}

Result<LetThrough> marchedThrough(const wither::Texel& texel, const std::vector<glm::dvec3>& directions, int side,
                                  const JobContext& job) {
  LetThrough out;
  const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  for (const glm::dvec3& l : directions) {
    SWARD_ASSIGN(const auto medium, wither::TexelExtinction::create(texel, l, job));
    const Range range = [&](std::size_t begin, std::size_t end, double* value) {
      for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3 from = startOf(i, side, texel.grid().sideM, texel.grid().heightM);
        *value++ = std::exp(-wither::opticalDepth(texel, medium, from, l, kDeep));
      }
    };
    addDirection(count, range, job, out);
    if (job.cancelled()) return Error::cancelled();
  }
  return out;
}

Result<LetThrough> tracedThrough(const trace::PatchScene& scene, const std::vector<glm::dvec3>& directions, int side,
                                 const JobContext& job) {
  LetThrough out;
  const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const double sideM = scene.patch().sideM;
  // Below the patch's own side as a float, which a rounded place could reach.
  const auto inside = [&](double v) {
    return std::min(static_cast<float>(v), static_cast<float>(sideM * (1.0 - 1e-6)));
  };
  for (const glm::dvec3& l : directions) {
    const Range range = [&](std::size_t begin, std::size_t end, double* value) {
      trace::OcclusionBatch batch;
      for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec3 from = startOf(i, side, sideM, scene.patch().heightM);
        batch.add({inside(from.x), inside(from.y), static_cast<float>(from.z)}, static_cast<std::uint32_t>(i));
      }
      batch.trace(scene.impl(), l);
      for (std::size_t i = 0; i < end - begin; ++i) value[i] = batch.occluded(i) ? 0.0 : 1.0;
    };
    addDirection(count, range, job, out);
    if (job.cancelled()) return Error::cancelled();
  }
  return out;
}

}  // namespace sward::report
