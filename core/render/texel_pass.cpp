#include "render/texel_pass.h"

#include "render/pass_view.h"
#include "scene/ground_look.h"

#include <algorithm>
#include <array>
#include <span>

namespace sward::render {
namespace {

/// Leaves mirror some 4 % of the light (Fresnel's at the index 1.4). A cone's highlight, to the power 24, fills about a
/// seventh of the directions, 4 pi / 7 sr, so that its radiance is 0.04 / (4 pi / 7) of the irradiance; the gloss of
/// grass, kLeafSpecular, is 0.3 of the whole.
constexpr float kHighlight = 0.04f / 1.8f / 0.3f;
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

void bind(gpu::Program& program, const TexelSet& texels, const PassInput& input, const gpu::Texture& blocks) {
  constexpr std::array<const char*, 8> kSamplers{"t_blocks", "t_map",    "t_sky",     "t_horizon",
                                                 "t_bricks", "t_voxels", "t_glosses", "t_soil"};
  // The terrain's begin at 5: those of the texels stand above them.
  constexpr std::array<int, 8> kUnits{0, 1, 2, 3, 8, 9, 10, 11};
  for (std::size_t i = 0; i < kSamplers.size(); ++i) setIfUsed(program, kSamplers[i], kUnits[i]);
  blocks.bind(0);
  input.map->bind(1);
  input.sky->bind(2);
  input.horizon->bind(3);
  texels.bind(8);
  if (input.terrain != nullptr) input.terrain->bind(program, *input.mesh);
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
  setIfUsed(program, "u_extinctionRange", static_cast<float>(set.extinctionRange()));
  setIfUsed(program, "u_radianceRange", static_cast<float>(set.radianceRange()));
  std::array<float, kMostLevels> unordered{};
  for (std::size_t i = 0; i < levels; ++i) unordered[i] = static_cast<float>(set.phases()[i].unordered);
  if (program.has("u_unordered")) program.set("u_unordered", std::span<const float>(unordered));
  setIfUsed(program, "u_passed", glm::vec3(set.phases().front().passed));
  setIfUsed(program, "u_sunPart", glm::vec3(set.phases().front().sun));
}

void setLight(gpu::Program& program, const PassInput& input, const Frame& frame, double weight) {
  setIfUsed(program, "u_exposure", static_cast<float>(frame.exposure * weight));
  setIfUsed(program, "u_hazePerM", static_cast<float>(input.hazePerM));
  setIfUsed(program, "u_sunDirection", glm::vec3(input.sunDirection));
  setIfUsed(program, "u_sunIrradiance", glm::vec3(input.sunIrradiance));
  setIfUsed(program, "u_meanSky", glm::vec3(input.meanSky));
  setIfUsed(program, "u_sunDisc", glm::vec3(input.sunIrradiance * scene::kSunDiscGain));
  setIfUsed(program, "u_highlight", kHighlight);
}

}  // namespace

TexelPass TexelPass::create() {
  TexelPass pass;
  pass.m_vertices = gpu::VertexArray::make();
  return pass;
}

Result<void> TexelPass::draw(ProgramCache& programs, const TexelSet& texels, const PassInput& input, const Frame& frame,
                             int sample, double weight) {
  std::vector<std::uint32_t> corners = cornersOf(frame);
  if (corners != m_corners) {
    m_blocks = gpu::Buffer(std::as_bytes(std::span(corners)));
    m_blocksView = gpu::Texture::ofBuffer(GL_R32UI, m_blocks);
    m_corners = std::move(corners);
  }
  const Defines defines{{"SWARD_SKY", "1"}, {"SWARD_TERRAIN", input.terrain != nullptr ? "1" : "0"}};
  SWARD_ASSIGN(gpu::Program * program,
               programs.blocks("texels/march.frag", defines,
                               {"t_blocks", "t_bricks", "t_voxels", "t_map", "u_columns", "u_heightM"}));
  gpu::gl().Viewport(0, 0, frame.width, frame.height);
  m_vertices.bind();
  program->use();
  bind(*program, texels, input, m_blocksView);
  program->set("u_firstBlock", 0);
  program->set("u_targetSize", glm::ivec2(frame.width, frame.height));
  program->set("u_blockSize", BlockPlan::kBlock);
  setView(*program, frame, sample);
  setPlace(*program, *input.ground, frame);
  setLevels(*program, texels);
  setLight(*program, input, frame, weight);
  gpu::gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(m_corners.size()));
  return {};
}

}  // namespace sward::render
