#include "render/texel_set.h"

#include "base/parallel.h"
#include "wither/extinction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

namespace sward::render {
namespace {

using wither::Texel;
using wither::Voxel;

constexpr int kBrick = wither::TexelGrid::kBrick;
constexpr std::size_t kBrickVoxels = std::size_t{kBrick} * kBrick * kBrick;
constexpr std::size_t kGrain = 4096;

/// Texels of a texture buffer: what Mesa's software renderer and common GPUs take (OpenGL grants 2^16 alone).
constexpr std::size_t kMostTexels = std::size_t{1} << 27;

std::uint32_t byteOf(double value) {
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

/// Two bytes; 0 is kept for no direction: the code of no unit vector, whose coordinates are stored from 1 on.
std::uint32_t octahedral(const glm::vec3& direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  if (!(sum > 0.0f)) return 0;
  glm::vec2 p = glm::vec2(direction) / sum;
  if (direction.z < 0.0f) {
    p = glm::vec2((1.0f - std::abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f),
                  (1.0f - std::abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f));
  }
  const auto code = [](float v) { return static_cast<std::uint32_t>(std::lround(v * 127.0f) + 128); };
  return code(p.x) | code(p.y) << 8;
}

std::uint32_t colour30(const glm::vec3& radiance, double range) {
  const auto code = [range](float v) {
    return static_cast<std::uint32_t>(
        std::lround(std::sqrt(std::clamp(static_cast<double>(v) / range, 0.0, 1.0)) * 1023.0));
  };
  return code(radiance.r) | code(radiance.g) << 10 | code(radiance.b) << 20;
}

/// Radiance of a white, opaque leaf that faces a sun it sees wholly, under all of the sky: no leaf is brighter.
double brightest(const wither::TexelLight& light) {
  const glm::dvec3 radiance = light.sunIrradiance / std::numbers::pi + light.skyRadiance;
  return std::max({radiance.r, radiance.g, radiance.b, 1e-9});
}

std::array<std::uint32_t, 4> leafWords(const Voxel& voxel, const wither::LitVoxel& lit, double densityRange,
                                       double radianceRange) {
  const std::uint32_t density = std::max(byteOf(std::sqrt(double{voxel.density} / densityRange)), 1u);
  return {octahedral(voxel.normal) | octahedral(voxel.tangent) << 16, colour30(lit.front, radianceRange),
          colour30(lit.back, radianceRange),
          density | byteOf(wither::normalShare(voxel)) << 8 | byteOf(double{voxel.specular} * double{lit.sun}) << 16};
}

std::size_t leafCount(const bake::TexelBake& bake) {
  std::size_t count = 0;
  for (const auto& level : bake.levels) count += level.texel->size();
  return count;
}

/// Bricks and voxels of all levels, which name leaves in the order of the levels' voxels.
struct Places {
  std::vector<std::int32_t> bricks;
  std::vector<std::uint32_t> voxels;
  std::vector<int> levelStarts;
};

Places placesOf(const bake::TexelBake& bake) {
  Places places;
  std::uint32_t firstLeaf = 0;
  for (const auto& level : bake.levels) {
    const Texel& texel = *level.texel;
    const std::size_t firstWord = places.voxels.size();
    places.levelStarts.push_back(static_cast<int>(places.bricks.size()));
    for (const std::int32_t stored : texel.bricks()) {
      places.bricks.push_back(
          stored < 0 ? -1 : static_cast<std::int32_t>(firstWord + static_cast<std::size_t>(stored) * kBrickVoxels));
    }
    places.voxels.resize(firstWord + texel.stored().size() * kBrickVoxels, 0);
    for (std::size_t b = 0; b < texel.stored().size(); ++b) {
      const Texel::Brick& brick = texel.stored()[b];
      std::uint32_t index = firstLeaf + brick.first;
      for (std::size_t v = 0; v < kBrickVoxels; ++v) {
        if ((brick.mask[v / 64] >> (v % 64) & 1) != 0) places.voxels[firstWord + b * kBrickVoxels + v] = ++index;
      }
    }
    firstLeaf += static_cast<std::uint32_t>(texel.size());
  }
  return places;
}

template <typename T>
gpu::Buffer bufferOf(const std::vector<T>& values) {
  return gpu::Buffer(std::as_bytes(std::span(values)));
}

}  // namespace

Result<TexelSet> TexelSet::create(std::shared_ptr<const bake::TexelBake> bake) {
  if (!bake || bake->levels.empty()) return Error::failed("there are no texels", "render");
  std::size_t words = 0;
  for (const auto& level : bake->levels) words += level.texel->stored().size() * kBrickVoxels;
  if (std::max(words, leafCount(*bake)) > kMostTexels) {
    return Error::failed("the texel has more voxels than the renderer can hold", "wither.texel.resolution",
                         "Lower wither.texel.resolution, or plant less on the patch.");
  }
  TexelSet set;
  for (const auto& level : bake->levels) {
    for (const Voxel& voxel : level.texel->voxels()) {
      set.m_densityRange = std::max(set.m_densityRange, double{voxel.density});
    }
  }
  const Places places = placesOf(*bake);
  set.m_levelStarts = places.levelStarts;
  set.m_bricks = bufferOf(places.bricks);
  set.m_voxels = bufferOf(places.voxels);
  set.m_bricksView = gpu::Texture::ofBuffer(GL_R32I, set.m_bricks);
  set.m_voxelsView = gpu::Texture::ofBuffer(GL_R32UI, set.m_voxels);
  set.m_bake = std::move(bake);
  return set;
}

Result<void> TexelSet::relight(const wither::TexelLight& light, const JobContext& job) {
  m_radianceRange = brightest(light);
  std::vector<std::array<std::uint32_t, 4>> leaves;
  leaves.reserve(leafCount(*m_bake));
  std::vector<std::uint32_t> soil(m_bake->soil.size());
  for (std::size_t l = 0; l < m_bake->levels.size(); ++l) {
    const auto& level = m_bake->levels[l];
    SWARD_ASSIGN(const wither::LitTexel lit, wither::lightTexel(*level.texel, level.sky, light, job));
    const std::size_t first = leaves.size();
    leaves.resize(first + level.texel->size());
    const std::span<const Voxel> voxels = level.texel->voxels();
    base::parallelFor(job, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        leaves[first + i] = leafWords(voxels[i], lit.voxels[i], m_densityRange, m_radianceRange);
      }
    });
    for (std::size_t i = 0; l == 0 && i < soil.size(); ++i) {
      const glm::dvec3 sun = light.sunIrradiance * (std::max(light.toSun.z, 0.0) / std::numbers::pi);
      const glm::dvec3 irradiance = sun * double{lit.groundSun[i]} + light.skyRadiance * double{level.sky.ground[i]};
      soil[i] = colour30(glm::vec3(glm::dvec3(m_bake->soil[i]) * irradiance), m_radianceRange);
    }
  }
  m_leaves = bufferOf(leaves);
  m_leavesView = gpu::Texture::ofBuffer(GL_RGBA32UI, m_leaves);
  m_soil = bufferOf(soil);
  m_soilView = gpu::Texture::ofBuffer(GL_R32UI, m_soil);
  return {};
}

std::uint64_t TexelSet::bytes() const {
  return m_bricks.size() + m_voxels.size() + m_leaves.size() + m_soil.size();
}

void TexelSet::bind(GLuint bricks, GLuint voxels, GLuint leaves, GLuint soil) const {
  m_bricksView.bind(bricks);
  m_voxelsView.bind(voxels);
  m_leavesView.bind(leaves);
  m_soilView.bind(soil);
}

}  // namespace sward::render
