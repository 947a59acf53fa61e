#pragma once

#include "base/result.h"
#include "gpu/objects.h"
#include "render/programs.h"
#include "render/renderer.h"
#include "render/texel_set.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace sward::render {

/// What the texels' pass reads, beside the frame.
struct TexelPassInput {
  const TexelSet* texels = nullptr;
  const gpu::Texture* sky = nullptr;      ///< makeSkyTexture
  const gpu::Texture* horizon = nullptr;  ///< makeHorizonBuffer, RGBA32F
  glm::dvec3 sunDirection{0.0, 0.0, 1.0};
  glm::dvec3 sunIrradiance{0.0};
  double hazePerM = 0.0;
};

/// Draws a flat ground of texels and the sky.
class TexelPass {
 public:
  static TexelPass create();
  /// One sample into the bound framebuffer, which has the frame's size; `weight` multiplies the radiance (with the
  /// frame's exposure).
  Result<void> draw(ProgramCache& programs, const TexelPassInput& input, const Frame& frame, int sample, double weight);

 private:
  gpu::VertexArray m_vertices;
  gpu::Buffer m_blocks;
  gpu::Texture m_blocksView;
  std::vector<std::uint32_t> m_corners;  ///< that m_blocks holds
};

}  // namespace sward::render
