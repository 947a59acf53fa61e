#include "render/ground_pass.h"

#include "render/macro_map.h"
#include "render/pass_view.h"
#include "scene/ground_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::render {
namespace {

// The same as in shaders/ground/constants.glsl.
constexpr double kDiagonalFade = 0.45;

constexpr unsigned kSlices = 1, kBladesX = 2, kBladesY = 4;
/// Rays under the horizon by less than this may meet the sky within their pixel.
constexpr double kHorizonMargin = 0.004;

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double cosTheta0(const RenderOptions& options) {
  return std::cos(std::clamp(options.bladeAngleDeg, 0.0, 89.0) * std::numbers::pi / 180.0);
}

/// |N.E| from which the march begins to draw slices, and from which it draws nothing else.
struct SliceRange {
  double from = 0.0;
  double all = 1.0;
};

/// Blades serve while a ray crosses enough of their planes on its way through the shell: it meets height / (pitch tan
/// e) of them at elevation e, and with few it looks between them, down to the dark. Never beyond theta0.
SliceRange sliceRange(const bake::GroundBake& ground, const RenderOptions& options) {
  constexpr double kPlanesFrom = 10.0, kPlanesAll = 3.6;
  const double slope = ground.heightM * ground.bladesPerPatch / ground.patchSideM;
  const auto sine = [](double tangent) { return tangent / std::sqrt(1.0 + tangent * tangent); };
  const double all = std::min(sine(slope / kPlanesAll), cosTheta0(options));
  return {all * sine(slope / kPlanesFrom) / sine(slope / kPlanesAll) - 1e-6, all};
}

/// Families of planes that a ray needs: the weights of shaders/ground/surface.glsl or blended.frag that are above 0.
/// One slice layer alone has no blades.
unsigned familiesOf(const glm::dvec3& d, const Frame& frame, const SliceRange& slicesAt) {
  const RenderOptions& options = frame.options;
  if (frame.mode.layer >= 0) return kSlices;
  const double facing = std::abs(d.z);
  if (options.method != GroundMethod::March) return kSlices | (facing < cosTheta0(options) ? kBladesX | kBladesY : 0u);
  const double steep = smoothstep(slicesAt.from, slicesAt.all, facing);
  const double towardX = std::abs(d.x) / std::max(std::abs(d.x) + std::abs(d.y), 1e-6);
  const double x = smoothstep(0.5 - kDiagonalFade, 0.5 + kDiagonalFade, towardX);
  unsigned families = steep > 0.0 ? kSlices : 0u;
  if (steep < 1.0) families |= (x > 0.0 ? kBladesX : 0u) | (x < 1.0 ? kBladesY : 0u);
  return families;
}

/// Blade sets that face a ray.
SetMask facingSets(const glm::dvec3& d, unsigned families) {
  SetMask sets;
  if ((families & kBladesX) != 0) sets.set(d.x < 0.0 ? 1 : 2);
  if ((families & kBladesY) != 0) sets.set(d.y < 0.0 ? 3 : 4);
  return sets;
}

void setSets(gpu::Program& program, const PassInput& input) {
  const RelitGround& relit = *input.relit;
  const SetLayout& slices = relit.layout(kSliceSet);
  const double side = input.ground->tileSideM();
  setIfUsed(program, "u_tiles", relit.tiles());
  setIfUsed(program, "u_sliceSize", slices.width);
  setIfUsed(program, "u_sliceMaxLevel", slices.maxLevel);
  setIfUsed(program, "u_slicePlanes", slices.planes());
  setIfUsed(program, "u_sliceLayers", slices.layers);
  setIfUsed(program, "u_slicesPerM", static_cast<float>(slices.width / side));
  if (!relit.hasBlades()) return;
  const SetLayout& blades = relit.layout(1);
  // Blade texels are not square; a level is chosen by their geometric mean.
  const double rowsPerM = blades.height / std::max(input.ground->heightM, 1e-4);
  setIfUsed(program, "u_bladeSize", glm::ivec2(blades.width, blades.height));
  setIfUsed(program, "u_bladeMaxLevel", blades.maxLevel);
  setIfUsed(program, "u_bladeVerticalLevels", blades.verticalLevels);
  setIfUsed(program, "u_bladePlanes", blades.planes());
  setIfUsed(program, "u_slabs", relit.slabsOfTile());
  setIfUsed(program, "u_slabsPerM", static_cast<float>(relit.slabsOfTile() / side));
  setIfUsed(program, "u_bladesPerM", static_cast<float>(std::sqrt(blades.width / side * rowsPerM)));
  if (!program.has("u_bladeBase")) return;
  std::array<unsigned, 4> bases{};
  for (std::size_t i = 0; i < bases.size(); ++i) bases[i] = static_cast<unsigned>(relit.base(i + 1));
  program.set("u_bladeBase", std::span<const unsigned>(bases));
}

/// Quantities are shown as they are.
double exposureOf(const Frame& frame) {
  return frame.mode.quantity == ViewQuantity::Shaded ? frame.exposure : 1.0;
}

/// The axis of the ground that is nearest to up in the picture.
glm::vec2 labelUp(const scene::Camera& camera) {
  // Looking down, the picture's up lies on the ground; looking ahead, it is where the view goes.
  const glm::dvec2 up = glm::dvec2(camera.forward) + glm::dvec2(camera.up);
  if (std::abs(up.x) > std::abs(up.y)) return {up.x > 0.0 ? 1.0f : -1.0f, 0.0f};
  return {0.0f, up.y < 0.0 ? -1.0f : 1.0f};
}

void setMode(gpu::Program& program, const Frame& frame, double weight) {
  // Not behind a layer that stands alone, nor where its values have another meaning. Coverage is 0 where it is seen.
  const ViewQuantity quantity = frame.mode.quantity;
  const bool soil =
      (frame.mode.layer < 0 && quantity != ViewQuantity::Coefficient && quantity != ViewQuantity::Condition) ||
      quantity == ViewQuantity::Coverage;
  setIfUsed(program, "u_sampleWeight", static_cast<float>(weight));
  setIfUsed(program, "u_soilWeight", soil ? 1.0f : 0.0f);
  setIfUsed(program, "u_labelUp", labelUp(frame.camera));
}

void setLight(gpu::Program& program, const PassInput& input, const Frame& frame, double weight) {
  const SliceRange slicesAt = sliceRange(*input.ground, frame.options);
  setIfUsed(program, "u_slicesFrom", static_cast<float>(slicesAt.from));
  setIfUsed(program, "u_slicesAll", static_cast<float>(slicesAt.all));
  setIfUsed(program, "u_relightScale", static_cast<float>(input.relit->scale()));
  setIfUsed(program, "u_cosTheta0", static_cast<float>(cosTheta0(frame.options)));
  setIfUsed(program, "u_exposure", static_cast<float>(exposureOf(frame) * weight));
  setIfUsed(program, "u_hazePerM", static_cast<float>(input.hazePerM));
  setIfUsed(program, "u_sunDirection", glm::vec3(input.sunDirection));
  setIfUsed(program, "u_sunIrradiance", glm::vec3(input.sunIrradiance));
  setIfUsed(program, "u_meanSky", glm::vec3(input.meanSky));
  setIfUsed(program, "u_sunDisc", glm::vec3(input.sunIrradiance * scene::kSunDiscGain));
}

void bindTextures(gpu::Program& program, const PassInput& input, const gpu::Texture& blocks) {
  program.set("t_blocks", 0);
  setIfUsed(program, "t_relit", 1);
  setIfUsed(program, "t_map", 2);
  setIfUsed(program, "t_sky", 3);
  setIfUsed(program, "t_horizon", 4);
  blocks.bind(0);
  input.relit->relit().bind(1);
  input.map->bind(2);
  input.sky->bind(3);
  input.horizon->bind(4);
}

}  // namespace

BlockPlan planBlocks(const Frame& frame, const bake::GroundBake& ground, bool hasBlades) {
  constexpr int kProbes = 8;  // rays along a block's side, its corners and one pixel around them included
  const bool inside = frame.camera.position.z < ground.heightM;
  const double aspect = static_cast<double>(frame.width) / frame.height;
  const SliceRange slicesAt = sliceRange(ground, frame.options);
  BlockPlan plan;
  for (int y = 0; y < frame.height; y += BlockPlan::kBlock) {
    for (int x = 0; x < frame.width; x += BlockPlan::kBlock) {
      if (x >= frame.drawn().end || x + BlockPlan::kBlock <= frame.drawn().begin) continue;
      unsigned needs = 0;
      for (int probe = 0; probe < (kProbes + 1) * (kProbes + 1); ++probe) {
        const double px = x - 2.0 + (BlockPlan::kBlock + 4.0) * (probe % (kProbes + 1)) / kProbes;
        const double py = y - 2.0 + (BlockPlan::kBlock + 4.0) * (probe / (kProbes + 1)) / kProbes;
        const glm::dvec3 d = frame.camera.rayDirection(px / frame.width, 1.0 - py / frame.height, aspect);
        if (d.z > -kHorizonMargin) needs |= BlockPlan::kSky;
        if (d.z >= 0.0 && !inside) continue;
        const unsigned needed = hasBlades ? familiesOf(d, frame, slicesAt) : kSlices;
        needs |= needed;
        plan.sets |= facingSets(d, needed);
        plan.sets.set(kSliceSet);  // slices, or the soil alone
      }
      plan.blocks[needs].push_back(static_cast<std::uint32_t>(x) | (static_cast<std::uint32_t>(y) << 16));
    }
  }
  return plan;
}

BlockPlan planTerrainBlocks(const Frame& frame, bool hasBlades) {
  BlockPlan plan;
  auto& blocks = plan.blocks[BlockPlan::kSky | kSlices | (hasBlades ? kBladesX | kBladesY : 0u)];
  for (int y = 0; y < frame.height; y += BlockPlan::kBlock) {
    for (int x = 0; x < frame.width; x += BlockPlan::kBlock) {
      if (x >= frame.drawn().end || x + BlockPlan::kBlock <= frame.drawn().begin) continue;
      blocks.push_back(static_cast<std::uint32_t>(x) | (static_cast<std::uint32_t>(y) << 16));
    }
  }
  plan.sets.set(kSliceSet);
  if (!hasBlades) return plan;
  // Only directions within the picture, whose axes are those of the ground: slopes do not turn plants.
  constexpr int kProbes = 16;
  const double aspect = static_cast<double>(frame.width) / frame.height;
  for (int i = 0; i < (kProbes + 1) * (kProbes + 1); ++i) {
    const glm::dvec2 place(-0.05 + 1.1 * (i % (kProbes + 1)) / kProbes, -0.05 + 1.1 * (i / (kProbes + 1)) / kProbes);
    plan.sets |= facingSets(frame.camera.rayDirection(place.x, place.y, aspect), kBladesX | kBladesY);
  }
  return plan;
}

GroundPass GroundPass::create() {
  GroundPass pass;
  pass.m_vertices = gpu::VertexArray::make();
  return pass;
}

Result<gpu::Program*> GroundPass::variant(ProgramCache& programs, const Frame& frame, unsigned needs,
                                          bool terrain) const {
  // The blended methods know level ground alone.
  const GroundMethod method = terrain ? GroundMethod::March : frame.options.method;
  if (needs == BlockPlan::kSky)
    return programs.blocks("ground/sky.frag", {}, {"t_blocks", "t_sky", "u_sunDisc", "u_exposure"});
  const std::string file = method == GroundMethod::March ? "ground/march.frag" : "ground/blended.frag";
  Defines defines{{"SWARD_FAMILIES", std::to_string(needs & (BlockPlan::kSky - 1))},
                  {"SWARD_SKY", (needs & BlockPlan::kSky) != 0 ? "1" : "0"}};
  if (method != GroundMethod::March)
    defines.emplace_back("SWARD_PAPER_WEIGHTS", method == GroundMethod::BlendedPaper ? "1" : "0");
  if (terrain) defines.emplace_back("SWARD_TERRAIN", "1");
  std::vector<std::string> uniforms{"t_blocks",   "t_relit",   "t_map",          "u_exposure",
                                    "u_eyeTiles", "u_heightM", "u_relightScale", "u_mapOffset"};
  if (frame.mode.plain()) {
    uniforms.insert(uniforms.end(), {"t_horizon", "u_hazePerM"});
  } else {
    const bool tiles = frame.mode.quantity == ViewQuantity::Tiles;
    defines.emplace_back("SWARD_MODE", tiles ? "2" : "1");
    uniforms.insert(uniforms.end(), {"u_sampleWeight"});
    if (!terrain) uniforms.emplace_back("u_soilWeight");
  }
  return programs.blocks(file, defines, uniforms);
}

Result<void> GroundPass::draw(ProgramCache& programs, const PassInput& input, const Frame& frame, const BlockPlan& plan,
                              int sample, double weight) {
  std::vector<std::uint32_t> all;
  for (const auto& blocks : plan.blocks) all.insert(all.end(), blocks.begin(), blocks.end());
  const auto bytes = std::as_bytes(std::span(all));
  if (m_blocks.size() < bytes.size()) {
    m_blocks = gpu::Buffer(bytes.size());
    m_blocksView = gpu::Texture::ofBuffer(GL_R32UI, m_blocks);
  }
  m_blocks.write(bytes);
  gpu::gl().Viewport(0, 0, frame.width, frame.height);
  m_vertices.bind();
  std::size_t first = 0;
  for (unsigned needs = 0; needs < plan.blocks.size(); ++needs) {
    const std::size_t count = plan.blocks[needs].size();
    if (count == 0) continue;
    if (needs == BlockPlan::kSky && !frame.mode.plain()) {
      first += count;
      continue;
    }
    SWARD_ASSIGN(gpu::Program * program, variant(programs, frame, needs, input.terrain != nullptr));
    program->use();
    bindTextures(*program, input, m_blocksView);
    if (input.terrain != nullptr) input.terrain->bind(*program, *input.mesh);
    program->set("u_firstBlock", static_cast<int>(first));
    program->set("u_targetSize", glm::ivec2(frame.width, frame.height));
    program->set("u_blockSize", BlockPlan::kBlock);
    setView(*program, frame, sample);
    setPlace(*program, *input.ground, frame);
    setSets(*program, input);
    setLight(*program, input, frame, weight);
    setMode(*program, frame, weight);
    gpu::gl().DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count));
    first += count;
  }
  return {};
}

}  // namespace sward::render
