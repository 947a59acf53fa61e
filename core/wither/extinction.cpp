#include "wither/extinction.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace sward::wither {
namespace {

constexpr int kBrick = TexelGrid::kBrick;
constexpr std::size_t kGrain = 4096;
constexpr double kFlat = 1e-6, kFlatSides = 64.0, kMostSides = 4096.0;

/// A ray in voxels of a texel's grid.
struct Ray {
  glm::dvec3 from, step;  ///< voxels, and voxels a metre

  /// Distance in metres at which the cell [low, low + width) of an axis is left.
  double exit(int axis, double low, double width) const {
    if (step[axis] == 0.0) return std::numeric_limits<double>::infinity();
    return (low + (step[axis] > 0.0 ? width : 0.0) - from[axis]) / step[axis];
  }
};

int nearestAxis(const glm::dvec3& exits) {
  if (exits.x <= exits.y) return exits.x <= exits.z ? 0 : 2;
  return exits.y <= exits.z ? 1 : 2;
}

int wrapped(double cell, int columns) {
  const double side = columns;
  return static_cast<int>(cell - side * std::floor(cell / side));
}

/// What a ray meets in one cell: a voxel's index, or how wide the emptiness around it is.
struct Met {
  std::int64_t voxel = -1;
  double width = 1.0;
};
Met meet(const Texel& texel, const glm::ivec3& at) {
  const int row = texel.grid().columns / kBrick;
  const glm::ivec3 brick = at / kBrick, within = at % kBrick;
  const std::int32_t stored = texel.bricks()[static_cast<std::size_t>((brick.z * row + brick.y) * row + brick.x)];
  if (stored < 0) return {-1, double{kBrick}};
  const Texel::Brick& cells = texel.stored()[static_cast<std::size_t>(stored)];
  const std::uint64_t bit = std::uint64_t{1} << (within.y * kBrick + within.x);
  const auto layer = static_cast<std::size_t>(within.z);
  if ((cells.mask[layer] & bit) == 0) return {};
  std::int64_t index = cells.first;
  for (std::size_t z = 0; z < layer; ++z) index += std::popcount(cells.mask[z]);
  return {index + std::popcount(cells.mask[layer] & (bit - 1)), 1.0};
}

/// The sum of extinction(voxel) times length along a ray that starts within the grid's height.
template <typename Extinction>
double depthAlong(const Texel& texel, const glm::dvec3& from, const glm::dvec3& l, double enough, double farthestM,
                  const Extinction& extinctionOf) {
  const TexelGrid& grid = texel.grid();
  const glm::dvec3 perM = 1.0 / grid.voxelM();
  const Ray ray{from * perM, l * perM};
  glm::dvec3 cell = glm::floor(ray.from);
  for (int axis = 0; axis < 3; ++axis) {
    // A start on a face that the ray leaves downward belongs to the cell below.
    if (ray.step[axis] < 0.0 && cell[axis] == ray.from[axis]) cell[axis] -= 1.0;
  }
  const double across = std::max(std::abs(l.x), std::abs(l.y));
  const double sides = std::abs(l.z) < kFlat ? kFlatSides : kMostSides;
  const double farthest =
      std::min(farthestM, across > 0.0 ? sides * grid.sideM / across : std::numeric_limits<double>::infinity());
  double depth = 0.0, t = 0.0;
  while (cell.z >= 0.0 && cell.z < grid.layers && t < farthest) {
    const glm::ivec3 at(wrapped(cell.x, grid.columns), wrapped(cell.y, grid.columns), static_cast<int>(cell.z));
    const Met met = meet(texel, at);
    const glm::dvec3 low = glm::floor(cell / met.width) * met.width;
    const glm::dvec3 exits(ray.exit(0, low.x, met.width), ray.exit(1, low.y, met.width), ray.exit(2, low.z, met.width));
    const int axis = nearestAxis(exits);
    const double next = std::min(std::max(exits[axis], t), farthest);
    if (!(next < std::numeric_limits<double>::infinity())) break;
    if (met.voxel >= 0) {
      depth += extinctionOf(static_cast<std::size_t>(met.voxel)) * (next - t);
      if (depth >= enough) return depth;
    }
    // Along the axis the next cell is certain; beside it, where a brick was passed, it follows from the place.
    for (int other = 0; other < 3 && met.width > 1.0; ++other) {
      if (other == axis) continue;
      const double at1 = std::floor(ray.from[other] + ray.step[other] * next);
      cell[other] = std::clamp(at1, low[other], low[other] + met.width - 1.0);
    }
    cell[axis] = ray.step[axis] > 0.0 ? low[axis] + met.width : low[axis] - 1.0;
    t = next;
  }
  return depth;
}

/// Where a ray enters the grid's height; nothing when it never does.
std::optional<glm::dvec3> entered(const TexelGrid& grid, const glm::dvec3& origin, const glm::dvec3& l) {
  const double beyond = origin.z < 0.0 ? -origin.z : std::max(origin.z - grid.heightM, 0.0);
  if (beyond == 0.0) return origin;
  const double toward = origin.z < 0.0 ? l.z : -l.z;
  if (!(toward > 0.0)) return std::nullopt;
  glm::dvec3 from = origin + beyond / toward * l;
  from.z = origin.z < 0.0 ? 0.0 : grid.heightM;
  return from;
}

/// Distances of floats are finest near the block: far places are brought there first.
glm::dvec3 inBlock(const TexelGrid& grid, const glm::dvec3& at) {
  return {at.x - std::floor(at.x / grid.sideM) * grid.sideM, at.y - std::floor(at.y / grid.sideM) * grid.sideM, at.z};
}

template <typename Extinction>
double depthFrom(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& l, double enough, double farthestM,
                 const Extinction& extinctionOf) {
  if (texel.empty()) return 0.0;
  const auto from = entered(texel.grid(), origin, l);
  return from ? depthAlong(texel, inBlock(texel.grid(), *from), l, enough, farthestM, extinctionOf) : 0.0;
}

}  // namespace

double extinction(const Voxel& voxel, const glm::dvec3& l) {
  const auto s = [&](std::size_t i) { return static_cast<double>(voxel.spread[i]); };
  const double around = std::max(static_cast<double>(voxel.density) - (s(0) + s(3) + s(5)), 0.0) / 3.0;
  const glm::dvec3 turned(s(0) * l.x + s(1) * l.y + s(2) * l.z + around * l.x,
                          s(1) * l.x + s(3) * l.y + s(4) * l.z + around * l.y,
                          s(2) * l.x + s(4) * l.y + s(5) * l.z + around * l.z);
  const double trace = s(0) + s(3) + s(5) + 3.0 * around;
  return std::sqrt(std::max(0.625 * trace * glm::dot(l, turned) + 0.375 * glm::dot(turned, turned), 0.0));
}

std::array<float, 6> sectionForm(const Voxel& voxel) {
  const std::array<float, 6>& s = voxel.spread;
  const float around = std::max(voxel.density - (s[0] + s[3] + s[5]), 0.0f) / 3.0f;
  const float xx = s[0] + around, yy = s[3] + around, zz = s[5] + around, xy = s[1], xz = s[2], yz = s[4];
  const float five = 0.625f * (xx + yy + zz);
  return {five * xx + 0.375f * (xx * xx + xy * xy + xz * xz), five * xy + 0.375f * (xx * xy + xy * yy + xz * yz),
          five * xz + 0.375f * (xx * xz + xy * yz + xz * zz), five * yy + 0.375f * (xy * xy + yy * yy + yz * yz),
          five * yz + 0.375f * (xy * xz + yy * yz + yz * zz), five * zz + 0.375f * (xz * xz + yz * yz + zz * zz)};
}

double normalShare(const Voxel& voxel) {
  const glm::vec3& n = voxel.normal;
  const std::array<float, 6>& s = voxel.spread;
  if (n == glm::vec3(0.0f) || !(voxel.density > 0.0f)) return 0.0;
  const float form = n.x * n.x * s[0] + n.y * n.y * s[3] + n.z * n.z * s[5] +
                     2.0f * (n.x * n.y * s[1] + n.x * n.z * s[2] + n.y * n.z * s[4]);
  const float trace = s[0] + s[3] + s[5];
  return trace > 0.0f ? static_cast<double>(std::clamp(1.5f * form / trace - 0.5f, 0.0f, 1.0f)) : 0.0;
}

Result<TexelExtinction> TexelExtinction::create(const Texel& texel, const glm::dvec3& l, const JobContext& job) {
  TexelExtinction medium;
  medium.m_extinction.assign(texel.size(), 0.0f);
  const std::span<const Voxel> voxels = texel.voxels();
  base::parallelFor(job, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) medium.m_extinction[i] = static_cast<float>(extinction(voxels[i], l));
  });
  if (job.cancelled()) return Error::cancelled();
  return medium;
}

double opticalDepth(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& direction, double enough) {
  return depthFrom(texel, origin, direction, enough, std::numeric_limits<double>::infinity(),
                   [&](std::size_t voxel) { return extinction(texel.voxels()[voxel], direction); });
}

double opticalDepth(const Texel& texel, const TexelExtinction& medium, const glm::dvec3& origin,
                    const glm::dvec3& direction, double enough, double farthestM) {
  return depthFrom(texel, origin, direction, enough, farthestM,
                   [&](std::size_t voxel) { return double{medium[voxel]}; });
}

double transmittance(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& direction) {
  return std::exp(-opticalDepth(texel, origin, direction));
}

}  // namespace sward::wither
