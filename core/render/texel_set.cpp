#include "render/texel_set.h"

#include "base/parallel.h"
#include "wither/extinction.h"

#include <algorithm>
#include <array>
#include <bit>
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

/// Of what is not below 0, to the nearest whole number.
std::uint32_t nearest(float value) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(value + 0.5f));
}

std::uint32_t byteOf(float value) {
  return nearest(std::clamp(value, 0.0f, 1.0f) * 255.0f);
}

/// Two bytes; 0 is kept for no direction: the code of no unit vector, whose coordinates are stored from 1 on.
std::uint32_t octahedral(const glm::vec3& direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  if (!(sum > 0.0f)) return 0;
  glm::vec2 p = glm::vec2(direction) * (1.0f / sum);
  if (direction.z < 0.0f) {
    p = glm::vec2((1.0f - std::abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f),
                  (1.0f - std::abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f));
  }
  const auto code = [](float v) { return nearest(std::clamp(v, -1.0f, 1.0f) * 127.0f + 128.0f); };
  return code(p.x) | code(p.y) << 8;
}

std::uint32_t colour30(const glm::vec3& radiance, float perRange) {
  const auto code = [perRange](float v) { return nearest(std::sqrt(std::clamp(v * perRange, 0.0f, 1.0f)) * 1023.0f); };
  return code(radiance.r) | code(radiance.g) << 10 | code(radiance.b) << 20;
}

/// Radiance of a white, opaque leaf that faces a sun it sees wholly, under all of the sky: no leaf is brighter.
double brightest(const wither::TexelLight& light) {
  const glm::dvec3 radiance = light.sunIrradiance / std::numbers::pi + light.skyRadiance;
  return std::max({radiance.r, radiance.g, radiance.b, 1e-9});
}

/// One over the ranges that the words of leaves are kept in.
struct PerRange {
  float density = 1.0f, radiance = 1.0f;
};

std::array<std::uint32_t, 4> leafWords(const Voxel& voxel, float share, const wither::LitVoxel& lit, float sun,
                                       const PerRange& per) {
  const std::uint32_t density = std::max(byteOf(std::sqrt(voxel.density * per.density)), 1u);
  return {octahedral(voxel.normal) | octahedral(voxel.tangent) << 16, colour30(lit.front, per.radiance),
          colour30(lit.back, per.radiance), density | byteOf(share) << 8 | byteOf(voxel.specular * sun) << 16};
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
    base::parallelFor({}, texel.stored().size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        const Texel::Brick& brick = texel.stored()[b];
        std::uint32_t* words = places.voxels.data() + firstWord + b * kBrickVoxels;
        std::uint32_t index = firstLeaf + brick.first;
        for (std::size_t z = 0; z < brick.mask.size(); ++z) {
          for (std::uint64_t bits = brick.mask[z]; bits != 0; bits &= bits - 1) {
            words[z * 64 + static_cast<std::size_t>(std::countr_zero(bits))] = ++index;
          }
        }
      }
    });
    firstLeaf += static_cast<std::uint32_t>(texel.size());
  }
  return places;
}

float densest(std::span<const Voxel> voxels) {
  std::vector<float> most((voxels.size() + kGrain - 1) / kGrain, 0.0f);
  base::parallelFor({}, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) most[begin / kGrain] = std::max(most[begin / kGrain], voxels[i].density);
  });
  return most.empty() ? 0.0f : *std::max_element(most.begin(), most.end());
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
    set.m_densityRange = std::max(set.m_densityRange, double{densest(level.texel->voxels())});
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
  const PerRange per{static_cast<float>(1.0 / m_densityRange), static_cast<float>(1.0 / m_radianceRange)};
  const wither::LeafShading shading(light);
  const std::size_t count = leafCount(*m_bake);
  const auto leaves = std::make_unique_for_overwrite<std::array<std::uint32_t, 4>[]>(count);
  std::size_t first = 0;
  for (const auto& level : m_bake->levels) {
    SWARD_ASSIGN(const wither::SunReach reach, wither::sunReach(*level.texel, light.toSun, job));
    const std::span<const Voxel> voxels = level.texel->voxels();
    base::parallelFor(job, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto share = static_cast<float>(wither::normalShare(voxels[i]));
        const wither::LitVoxel lit = shading(voxels[i], share, level.sky.front[i], level.sky.back[i], reach.voxels[i]);
        leaves[first + i] = leafWords(voxels[i], share, lit, reach.voxels[i], per);
      }
    });
    if (&level == m_bake->levels.data()) setSoil(light, reach.ground, per.radiance);
    first += voxels.size();
  }
  if (job.cancelled()) return Error::cancelled();
  const std::span<const std::array<std::uint32_t, 4>> words(leaves.get(), count);
  if (m_leaves.size() == 0) {
    m_leaves = gpu::Buffer(words.size_bytes());
    m_leavesView = gpu::Texture::ofBuffer(GL_RGBA32UI, m_leaves);
  }
  m_leaves.write(std::as_bytes(words));
  return {};
}

void TexelSet::setSoil(const wither::TexelLight& light, std::span<const float> groundSun, float perRange) {
  const glm::dvec3 sun = light.sunIrradiance * (std::max(light.toSun.z, 0.0) / std::numbers::pi);
  const std::vector<float>& sky = m_bake->levels.front().sky.ground;
  std::vector<std::uint32_t> soil(m_bake->soil.size());
  for (std::size_t i = 0; i < soil.size(); ++i) {
    const glm::dvec3 irradiance = sun * double{groundSun[i]} + light.skyRadiance * double{sky[i]};
    soil[i] = colour30(glm::vec3(glm::dvec3(m_bake->soil[i]) * irradiance), perRange);
  }
  m_soil = bufferOf(soil);
  m_soilView = gpu::Texture::ofBuffer(GL_R32UI, m_soil);
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
