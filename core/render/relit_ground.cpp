#include "render/relit_ground.h"

#include "render/ground_check.h"
#include "render/light_terms.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace sward::render {
namespace {

constexpr float kOpaque = 0.985f;           ///< these two also in shaders/include/layout.glsl
constexpr float kDepthRange = 4.19970508f;  ///< -ln(1 - kOpaque)
constexpr int kLeastBladeRows = 16;         ///< blades keep a height profile of this many rows at every distance
constexpr int kGroup = 8;                   ///< invocations along a side of a work group, as in the shaders
/// A fit may overshoot the response's bound of 1; texels brighter than the scale are cut off.
constexpr double kHeadroom = 1.15;

template <typename T>
std::span<const std::byte> bytesOf(const std::vector<T>& data) {
  return std::as_bytes(std::span(data));
}

unsigned groups(int count) {
  return static_cast<unsigned>((count + kGroup - 1) / kGroup);
}

float brightest(const std::vector<std::uint8_t>& rgba) {
  std::uint8_t most = 0;
  for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) most = std::max({most, rgba[i], rgba[i + 1], rgba[i + 2]});
  const float root = static_cast<float>(most) / 255.0f;
  return root * root;
}

/// SWARD_QUANTITY of shaders/include/quantity.glsl.
std::string quantityDefine(const ViewMode& mode) {
  constexpr int kShadedLayer = 8;
  return std::to_string(mode.quantity == ViewQuantity::Shaded ? kShadedLayer : static_cast<int>(mode.quantity));
}

void barrier() {
  gpu::gl().MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace

RelitGround::Stack::Stack(const lpt::LayerStack& stack)
    : basis(stack.basis),
      width(stack.width),
      height(stack.height),
      images(stack.images),
      layers(stack.layers),
      channels(stack.channels),
      bits(stack.bits),
      ranges(stack.ranges),
      common(stack.common),
      coefficients(bytesOf(stack.coefficients)),
      surface(bytesOf(stack.surface)),
      transmission(bytesOf(stack.transmission)),
      sky(bytesOf(stack.sky)),
      transmits(!stack.transmission.empty()) {
  coefficientsView = gpu::Texture::ofBuffer(GL_R32UI, coefficients);
  surfaceView = gpu::Texture::ofBuffer(GL_R32UI, surface);
  transmissionView = gpu::Texture::ofBuffer(GL_R32UI, transmission);
  skyView = gpu::Texture::ofBuffer(GL_R32UI, sky);
}

/// Where relightStack writes.
struct RelitGround::Target {
  GLuint buffer = 0;
  glm::ivec2 size{0};
  int apron = 0;
  int outLayers = 0, outFirst = 0;
  std::size_t base = 0;
  std::size_t base1 = 0;  ///< of the first mip level; 0: it is not written
};

Result<RelitGround> RelitGround::create(const bake::GroundBake& ground) {
  SWARD_TRY(checkGround(ground));
  const bool blades = bladesPresent(ground);
  RelitGround out;
  out.m_tiles = static_cast<int>(ground.tiles.tiles.size());
  out.m_apron = ground.tiles.apron;
  out.m_tileTexels = ground.tiles.resolution;
  out.m_stacks.emplace_back(ground.slices);
  out.m_stacks.emplace_back(ground.soil);
  out.m_sliceLayout = makeSetLayout(out.m_tileTexels, out.m_tileTexels, out.m_tiles, ground.slices.layers + 1, 1);
  float most = std::max(brightest(ground.soil.surface), brightest(ground.slices.surface));
  most = std::max(most, brightest(ground.slices.transmission));
  std::size_t texels = out.m_sliceLayout.texelCount();
  if (blades) {
    const tiles::TileSet& set = ground.tiles;
    const lpt::LayerStack& first = ground.blades[0];
    out.m_patchSlabs = ground.bladesPerPatch;
    out.m_slabs = set.resolution * ground.bladesPerPatch / set.patchResolution;
    out.m_bladeLayout = makeSetLayout(first.width / set.patchResolution * set.resolution, first.height, out.m_tiles,
                                      out.m_slabs, kLeastBladeRows);
    for (std::size_t side = 0; side < 4; ++side) {
      out.m_stacks.emplace_back(ground.blades[side]);
      out.m_bases[side + 1] = texels;
      texels += out.m_bladeLayout.texelCount();
      most = std::max({most, brightest(ground.blades[side].surface), brightest(ground.blades[side].transmission)});
    }
    std::vector<std::uint32_t> owners;
    for (const tiles::BladeOwner& owner : ground.bladeOwners)
      owners.push_back(owner.slab | (static_cast<std::uint32_t>(owner.position) << 16));
    out.m_owners = gpu::Buffer(bytesOf(owners));
    out.m_patch = gpu::Buffer(first.texelCount() * 4);
    out.m_ownersView = gpu::Texture::ofBuffer(GL_R32UI, out.m_owners);
    out.m_patchView = gpu::Texture::ofBuffer(GL_R32UI, out.m_patch);
  }
  GLint limit = 0;
  gpu::gl().GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
  const std::size_t largest = std::max({texels, ground.slices.texelCount(), ground.slices.coefficients.size() / 4});
  if (largest > static_cast<std::size_t>(limit))
    return Error::failed("the tiles have " + std::to_string(largest) + " texels, the driver allows " +
                             std::to_string(limit) + " in a buffer",
                         "ground", "Use fewer tiles or layers, or smaller ones.");
  out.m_brightest = std::max(most, 1e-3f);
  out.m_relit = gpu::Buffer(texels * 4);
  out.m_relitView = gpu::Texture::ofBuffer(GL_R32UI, out.m_relit);
  out.setIllumination(lpt::Illumination{});
  return out;
}

void RelitGround::setIllumination(const lpt::Illumination& light) {
  if (light.sunDirection == m_light.sunDirection && light.sunIrradiance == m_light.sunIrradiance &&
      light.skyRadiance == m_light.skyRadiance)
    return;
  m_light = light;
  if (!(m_light.sunDirection.z >= 0.0)) m_light.sunIrradiance = glm::dvec3(0.0);
  const glm::dvec3 most = m_light.sunIrradiance / std::numbers::pi + m_light.skyRadiance;
  m_scale = std::max(kHeadroom * static_cast<double>(m_brightest) * std::max({most.x, most.y, most.z}), 1e-9);
  m_fresh.reset();
}

Result<void> RelitGround::setMode(const ViewMode& mode, const bake::GroundBake& ground) {
  SWARD_TRY(checkMode(mode, ground));
  if (mode.needsInspection() && !m_inspected)
    return Error::failed("this ground was baked without an inspection", "view mode",
                         "Bake one, or choose another view mode.");
  if (mode == m_mode) return {};
  m_mode = mode;
  m_scaled = mode.quantity == ViewQuantity::Shaded;
  m_coefficientRange =
      mode.quantity == ViewQuantity::Coefficient ? coefficientRange(ground, mode.channel, mode.coefficient) : 1.0;
  m_fresh.reset();
  return {};
}

Result<void> RelitGround::setInspection(const bake::Inspection& inspection) {
  std::vector<const bake::StackInspection*> inspected{&inspection.slices, &inspection.soil};
  for (const bake::StackInspection& blade : inspection.blades) inspected.push_back(&blade);
  for (std::size_t i = 0; i < m_stacks.size(); ++i) {
    const auto columns = static_cast<std::size_t>(m_stacks[i].width) * static_cast<std::size_t>(m_stacks[i].height) *
                         static_cast<std::size_t>(m_stacks[i].images);
    const std::size_t texels = columns * static_cast<std::size_t>(m_stacks[i].layers);
    if (inspected[i]->condition.size() != columns || inspected[i]->visibility.size() != texels)
      return Error::badInput("the inspection is of another ground", "view mode", "Bake it again.");
  }
  for (std::size_t i = 0; i < m_stacks.size(); ++i) {
    Stack& stack = m_stacks[i];
    stack.condition = gpu::Buffer(bytesOf(inspected[i]->condition));
    stack.visibility = gpu::Buffer(bytesOf(inspected[i]->visibility));
    stack.conditionView = gpu::Texture::ofBuffer(GL_R32UI, stack.condition);
    stack.visibilityView = gpu::Texture::ofBuffer(GL_R32UI, stack.visibility);
  }
  m_inspected = true;
  if (m_mode.needsInspection()) m_fresh.reset();
  return {};
}

Result<void> RelitGround::relight(ProgramCache& programs, SetMask sets) {
  sets &= ~m_fresh;
  if (!hasBlades()) sets &= SetMask(1);
  if (sets.test(kSliceSet)) SWARD_TRY(relightSlices(programs));
  for (std::size_t side = 0; side < 4; ++side)
    if (sets.test(side + 1)) SWARD_TRY(relightBlades(programs, side));
  m_fresh |= sets;
  return {};
}

Result<void> RelitGround::relightSlices(ProgramCache& programs) {
  const std::size_t base1 = m_sliceLayout.level(1).offset;
  Target target{m_relit.name(),     glm::ivec2(m_tileTexels),  m_apron, m_sliceLayout.layers, 0,
                m_bases[kSliceSet], m_bases[kSliceSet] + base1};
  SWARD_TRY(relightStack(programs, m_stacks[0], target));
  target.outFirst = m_stacks[0].layers;
  SWARD_TRY(relightStack(programs, m_stacks[1], target));
  return makeMips(programs, kSliceSet, 2);
}

Result<void> RelitGround::relightBlades(ProgramCache& programs, std::size_t side) {
  const Stack& stack = m_stacks[2 + side];
  const glm::ivec2 patchSize(stack.width, stack.height);
  SWARD_TRY(relightStack(programs, stack, {m_patch.name(), patchSize, 0, stack.layers, 0, 0, 0}));
  barrier();
  Defines defines;
  if (m_mode.quantity == ViewQuantity::Tiles) defines.emplace_back("SWARD_QUANTITY", quantityDefine(m_mode));
  SWARD_ASSIGN(gpu::Program * program,
               programs.compute("relight/bind_blades.comp", defines, {"u_patchSize", "u_outBase"}));
  const glm::ivec2 outSize(m_bladeLayout.width, m_bladeLayout.height);
  program->use();
  program->set("t_patch", 0);
  program->set("t_owners", 1);
  m_patchView.bind(0);
  m_ownersView.bind(1);
  program->set("u_patchSize", patchSize);
  program->set("u_outSize", outSize);
  program->set("u_slabs", m_patchSlabs);
  setIfUsed(*program, "u_tileSlabs", m_slabs);
  program->set("u_reversed", side % 2 == 0 ? 1 : 0);  // seen from +x or +y: layer 0 is the last slab
  program->set("u_ownerTexels", m_tileTexels);
  program->set("u_texelsPerOwner", outSize.x / m_tileTexels);
  program->set("u_outBase", static_cast<int>(m_bases[side + 1]));
  program->set("u_ownerBase", side < 2 ? 0 : m_tiles * m_slabs * m_tileTexels);
  m_relit.bindStorage(0);
  gpu::gl().DispatchCompute(groups(outSize.x), groups(outSize.y), static_cast<unsigned>(m_tiles * m_slabs));
  return makeMips(programs, side + 1, 1);
}

LightTerms RelitGround::termsOf(const Stack& stack) const {
  if (m_mode.quantity == ViewQuantity::Luminance && !(m_light.sunDirection.z >= 0.0)) return {};
  if (m_mode.quantity != ViewQuantity::Coefficient)
    return lightTerms(stack.basis, stack.common.empty() ? lpt::LayerCoordinate::Depth : lpt::LayerCoordinate::Response,
                      stack.channels, stack.ranges, m_light.sunDirection);
  const int channel = static_cast<int>(m_mode.channel);
  // The soil has other coefficients than grass, and is not shown.
  if (&stack == &m_stacks[1]) return {};
  return coefficientTerms(stack.basis, stack.ranges, channel, m_mode.coefficient, m_coefficientRange);
}

/// t_common of shaders/relight: nothing where a coefficient alone is shown, or no light falls.
std::vector<float> RelitGround::commonTerms(const Stack& stack) const {
  const lpt::CommonAtLight common(stack.common, m_light.sunDirection);
  const std::span<const float> weights = common.weights();
  if (m_mode.quantity == ViewQuantity::Coefficient || !(m_light.sunDirection.z >= 0.0))
    return std::vector<float>(weights.size(), 0.0f);
  return {weights.begin(), weights.end()};
}

/// What the variants of relight.comp for view modes need beside the rest.
void RelitGround::setQuantity(gpu::Program& program, const Stack& stack, bool slices) const {
  setIfUsed(program, "u_onlyLayer", slices && &stack != &m_stacks[1] ? m_mode.layer : -1);
  setIfUsed(program, "u_soil", &stack == &m_stacks[1] ? 1 : 0);
  setIfUsed(program, "u_channel", static_cast<int>(m_mode.channel));
  setIfUsed(program, "t_inspection", 4);
  if (!m_mode.needsInspection()) return;
  (m_mode.quantity == ViewQuantity::Condition ? stack.conditionView : stack.visibilityView).bind(4);
}

Result<void> RelitGround::relightStack(ProgramCache& programs, const Stack& stack, const Target& target) {
  const bool withMip = target.base1 != 0;
  const bool slices = &stack == &m_stacks[0] || &stack == &m_stacks[1];
  const int block = withMip ? 2 : 1;
  Defines defines{{"SWARD_LPT", stack.basis == lpt::Basis::Lpt ? "1" : "0"},
                  {"SWARD_COMMON", stack.common.empty() ? "0" : "1"},
                  {"SWARD_PER_ITEM", std::to_string(lpt::stackCoefficients(stack.basis))},
                  {"SWARD_CHANNELS", std::to_string(stack.channels)},
                  {"SWARD_BITS", std::to_string(stack.bits)},
                  {"SWARD_TRANSMISSION", stack.transmits ? "1" : "0"},
                  {"SWARD_BLOCK", std::to_string(block)}};
  std::vector<std::string> uniforms{"t_surface", "u_outBase"};
  if (m_mode.plain()) {
    uniforms.insert(uniforms.end(), {"t_coefficients", "t_sky", "u_sun"});
  } else {
    defines.emplace_back("SWARD_QUANTITY", quantityDefine(m_mode));
    defines.emplace_back("SWARD_TINT", slices ? "1" : "0");
    uniforms.emplace_back("u_onlyLayer");
  }
  SWARD_ASSIGN(gpu::Program * program, programs.compute("relight/relight.comp", defines, uniforms));
  const LightTerms terms = termsOf(stack);
  program->use();
  setIfUsed(*program, "t_coefficients", 0);
  program->set("t_surface", 1);
  setIfUsed(*program, "t_sky", 2);
  setIfUsed(*program, "t_transmission", 3);
  setQuantity(*program, stack, slices);
  stack.coefficientsView.bind(0);
  stack.surfaceView.bind(1);
  stack.skyView.bind(2);
  stack.transmissionView.bind(3);
  gpu::Buffer common;
  gpu::Texture commonView;
  if (!stack.common.empty()) {
    common = gpu::Buffer(bytesOf(commonTerms(stack)));
    commonView = gpu::Texture::ofBuffer(GL_R32F, common);
    commonView.bind(5);
    setIfUsed(*program, "t_common", 5);
  }
  setIfUsed(*program, "u_weights", std::span<const float>(terms.weights));
  setIfUsed(*program, "u_constants", std::span<const float>(terms.constants));
  setIfUsed(*program, "u_sun", glm::vec3(m_light.sunIrradiance / std::numbers::pi / m_scale));
  setIfUsed(*program, "u_skyLight", glm::vec3(m_light.skyRadiance / m_scale));
  program->set("u_stackSize", glm::ivec2(stack.width, stack.height));
  program->set("u_outSize", target.size);
  program->set("u_apron", target.apron);
  program->set("u_layers", stack.layers);
  program->set("u_outLayers", target.outLayers);
  program->set("u_outFirst", target.outFirst);
  program->set("u_outBase", static_cast<int>(target.base));
  setIfUsed(*program, "u_outBase1", static_cast<int>(target.base1));
  gpu::gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, target.buffer);
  gpu::gl().DispatchCompute(groups(target.size.x / block), groups(target.size.y / block),
                            static_cast<unsigned>(stack.images));
  return {};
}

Result<void> RelitGround::makeMips(ProgramCache& programs, std::size_t set, int firstLevel) {
  const SetLayout& layout = this->layout(set);
  const int base = static_cast<int>(m_bases[set]);
  const auto sizeOf = [](const LevelShape& shape) { return glm::ivec2(shape.width, shape.height); };
  SWARD_ASSIGN(gpu::Program * mip, programs.compute("relight/mip.comp", {}, {"t_relit", "u_fineSize"}));
  m_relitView.bind(0);
  m_relit.bindStorage(0);
  mip->use();
  mip->set("t_relit", 0);
  for (int level = firstLevel; level <= layout.maxLevel; ++level) {
    const LevelShape fine = layout.level(level - 1);
    const LevelShape coarse = layout.level(level);
    mip->set("u_fineSize", sizeOf(fine));
    mip->set("u_outSize", sizeOf(coarse));
    mip->set("u_fineBase", base + static_cast<int>(fine.offset));
    mip->set("u_outBase", base + static_cast<int>(coarse.offset));
    barrier();
    gpu::gl().DispatchCompute(groups(coarse.width), groups(coarse.height),
                              static_cast<unsigned>(m_tiles * layout.layers));
  }
  SWARD_ASSIGN(gpu::Program * mean, programs.compute("relight/mean.comp", {}, {"t_relit", "u_tiles"}));
  const LevelShape last = layout.level(layout.maxLevel);
  mean->use();
  mean->set("t_relit", 0);
  mean->set("u_outSize", sizeOf(last));
  mean->set("u_outBase", base + static_cast<int>(last.offset));
  mean->set("u_tiles", m_tiles);
  mean->set("u_outLayers", layout.layers);
  barrier();
  gpu::gl().DispatchCompute(groups(last.width), groups(last.height), static_cast<unsigned>(layout.layers));
  barrier();
  return {};
}

std::vector<glm::vec4> RelitGround::readPlane(std::size_t set, int plane, int level) const {
  const LevelShape shape = layout(set).level(level);
  const auto area = static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(shape.height);
  std::vector<std::uint8_t> bytes(area * 4);
  m_relit.read((m_bases[set] + shape.offset + static_cast<std::size_t>(plane) * area) * 4,
               std::as_writable_bytes(std::span(bytes)));
  std::vector<glm::vec4> texels(area);
  for (std::size_t i = 0; i < area; ++i) {
    const glm::vec4 stored = glm::vec4(bytes[4 * i], bytes[4 * i + 1], bytes[4 * i + 2], bytes[4 * i + 3]) / 255.0f;
    // decodeRelit() of shaders/include/layout.glsl.
    texels[i] = glm::vec4(glm::vec3(stored) * glm::vec3(stored),
                          (1.0f - std::exp(-kDepthRange * stored.w * stored.w)) / kOpaque);
  }
  return texels;
}

}  // namespace sward::render
