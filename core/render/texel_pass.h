#pragma once

#include "base/result.h"
#include "gpu/objects.h"
#include "render/ground_pass.h"
#include "render/programs.h"
#include "render/renderer.h"
#include "render/texel_set.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace sward::render {

/// Draws a ground of texels, level or over a terrain, and the sky.
class TexelPass {
 public:
  static TexelPass create();
  /// One sample into the bound framebuffer, which has the frame's size; `weight` multiplies the radiance (with the
  /// frame's exposure). `input` needs no relit layers.
  Result<void> draw(ProgramCache& programs, const TexelSet& texels, const PassInput& input, const Frame& frame,
                    int sample, double weight);

 private:
  gpu::VertexArray m_vertices;
  gpu::Buffer m_blocks;
  gpu::Texture m_blocksView;
  std::vector<std::uint32_t> m_corners;  ///< that m_blocks holds
};

}  // namespace sward::render
