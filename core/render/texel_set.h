#pragma once

#include "base/job.h"
#include "base/result.h"
#include "bake/texel_bake.h"
#include "gpu/objects.h"
#include "wither/texel_light.h"

#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::render {

/// The levels of a texel as shaders/texels/march.frag reads them. Of all levels in one:
///   bricks  [level][z][y][x] where the brick's 512 words start in `voxels`; -1: empty
///   voxels  index into `leaves`, from 1; 0: empty
///   leaves  four words a voxel: normal | tangent << 16 (octahedral, two bytes each), radiance on the normal's side,
///           on the other (10 bits a channel, the square root over radianceRange), density (square root over
///           densityRange) | share of the normal << 8 | highlight times sunlight << 16, a byte each
///   soil    lit soil of level 0's columns, as the radiances are kept
class TexelSet {
 public:
  /// Uploads what no light changes. Errors: more voxels than indices or the GPU hold.
  static Result<TexelSet> create(std::shared_ptr<const bake::TexelBake> bake);
  /// Lights all levels on the processor and uploads them.
  Result<void> relight(const wither::TexelLight& light, const JobContext& job);

  const bake::TexelBake& bake() const { return *m_bake; }
  const std::vector<int>& levelStarts() const { return m_levelStarts; }  ///< in `bricks`
  double densityRange() const { return m_densityRange; }
  double radianceRange() const { return m_radianceRange; }
  std::uint64_t bytes() const;  ///< on the GPU
  void bind(GLuint bricks, GLuint voxels, GLuint leaves, GLuint soil) const;

 private:
  void setSoil(const wither::TexelLight& light, std::span<const float> groundSun, float perRange);

  std::shared_ptr<const bake::TexelBake> m_bake;
  std::vector<int> m_levelStarts;
  double m_densityRange = 1.0, m_radianceRange = 1.0;
  gpu::Buffer m_bricks, m_voxels, m_leaves, m_soil;
  gpu::Texture m_bricksView, m_voxelsView, m_leavesView, m_soilView;
};

}  // namespace sward::render
