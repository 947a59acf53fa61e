#pragma once

#include "base/result.h"
#include "gpu/objects.h"
#include "render/programs.h"
#include "render/relit_ground.h"
#include "render/renderer.h"
#include "render/terrain_pass.h"

#include <array>
#include <vector>

namespace sward::render {

/// What the whole pass reads, beside the frame.
struct PassInput {
  const bake::GroundBake* ground = nullptr;
  const RelitGround* relit = nullptr;
  const gpu::Texture* map = nullptr;      ///< makeMacroMap as a buffer, R32UI
  const gpu::Texture* sky = nullptr;      ///< makeSkyTexture
  const gpu::Texture* horizon = nullptr;  ///< makeHorizonBuffer, RGBA32F
  glm::dvec3 sunDirection{0.0, 0.0, 1.0};
  glm::dvec3 sunIrradiance{0.0};
  double hazePerM = 0.0;
  glm::dvec3 meanSky{0.0};            ///< radiance
  TerrainPass* terrain = nullptr;     ///< nothing: level ground
  const TerrainMesh* mesh = nullptr;  ///< of the frame, where there is a terrain
};

/// The blocks of a frame, sorted by what their rays need: bits of families of planes (1 slices, 2 blades normal to x, 4
/// blades normal to y) and of the sky; without families a block is sky alone.
struct BlockPlan {
  static constexpr int kBlock = 64;  ///< pixels along a side: the tile of Mesa's software rasteriser
  static constexpr unsigned kSky = 8;
  std::array<std::vector<std::uint32_t>, 16> blocks;  ///< x | y << 16 of the lower left pixel, by needs
  SetMask sets;                                       ///< relit sets that the frame reads
};
BlockPlan planBlocks(const Frame& frame, const bake::GroundBake& ground, bool hasBlades);
/// Over a terrain any ray may need anything.
BlockPlan planTerrainBlocks(const Frame& frame, bool hasBlades);

/// Draws the ground and the sky, a variant of the shader for each sort of block.
class GroundPass {
 public:
  static GroundPass create();
  /// One sample into the bound framebuffer, which has the frame's size. `weight` multiplies the radiance (with the
  /// frame's exposure), sample 0 of 1 goes through pixel centres. View modes leave the sky as it is, and write how much
  /// of a pixel is ground times `weight` into alpha.
  Result<void> draw(ProgramCache& programs, const PassInput& input, const Frame& frame, const BlockPlan& plan,
                    int sample, double weight);

 private:
  Result<gpu::Program*> variant(ProgramCache& programs, const Frame& frame, unsigned needs, bool terrain) const;
  gpu::VertexArray m_vertices;
  gpu::Buffer m_blocks;
  gpu::Texture m_blocksView;
};

}  // namespace sward::render
