#include "render/relit_ground.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace sward::render {
namespace {

constexpr float kOpaque = 0.985f;           ///< these two also in shaders/include/layout.glsl
constexpr float kDepthRange = 4.19970508f;  ///< -ln(1 - kOpaque)
constexpr int kLeastBladeRows = 16;         ///< blades keep a height profile of this many rows at every distance
constexpr int kMaxMapSide = 3900;
constexpr int kGroup = 8;  ///< invocations along a side of a work group, as in the shaders
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

Error misfit(const std::string& what) {
  return Error::badInput("the baked ground does not fit together: " + what, "ground", "Bake it again.");
}

Result<void> checkStack(const lpt::LayerStack& stack, const std::string& name) {
  const std::size_t perItem = static_cast<std::size_t>(stack.perColumn() * stack.channels);
  const std::size_t items = stack.basis == lpt::Basis::Lpt ? stack.columnCount() : stack.texelCount();
  const std::size_t texels = stack.texelCount();
  if (stack.bits != 8 && stack.bits != 16) return misfit(name + " has " + std::to_string(stack.bits) + " bits");
  if (stack.channels < 1 || stack.channels > 2) return misfit(name + " has a wrong number of channels");
  if (texels == 0 || stack.layers < 1) return misfit(name + " is empty");
  if (stack.coefficients.size() != items * perItem * static_cast<std::size_t>(stack.bits / 8) ||
      stack.ranges.size() != perItem || stack.surface.size() != texels * 4 || stack.sky.size() != texels * 2 ||
      (!stack.transmission.empty() && stack.transmission.size() != texels * 4))
    return misfit(name + " has arrays of the wrong size");
  return {};
}

Result<void> checkSlices(const bake::GroundBake& ground) {
  SWARD_TRY(checkStack(ground.slices, "slices"));
  SWARD_TRY(checkStack(ground.soil, "soil"));
  const int tiles = static_cast<int>(ground.tiles.tiles.size());
  if (tiles < 1 || tiles > 255) return misfit("there are " + std::to_string(tiles) + " tiles");
  for (const lpt::LayerStack* stack : {&ground.slices, &ground.soil})
    if (stack->width != ground.tiles.side() || stack->height != ground.tiles.side() || stack->images != tiles)
      return misfit("tiles have other sizes than their layers");
  if (ground.soil.layers != 1) return misfit("the soil has several layers");
  if (ground.tiles.resolution < 2 || ground.tiles.resolution % 2 != 0) return misfit("a tile has an odd side");
  const tiles::TileMap& map = ground.map;
  // Shaders count the map's words, borders and all, in floats, which are exact up to 2^24.
  if (map.width < 1 || map.height < 1 || map.width > kMaxMapSide || map.height > kMaxMapSide ||
      map.tiles.size() != static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height))
    return misfit("the tile map is empty or longer than " + std::to_string(kMaxMapSide) + " cells");
  if (std::any_of(map.tiles.begin(), map.tiles.end(), [&](std::uint8_t tile) { return tile >= tiles; }))
    return misfit("the tile map names a tile that is not there");
  return {};
}

Result<void> checkBlades(const bake::GroundBake& ground) {
  const tiles::TileSet& set = ground.tiles;
  const int blades = ground.bladesPerPatch;
  if (blades < 1 || set.patchResolution < 1 || set.patchResolution % blades != 0)
    return misfit("blade slabs do not divide the patch");
  const int slabTexels = set.patchResolution / blades;
  if (set.resolution % slabTexels != 0) return misfit("blade slabs do not divide a tile");
  const lpt::LayerStack& first = ground.blades[0];
  for (const lpt::LayerStack& side : ground.blades) {
    SWARD_TRY(checkStack(side, "blades"));
    if (side.images != 1 || side.layers != blades || side.width != first.width || side.height != first.height)
      return misfit("blade sets have different sizes");
  }
  if (first.width % set.patchResolution != 0 || first.width % 2 != 0)
    return misfit("blade texels are no multiple of slice texels");
  const std::size_t owners = 2 * set.tiles.size() * static_cast<std::size_t>(set.resolution / slabTexels) *
                             static_cast<std::size_t>(set.resolution);
  if (ground.bladeOwners.size() != owners) return misfit("blade owners are missing");
  for (const tiles::BladeOwner& owner : ground.bladeOwners)
    if (owner.slab >= blades || owner.position >= set.patchResolution) return misfit("a blade owner is off the patch");
  return {};
}

bool bladesPresent(const bake::GroundBake& ground) {
  return !ground.blades[0].surface.empty();
}

/// Weights of the quantised coefficients and the constants that their bases add, so that A, B and C of a column are
/// constant + sum of weight times byte: b = q / scale - base, times the light's functions (equation 5).
struct LightTerms {
  std::array<float, 20> weights{};
  std::array<float, 6> constants{};
};

LightTerms lightTerms(lpt::Basis basis, int channels, std::span<const lpt::CoefficientRange> ranges,
                      const glm::dvec3& light) {
  const double x = light.x, y = light.y;
  const std::array<double, 10> lptFunctions{x * x,   y * y,   1.0,     2.0 * x * y, 2.0 * x,
                                            2.0 * y, 2.0 * x, 2.0 * y, 2.0,         1.0};
  // Which of A, B, C a coefficient goes to: b2 is C, b4, b5, b8 make B.
  constexpr std::array<int, 10> lptTerm{0, 0, 2, 0, 1, 1, 0, 0, 1, 0};
  const std::array<double, 6> ptmFunctions{x * x, y * y, 2.0 * x * y, 2.0 * x, 2.0 * y, 1.0};
  const int count = basis == lpt::Basis::Lpt ? 10 : 6;
  LightTerms terms;
  std::array<double, 6> constants{};
  for (int c = 0; c < channels; ++c) {
    for (int j = 0; j < count; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const lpt::CoefficientRange& range = ranges[static_cast<std::size_t>(c * count + j)];
      const double function = basis == lpt::Basis::Lpt ? lptFunctions[at] : ptmFunctions[at];
      const int term = basis == lpt::Basis::Lpt ? lptTerm[at] : 0;
      if (range.scale > 0.0f)
        terms.weights[static_cast<std::size_t>(c * 10 + j)] =
            static_cast<float>(function / static_cast<double>(range.scale));
      constants[static_cast<std::size_t>(c * 3 + term)] -= function * static_cast<double>(range.base);
    }
  }
  for (std::size_t i = 0; i < constants.size(); ++i) terms.constants[i] = static_cast<float>(constants[i]);
  return terms;
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
  SWARD_TRY(checkSlices(ground));
  const bool blades = bladesPresent(ground);
  if (blades) SWARD_TRY(checkBlades(ground));
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
  SWARD_ASSIGN(gpu::Program * program, programs.compute("relight/bind_blades.comp", {}, {"u_patchSize", "u_outBase"}));
  const glm::ivec2 outSize(m_bladeLayout.width, m_bladeLayout.height);
  program->use();
  program->set("t_patch", 0);
  program->set("t_owners", 1);
  m_patchView.bind(0);
  m_ownersView.bind(1);
  program->set("u_patchSize", patchSize);
  program->set("u_outSize", outSize);
  program->set("u_slabs", m_patchSlabs);
  program->set("u_reversed", side % 2 == 0 ? 1 : 0);  // seen from +x or +y: layer 0 is the last slab
  program->set("u_ownerTexels", m_tileTexels);
  program->set("u_texelsPerOwner", outSize.x / m_tileTexels);
  program->set("u_outBase", static_cast<int>(m_bases[side + 1]));
  program->set("u_ownerBase", side < 2 ? 0 : m_tiles * m_slabs * m_tileTexels);
  m_relit.bindStorage(0);
  gpu::gl().DispatchCompute(groups(outSize.x), groups(outSize.y), static_cast<unsigned>(m_tiles * m_slabs));
  return makeMips(programs, side + 1, 1);
}

Result<void> RelitGround::relightStack(ProgramCache& programs, const Stack& stack, const Target& target) {
  const bool withMip = target.base1 != 0;
  const int block = withMip ? 2 : 1;
  const Defines defines{{"SWARD_LPT", stack.basis == lpt::Basis::Lpt ? "1" : "0"},
                        {"SWARD_CHANNELS", std::to_string(stack.channels)},
                        {"SWARD_BITS", std::to_string(stack.bits)},
                        {"SWARD_TRANSMISSION", stack.transmits ? "1" : "0"},
                        {"SWARD_BLOCK", std::to_string(block)}};
  SWARD_ASSIGN(gpu::Program * program,
               programs.compute("relight/relight.comp", defines, {"t_coefficients", "t_surface", "t_sky", "u_sun"}));
  const LightTerms terms = lightTerms(stack.basis, stack.channels, stack.ranges, m_light.sunDirection);
  program->use();
  program->set("t_coefficients", 0);
  program->set("t_surface", 1);
  program->set("t_sky", 2);
  setIfUsed(*program, "t_transmission", 3);
  stack.coefficientsView.bind(0);
  stack.surfaceView.bind(1);
  stack.skyView.bind(2);
  stack.transmissionView.bind(3);
  program->set("u_weights", std::span<const float>(terms.weights));
  program->set("u_constants", std::span<const float>(terms.constants));
  program->set("u_sun", glm::vec3(m_light.sunIrradiance / std::numbers::pi / m_scale));
  program->set("u_skyLight", glm::vec3(m_light.skyRadiance / m_scale));
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
