#pragma once

#include "base/result.h"
#include "gpu/objects.h"
#include "render/programs.h"
#include "render/relit_ground.h"
#include "render/renderer.h"

#include <array>
#include <vector>

namespace sward::render {

/// What the whole pass reads, beside the frame.
struct PassInput {
  const bake::GroundBake* ground = nullptr;
  const RelitGround* relit = nullptr;
  const gpu::Texture* map = nullptr;    ///< tile indices, R8UI
  const gpu::Texture* sky = nullptr;    ///< makeSkyTexture
  const gpu::Texture* noise = nullptr;  ///< makeNoiseTexture
  glm::dvec3 sunDirection{0.0, 0.0, 1.0};
  glm::dvec3 sunIrradiance{0.0};
  double hazePerM = 0.0;
};

/// The blocks of a frame, sorted by the families of planes that their rays need: bit 0 slices, 1 blades normal to x, 2
/// blades normal to y; 0 is sky alone.
struct BlockPlan {
  static constexpr int kBlock = 64;                  ///< pixels along a side: the tile of Mesa's software rasteriser
  std::array<std::vector<std::uint32_t>, 8> blocks;  ///< x | y << 16 of the lower left pixel, by families
  SetMask sets;                                      ///< relit sets that the frame reads
};
BlockPlan planBlocks(const Frame& frame, const bake::GroundBake& ground, bool hasBlades);

/// Draws the ground and the sky, a variant of the shader for each sort of block.
class GroundPass {
 public:
  static GroundPass create();
  /// One sample into the bound framebuffer, which has the frame's size. `weight` multiplies the radiance (with the
  /// frame's exposure), sample 0 of 1 goes through pixel centres.
  Result<void> draw(ProgramCache& programs, const PassInput& input, const Frame& frame, const BlockPlan& plan,
                    int sample, double weight);

 private:
  Result<gpu::Program*> variant(ProgramCache& programs, GroundMethod method, std::size_t families) const;
  gpu::VertexArray m_vertices;
  gpu::Buffer m_blocks;
  gpu::Texture m_blocksView;
};

}  // namespace sward::render
