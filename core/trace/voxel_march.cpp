#include "trace/voxel_march.h"

#include "base/check.h"
#include "trace/occlusion.h"

#include <limits>

namespace sward::trace {

VoxelMarch::VoxelMarch(int columns, int layers, const glm::dvec3& voxelM, const glm::dvec3& light)
    : m_columns(columns), m_layers(layers), m_voxelsPerMetre(1.0 / voxelM) {
  SWARD_CHECK_GT(columns, 0);
  SWARD_CHECK_GT(layers, 0);
  SWARD_CHECK_GE(light.z, 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    m_step[axis] = light[axis] > 0.0 ? 1 : -1;
    // Along an axis on which the light moves less than a voxel in a million patches there are no borders.
    const bool moves = std::abs(light[axis]) > 1e-12;
    m_metres[axis] = moves ? voxelM[axis] / std::abs(light[axis]) : std::numeric_limits<double>::infinity();
  }
  m_mostBorders = light.z < kHorizontal ? kMaxHorizontalCrossings : kMaxCrossings;
}

}  // namespace sward::trace
