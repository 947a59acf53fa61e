#pragma once

#include "trace/fast_floor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

namespace sward::trace {

/// Ways through a periodic grid of voxels toward one light: sums of extinction times length, with the exact length in
/// every voxel (Amanatides and Woo 1987).
class VoxelMarch {
 public:
  /// `voxelM` a voxel's size in metres; `light` a unit vector, z >= 0.
  VoxelMarch(int columns, int layers, const glm::dvec3& voxelM, const glm::dvec3& light);

  /// Optical depth from a point (metres; x and y are wrapped, z is moved into the grid's height), without its first
  /// `leadM` metres, until above the grid, or at least `enough`, or after as many borders of patches as shadow rays
  /// pass (occlusion.h). extinction(voxel) is that toward the light, 1/m, of the voxel of index (z * columns + y) *
  /// columns + x.
  template <typename Extinction>
  double depth(const glm::dvec3& from, double leadM, double enough, const Extinction& extinction) const {
    const glm::dvec3 at = from * m_voxelsPerMetre;
    const glm::dvec3 floor = glm::floor(at);
    int cell[3] = {wrapped(static_cast<int>(floor.x), m_columns), wrapped(static_cast<int>(floor.y), m_columns),
                   std::clamp(static_cast<int>(floor.z), 0, m_layers - 1)};
    double next[3];  // metres along the way to the next border of each axis
    for (int axis = 0; axis < 3; ++axis) {
      const double inside = std::clamp(at[axis] - (axis == 2 ? static_cast<double>(cell[2]) : floor[axis]), 0.0, 1.0);
      next[axis] =
          std::isfinite(m_metres[axis]) ? (m_step[axis] > 0 ? 1.0 - inside : inside) * m_metres[axis] : m_metres[axis];
    }
    const auto row = static_cast<std::size_t>(m_columns), plane = row * row;
    double travelled = leadM, depth = 0.0;
    for (int borders = 0; depth < enough;) {
      const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
      if (next[axis] > travelled) {
        const std::size_t voxel = static_cast<std::size_t>(cell[2]) * plane + static_cast<std::size_t>(cell[1]) * row +
                                  static_cast<std::size_t>(cell[0]);
        depth += (next[axis] - travelled) * static_cast<double>(extinction(voxel));
        travelled = next[axis];
      }
      next[axis] += m_metres[axis];
      cell[axis] += m_step[axis];
      if (axis == 2) {
        if (cell[2] >= m_layers) break;
      } else if (cell[axis] < 0 || cell[axis] >= m_columns) {
        cell[axis] = cell[axis] < 0 ? m_columns - 1 : 0;
        if (++borders > m_mostBorders) break;
      }
    }
    return depth;
  }

 private:
  int m_columns, m_layers;
  glm::dvec3 m_voxelsPerMetre;
  glm::dvec3 m_metres;  ///< along the way from one border of each axis to the next
  glm::ivec3 m_step;
  int m_mostBorders;
};

}  // namespace sward::trace
