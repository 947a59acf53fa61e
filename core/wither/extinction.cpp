#include "wither/extinction.h"

#include "trace/voxel_march.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::wither {

double extinction(const Voxel& voxel, const glm::dvec3& l) {
  const auto s = [&](std::size_t i) { return static_cast<double>(voxel.spread[i]); };
  const double around = std::max(static_cast<double>(voxel.density) - (s(0) + s(3) + s(5)), 0.0) / 3.0;
  const glm::dvec3 turned(s(0) * l.x + s(1) * l.y + s(2) * l.z + around * l.x,
                          s(1) * l.x + s(3) * l.y + s(4) * l.z + around * l.y,
                          s(2) * l.x + s(4) * l.y + s(5) * l.z + around * l.z);
  const double trace = s(0) + s(3) + s(5) + 3.0 * around;
  return std::sqrt(std::max(0.625 * trace * glm::dot(l, turned) + 0.375 * glm::dot(turned, turned), 0.0));
}

double opticalDepth(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& direction) {
  if (texel.empty()) return 0.0;
  const TexelGrid& grid = texel.grid();
  // Downward is upward in a grid turned over.
  const bool down = direction.z < 0.0;
  const glm::dvec3 toward(direction.x, direction.y, std::abs(direction.z));
  glm::dvec3 from(origin.x, origin.y, down ? grid.heightM - origin.z : origin.z);
  if (from.z >= grid.heightM) return 0.0;
  if (from.z < 0.0) {
    if (!(toward.z > 0.0)) return 0.0;
    from -= from.z / toward.z * toward;
    from.z = 0.0;
  }
  from.x -= std::floor(from.x / grid.sideM) * grid.sideM;
  from.y -= std::floor(from.y / grid.sideM) * grid.sideM;
  const auto columns = static_cast<std::size_t>(grid.columns);
  return trace::VoxelMarch(grid.columns, grid.layers, grid.voxelM(), toward)
      .depth(from, 0.0, std::numeric_limits<double>::infinity(), [&](std::size_t index) {
        const auto x = static_cast<int>(index % columns), y = static_cast<int>(index / columns % columns);
        const auto z = static_cast<int>(index / columns / columns);
        const Voxel* voxel = texel.at({x, y, down ? grid.layers - 1 - z : z});
        return voxel == nullptr ? 0.0 : extinction(*voxel, direction);
      });
}

double transmittance(const Texel& texel, const glm::dvec3& origin, const glm::dvec3& direction) {
  return std::exp(-opticalDepth(texel, origin, direction));
}

}  // namespace sward::wither
