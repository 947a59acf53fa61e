#include "render/texel_pass.h"

#include "render/ground_pass.h"
#include "render/pass_view.h"
#include "scene/ground_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace sward::render {
namespace {

constexpr float kHighlightExponent = 24.0f;
constexpr std::size_t kMostLevels = 8;  ///< as in shaders/texels/march.frag

std::vector<std::uint32_t> cornersOf(const Frame& frame) {
  std::vector<std::uint32_t> corners;
  for (int y = 0; y < frame.height; y += BlockPlan::kBlock) {
    for (int x = 0; x < frame.width; x += BlockPlan::kBlock) {
      if (x >= frame.drawn().end || x + BlockPlan::kBlock <= frame.drawn().begin) continue;
      corners.push_back(static_cast<std::uint32_t>(x) | static_cast<std::uint32_t>(y) << 16);
    }
  }
  return corners;
}

void bind(gpu::Program& program, const TexelPassInput& input, const gpu::Texture& blocks) {
  program.set("t_blocks", 0);
  setIfUsed(program, "t_bricks", 1);
  setIfUsed(program, "t_voxels", 2);
  setIfUsed(program, "t_leaves", 3);
  setIfUsed(program, "t_soil", 4);
  setIfUsed(program, "t_sky", 5);
  setIfUsed(program, "t_horizon", 6);
  blocks.bind(0);
  input.texels->bind(1, 2, 3, 4);
  input.sky->bind(5);
  input.horizon->bind(6);
}

void setLevels(gpu::Program& program, const TexelSet& set) {
  std::array<unsigned, kMostLevels> starts{};
  const std::size_t levels = std::min(set.levelStarts().size(), starts.size());
  for (std::size_t i = 0; i < levels; ++i) starts[i] = static_cast<unsigned>(set.levelStarts()[i]);
  const wither::TexelGrid& grid = set.bake().grid();
  setIfUsed(program, "u_levels", static_cast<int>(levels));
  if (program.has("u_levelStart")) program.set("u_levelStart", std::span<const unsigned>(starts));
  setIfUsed(program, "u_columns", grid.columns);
  setIfUsed(program, "u_layers", grid.layers);
  setIfUsed(program, "u_sideM", static_cast<float>(grid.sideM));
  setIfUsed(program, "u_shellM", static_cast<float>(grid.heightM));
  setIfUsed(program, "u_densityRange", static_cast<float>(set.densityRange()));
  setIfUsed(program, "u_radianceRange", static_cast<float>(set.radianceRange()));
}

void setPlace(gpu::Program& program, const TexelPassInput& input, const Frame& frame) {
  const glm::dvec3& eye = frame.camera.position;
  const double side = input.texels->bake().grid().sideM;
  const auto turns = [](double x) { return static_cast<float>(x - std::floor(x)); };
  const glm::dvec2 place = glm::dvec2(eye) / side;
  setIfUsed(program, "u_eyeM", static_cast<float>(std::max(eye.z, 1e-3)));
  setIfUsed(program, "u_eyePlace", glm::vec2(place - glm::floor(place)));
  setIfUsed(program, "u_bendM", static_cast<float>(frame.options.gridBendM));
  setIfUsed(program, "u_bendTurnsPerM", static_cast<float>(1.0 / scene::kBendM));
  setIfUsed(program, "u_bendPhase",
            glm::vec2(turns(eye.y / scene::kBendM), turns(eye.x / scene::kBendM + scene::kBendPhaseTurns)));
}

}  // namespace

TexelPass TexelPass::create() {
  TexelPass pass;
  pass.m_vertices = gpu::VertexArray::make();
  return pass;
}

Result<void> TexelPass::draw(ProgramCache& programs, const TexelPassInput& input, const Frame& frame, int sample,
                             double weight) {
  std::vector<std::uint32_t> corners = cornersOf(frame);
  if (corners != m_corners) {
    m_blocks = gpu::Buffer(std::as_bytes(std::span(corners)));
    m_blocksView = gpu::Texture::ofBuffer(GL_R32UI, m_blocks);
    m_corners = std::move(corners);
  }
  SWARD_ASSIGN(gpu::Program * program,
               programs.blocks("texels/march.frag", {}, {"t_blocks", "t_bricks", "t_voxels", "t_leaves", "u_columns"}));
  gpu::gl().Viewport(0, 0, frame.width, frame.height);
  m_vertices.bind();
  program->use();
  bind(*program, input, m_blocksView);
  program->set("u_firstBlock", 0);
  program->set("u_targetSize", glm::ivec2(frame.width, frame.height));
  program->set("u_blockSize", BlockPlan::kBlock);
  setView(*program, frame, sample);
  setPlace(*program, input, frame);
  setLevels(*program, *input.texels);
  setIfUsed(*program, "u_exposure", static_cast<float>(frame.exposure * weight));
  setIfUsed(*program, "u_hazePerM", static_cast<float>(input.hazePerM));
  setIfUsed(*program, "u_sunDirection", glm::vec3(input.sunDirection));
  setIfUsed(*program, "u_sunIrradiance", glm::vec3(input.sunIrradiance));
  setIfUsed(*program, "u_sunDisc", glm::vec3(input.sunIrradiance * scene::kSunDiscGain));
  setIfUsed(*program, "u_sharpness", kHighlightExponent);
  gpu::gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(m_corners.size()));
  return {};
}

}  // namespace sward::render
