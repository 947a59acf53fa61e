#include "wither/points.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>

namespace sward::wither {
namespace {

constexpr int kBrick = TexelGrid::kBrick;
constexpr std::size_t kGrain = 2048;
constexpr std::size_t kBricksAtOnce = 64;
constexpr int kLargestReach = 2;
constexpr int kWidth = 2 * kLargestReach + 1;
constexpr std::size_t kValues = 20;
// Products of three weights and of the least area stay in the range of floats, so that every voxel can be divided by.
constexpr double kLeastWeight = 1e-7;
constexpr float kLeastArea = 1e-12f;  // of the largest: all that is left out is a millionth of a millionth a point
constexpr float kCancelled = 1e-3f;   // of the weight: directions that leave less have cancelled

/// Where a point goes along one axis: voxels first .. first + count - 1 (before repetition), weights that sum to 1.
struct Stretch {
  std::int32_t first = 0, count = 0;
  std::array<float, kWidth> weights{};
};
struct Splat {
  std::array<Stretch, 3> axes;
};

/// Gaussian of sigma voxels about `at` (in voxels) over the voxel it lies in and `reach` beside it; with `bound`, what
/// lies outside [0, size) takes no weight. The product over the axes is the three-dimensional Gaussian, and so is that
/// of their sums. exp(-(d - k)^2 / 2 sigma^2) over that of k = 0 is c^(k^2) q^k: two exponentials serve all weights.
Stretch stretch(double at, int size, double sigma, int reach, bool bound) {
  const double cell = std::floor(at), d = at - cell - 0.5;
  const double c = std::exp(-0.5 / (sigma * sigma)), q = std::exp(d / (sigma * sigma));
  const std::array<double, kWidth> all{c * c * c * c / (q * q), c / q, 1.0, c * q, c * c * c * c * q * q};
  const auto middle = static_cast<std::int32_t>(cell);
  const auto weight = [&](std::int32_t i) { return all[static_cast<std::size_t>(i - middle + kLargestReach)]; };
  std::int32_t first = bound ? std::max(middle - reach, 0) : middle - reach;
  std::int32_t last = bound ? std::min(middle + reach, size - 1) : middle + reach;
  while (weight(first) < kLeastWeight) ++first;  // that of the middle is 1
  while (weight(last) < kLeastWeight) --last;
  double sum = 0.0;
  for (std::int32_t i = first; i <= last; ++i) sum += weight(i);
  Stretch result{first, last - first + 1, {}};
  for (std::int32_t i = first; i <= last; ++i) {
    result.weights[static_cast<std::size_t>(i - first)] = static_cast<float>(weight(i) / sum);
  }
  return result;
}

Splat splatOf(const glm::vec3& position, const TexelGrid& grid, double sigma, int reach) {
  const glm::dvec3 edge = grid.voxelM();
  Splat splat;
  for (int c = 0; c < 2; ++c) {
    const double turns = static_cast<double>(position[c]) / grid.sideM;
    const double at = (turns - std::floor(turns)) * grid.columns;
    splat.axes[static_cast<std::size_t>(c)] =
        stretch(std::min(at, grid.columns - 1e-9), grid.columns, sigma, reach, false);
  }
  const double height = std::clamp(static_cast<double>(position.z) / edge.z, 0.0, grid.layers - 1e-9);
  splat.axes[2] = stretch(height, grid.layers, sigma, reach, true);
  return splat;
}

/// Numbers of the bricks along an axis that a stretch touches: one or two, or, where the block is one brick wide, one.
struct Touched {
  std::array<int, 2> bricks{};
  int count = 0;
};
Touched touched(const Stretch& stretch, int size) {
  const auto brickOf = [size](std::int32_t voxel) { return ((voxel + size) % size) / kBrick; };
  const int first = brickOf(stretch.first), last = brickOf(stretch.first + stretch.count - 1);
  return {{first, last}, first == last ? 1 : 2};
}

template <typename Visit>
void forBricks(const Splat& splat, const TexelGrid& grid, const Visit& visit) {
  const Touched x = touched(splat.axes[0], grid.columns), y = touched(splat.axes[1], grid.columns);
  const Touched z = touched(splat.axes[2], grid.layers);
  const int row = grid.brickRow();
  for (int k = 0; k < z.count; ++k) {
    for (int j = 0; j < y.count; ++j) {
      for (int i = 0; i < x.count; ++i) {
        visit(static_cast<std::size_t>(
            (z.bricks[static_cast<std::size_t>(k)] * row + y.bricks[static_cast<std::size_t>(j)]) * row +
            x.bricks[static_cast<std::size_t>(i)]));
      }
    }
  }
}

/// Points by the bricks that they touch, in their own order.
struct Buckets {
  std::vector<std::uint32_t> bricks;  ///< those that are touched, rising
  std::vector<std::uint32_t> first;   ///< one a touched brick and one more
  std::vector<std::uint32_t> points;
};

/// Points of less than `leastArea` are left out.
Buckets bucket(std::span<const Splat> splats, std::span<const float> areas, float leastArea, const TexelGrid& grid) {
  std::vector<std::uint32_t> next(grid.brickCount(), 0);
  for (std::size_t i = 0; i < splats.size(); ++i) {
    if (areas[i] >= leastArea) forBricks(splats[i], grid, [&](std::size_t brick) { ++next[brick]; });
  }
  Buckets buckets;
  std::uint32_t sum = 0;
  for (std::size_t brick = 0; brick < next.size(); ++brick) {
    if (next[brick] == 0) continue;
    buckets.bricks.push_back(static_cast<std::uint32_t>(brick));
    buckets.first.push_back(sum);
    const std::uint32_t count = next[brick];
    next[brick] = sum;
    sum += count;
  }
  buckets.first.push_back(sum);
  buckets.points.resize(sum);
  for (std::uint32_t i = 0; i < splats.size(); ++i) {
    if (areas[i] < leastArea) continue;
    forBricks(splats[i], grid, [&](std::size_t brick) { buckets.points[next[brick]++] = i; });
  }
  return buckets;
}

using Values = std::array<float, kValues>;

/// What a point adds to a voxel, for a weight of 1: area (in `unit`), area times attributes, area times spread.
Values valuesOf(const Points& points, std::size_t i, float unit) {
  const float area = points.areaM2[i] / unit;
  const glm::vec3 n = area * points.normals[i], t = area * points.tangents[i];
  const glm::vec3 d = area * points.diffuse[i], m = area * points.transmitted[i];
  const std::array<float, 6>& s = points.spread[i];
  return {area,        n.x,         n.y,         n.z,         t.x,         t.y,        t.z,
          d.x,         d.y,         d.z,         m.x,         m.y,         m.z,        area * points.specular[i],
          area * s[0], area * s[1], area * s[2], area * s[3], area * s[4], area * s[5]};
}

glm::vec3 direction(const glm::vec3& sum, float weight) {
  const float length = glm::length(sum);
  return length > kCancelled * weight ? sum / length : glm::vec3(0.0f);
}

Voxel voxelOf(const Values& v, float perVolume) {
  Voxel voxel;
  voxel.density = std::max(v[0] * perVolume, std::numeric_limits<float>::min());
  voxel.normal = direction({v[1], v[2], v[3]}, v[0]);
  voxel.tangent = direction({v[4], v[5], v[6]}, v[0]);
  voxel.diffuse = glm::vec3(v[7], v[8], v[9]) / v[0];
  voxel.transmitted = glm::vec3(v[10], v[11], v[12]) / v[0];
  voxel.specular = v[13] / v[0];
  for (std::size_t k = 0; k < 6; ++k) voxel.spread[k] = v[14 + k] * perVolume;
  return voxel;
}

/// Where a splat's voxels lie in one brick, axis by axis; -1: in another.
using Within = std::array<std::array<int, kWidth>, 3>;

Within withinBrick(const Splat& splat, const glm::ivec3& origin, const TexelGrid& grid) {
  Within within;
  for (std::size_t c = 0; c < 3; ++c) {
    const int size = c < 2 ? grid.columns : grid.layers;
    for (std::int32_t i = 0; i < splat.axes[c].count; ++i) {
      int voxel = splat.axes[c].first + i;
      voxel += voxel < 0 ? size : voxel >= size ? -size : 0;
      voxel -= origin[static_cast<int>(c)];
      within[c][static_cast<std::size_t>(i)] = voxel >= 0 && voxel < kBrick ? voxel : -1;
    }
  }
  return within;
}

/// One bit a voxel, one word a layer.
using Mask = std::array<std::uint64_t, kBrick>;

void addTo(Mask& mask, const Splat& splat, const Within& within) {
  std::uint64_t row = 0, layer = 0;
  for (std::int32_t i = 0; i < splat.axes[0].count; ++i) {
    const int x = within[0][static_cast<std::size_t>(i)];
    row |= x < 0 ? 0 : std::uint64_t{1} << x;
  }
  for (std::int32_t j = 0; j < splat.axes[1].count; ++j) {
    const int y = within[1][static_cast<std::size_t>(j)];
    layer |= y < 0 ? 0 : row << (y * kBrick);
  }
  for (std::int32_t k = 0; k < splat.axes[2].count; ++k) {
    const int z = within[2][static_cast<std::size_t>(k)];
    if (z >= 0) mask[static_cast<std::size_t>(z)] |= layer;
  }
}

/// The sums of one brick's voxels; between bricks all are 0.
using BrickSums = std::array<Values, kBrick * kBrick * kBrick>;

void addTo(BrickSums& sums, const Splat& splat, const Within& within, const Values& values) {
  const auto count = [&](std::size_t c) { return static_cast<std::size_t>(splat.axes[c].count); };
  for (std::size_t k = 0; k < count(2); ++k) {
    if (within[2][k] < 0) continue;
    for (std::size_t j = 0; j < count(1); ++j) {
      if (within[1][j] < 0) continue;
      const float rowWeight = splat.axes[2].weights[k] * splat.axes[1].weights[j];
      const auto row = static_cast<std::size_t>((within[2][k] * kBrick + within[1][j]) * kBrick);
      for (std::size_t i = 0; i < count(0); ++i) {
        if (within[0][i] < 0) continue;
        Values& sum = sums[row + static_cast<std::size_t>(within[0][i])];
        const float weight = rowWeight * splat.axes[0].weights[i];
        for (std::size_t v = 0; v < kValues; ++v) sum[v] += weight * values[v];
      }
    }
  }
}

/// Sets the voxels of the mask in their order and empties the sums.
void emit(BrickSums& sums, const Mask& mask, float perVolume, std::span<Voxel> voxels) {
  std::size_t next = 0;
  for (std::size_t z = 0; z < kBrick; ++z) {
    for (std::uint64_t left = mask[z]; left != 0; left &= left - 1) {
      Values& sum = sums[z * kBrick * kBrick + static_cast<std::size_t>(std::countr_zero(left))];
      voxels[next++] = voxelOf(sum, perVolume);
      sum.fill(0.0f);
    }
  }
}

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> check(const Points& points, float perVolume) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool sound =
        finite(points.positions[i]) && finite(points.normals[i]) && finite(points.tangents[i]) &&
        finite(points.diffuse[i]) && finite(points.transmitted[i]) && std::isfinite(points.specular[i]) &&
        std::all_of(points.spread[i].begin(), points.spread[i].end(), [](float s) { return std::isfinite(s); });
    if (sound && points.areaM2[i] >= 0.0f && std::isfinite(points.areaM2[i] * perVolume)) continue;
    return Error::badInput("point " + std::to_string(i) + " has a value that is no number, or no leaf area", "points",
                           "Check what the points were made from.");
  }
  return {};
}

}  // namespace

Result<Texel> pointsToTexel(const Points& points, const TexelGrid& grid, double sigmaVoxels, const JobContext& job) {
  SWARD_TRY(checkGrid(grid));
  const auto perVolume = static_cast<float>(1.0 / grid.voxelVolumeM3());
  SWARD_TRY(check(points, perVolume));
  const double sigma = sigmaVoxels > 0.1 ? std::min(sigmaVoxels, 100.0) : 0.1;
  const int reach = sigma > 0.7 ? 2 : 1;
  std::vector<Splat> splats(points.size());
  base::parallelFor(job, points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) splats[i] = splatOf(points.positions[i], grid, sigma, reach);
  });
  if (job.cancelled()) return Error::cancelled();
  float unit = 0.0f;
  for (const float area : points.areaM2) unit = std::max(unit, area);
  const float least = unit > 0.0f ? std::max(kLeastArea * unit, std::numeric_limits<float>::min()) : 1.0f;
  const Buckets buckets = bucket(splats, points.areaM2, least, grid);
  const auto originOf = [&](std::size_t b) {
    const auto brick = static_cast<int>(buckets.bricks[b]);
    const int row = grid.brickRow();
    return kBrick * glm::ivec3(brick % row, brick / row % row, brick / row / row);
  };
  std::vector<Mask> masks(buckets.bricks.size(), Mask{});
  base::parallelFor(job, masks.size(), kBricksAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      for (std::uint32_t k = buckets.first[b]; k < buckets.first[b + 1]; ++k) {
        const Splat& splat = splats[buckets.points[k]];
        addTo(masks[b], splat, withinBrick(splat, originOf(b), grid));
      }
    }
  });
  if (job.cancelled()) return Error::cancelled();
  const auto fill = [&](std::size_t b, std::span<Voxel> voxels) {
    static thread_local const std::unique_ptr<BrickSums> sums = std::make_unique<BrickSums>();  // 40 kB, kept at 0
    const glm::ivec3 origin = originOf(b);
    for (std::uint32_t k = buckets.first[b]; k < buckets.first[b + 1]; ++k) {
      const std::uint32_t i = buckets.points[k];
      addTo(*sums, splats[i], withinBrick(splats[i], origin, grid), valuesOf(points, i, unit));
    }
    emit(*sums, masks[b], unit * perVolume, voxels);
  };
  Texel texel = Texel::fromMasks(grid, buckets.bricks, masks, fill, job);
  if (job.cancelled()) return Error::cancelled();
  return texel;
}

}  // namespace sward::wither
