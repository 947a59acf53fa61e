#pragma once

#include "base/job.h"
#include "base/result.h"
#include "bake/texel_bake.h"
#include "gpu/objects.h"
#include "wither/leaf_phase.h"
#include "wither/texel_light.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::render {

/// The levels of a texel as shaders/texels/march.frag reads them. Of all levels in one:
///   bricks   [level][z][y][x] where the brick's 512 voxels start; -1 - p where it is empty and lies in an empty cube
///   of
///            2^p voxels a side, aligned to its size
///   voxels   two words each, in cubes of eight. What dims a ray, 0 where nothing does: normal of the upper hemisphere
///            (octahedral, a byte each) | extinction across it over that along it << 16 | extinction along it (square
///            root over extinctionRange, at least 1) << 24. And radiance on the normal's upper side | on its lower side
///            << 16 (5, 6 and 5 bits of the square root over radianceRange)
///   glosses  a word a voxel: tangent (octahedral, two bytes) | highlight times sunlight << 16
///   soil     lit soil of level 0's columns, 10 bits a channel of the square root over radianceRange
class TexelSet {
 public:
  /// Uploads what no light changes. Errors: more voxels than indices or the GPU hold.
  static Result<TexelSet> create(std::shared_ptr<const bake::TexelBake> bake);
  /// Lights all levels on the processor and uploads them.
  Result<void> relight(const wither::TexelLight& light, const JobContext& job);

  const bake::TexelBake& bake() const { return *m_bake; }
  const std::vector<int>& levelStarts() const { return m_levelStarts; }  ///< in `bricks`
  double extinctionRange() const { return m_extinctionRange; }           ///< 1/m
  double radianceRange() const { return m_radianceRange; }
  /// Of every level, under the present light.
  const std::vector<wither::PhaseMeans>& phases() const { return m_phases; }
  std::uint64_t bytes() const;  ///< on the GPU
  /// To four texture units from `first` on, in the order above.
  void bind(GLuint first) const;

 private:
  void setSoil(const wither::TexelLight& light, std::span<const float> groundSun, float perRange);

  std::shared_ptr<const bake::TexelBake> m_bake;
  std::vector<int> m_levelStarts;
  std::size_t m_places = 0;  ///< voxels of all stored bricks
  double m_extinctionRange = 1.0, m_radianceRange = 1.0;
  std::vector<wither::PhaseMeans> m_phases;
  gpu::Buffer m_bricks, m_voxels, m_glosses, m_soil;
  gpu::Texture m_bricksView, m_voxelsView, m_glossesView, m_soilView;
};

}  // namespace sward::render
