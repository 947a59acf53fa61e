#include "render/texel_set.h"

#include "base/parallel.h"
#include "base/random.h"
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
constexpr std::size_t kVoxelWords = 2;
constexpr std::size_t kGrain = 64;
constexpr int kMostEmptyPower = 6;     ///< a ray passes empty cubes of up to 64 voxels in one step
constexpr std::size_t kFarLevels = 2;  ///< how much coarser what shades from afar may be

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

/// The upper half of the sphere on two bytes: a normal and its opposite are one.
std::uint32_t hemisphere(const glm::vec3& normal) {
  const glm::vec3 up = normal.z < 0.0f ? -normal : normal;
  const float sum = std::abs(up.x) + std::abs(up.y) + up.z;
  const auto code = [sum](float v) {
    return static_cast<std::uint32_t>(sum > 0.0f ? std::lround(v / sum * 127.0f) + 128 : 128);
  };
  return code(up.x) | code(up.y) << 8;
}

/// Extinctions along the normal and across it, 1/m: wither/extinction.h of S = share n n^T + (1 - share) I / 3.
glm::dvec2 extinctions(const Voxel& voxel) {
  const double share = wither::normalShare(voxel);
  const glm::dvec2 eigen(1.0 + 2.0 * share, 1.0 - share);
  return double{voxel.density} * glm::sqrt(eigen / 3.0 * (5.0 + eigen) / 8.0);
}

std::uint32_t mediumWord(const Voxel& voxel, double range) {
  const glm::dvec2 extinction = extinctions(voxel);
  const std::uint32_t along = std::max(byteOf(std::sqrt(extinction.x / range)), 1u);
  return hemisphere(voxel.normal) | byteOf(extinction.y / extinction.x) << 16 | along << 24;
}

/// Five, six and five bits of the square root over the range, rounded up or down by lot: the mean of many has no steps.
std::uint32_t colour16(const glm::vec3& radiance, double range, std::uint32_t lots) {
  const auto code = [&](float v, double levels, int shift) {
    const double root = std::sqrt(std::clamp(static_cast<double>(v) / range, 0.0, 1.0));
    return static_cast<std::uint32_t>(root * levels + static_cast<double>(lots >> shift & 0x3ffu) / 1024.0);
  };
  return code(radiance.r, 31.0, 0) | code(radiance.g, 63.0, 10) << 5 | code(radiance.b, 31.0, 20) << 11;
}

std::uint32_t colourWord(const Voxel& voxel, const wither::LitVoxel& lit, double range, std::uint64_t lots) {
  // The medium's normal points up: colours are kept by its sides. Without a normal both sides are the front.
  const bool none = voxel.normal == glm::vec3(0.0f);
  const glm::vec3& upper = voxel.normal.z < 0.0f ? lit.back : lit.front;
  const glm::vec3& lower = voxel.normal.z < 0.0f || none ? lit.front : lit.back;
  return colour16(upper, range, static_cast<std::uint32_t>(lots)) |
         colour16(lower, range, static_cast<std::uint32_t>(lots >> 32)) << 16;
}

/// Of a voxel (x, y, z) in its brick, given as (z * 8 + y) * 8 + x: eight that form a cube follow each other, so that
/// they lie in one line of the processor's cache.
std::size_t placeOf(std::size_t v) {
  const std::size_t x = v & 7, y = v >> 3 & 7, z = v >> 6;
  return (z >> 1) << 7 | (y >> 1) << 5 | (x >> 1) << 3 | (z & 1) << 2 | (y & 1) << 1 | (x & 1);
}

/// -1 - power for every empty brick: the largest aligned cube of 2^power voxels round it that is empty and lies in the
/// grid; others stay.
void markEmptyBricks(const wither::TexelGrid& grid, std::span<std::int32_t> bricks) {
  const glm::ivec3 size = grid.size() / kBrick;
  const auto at = [&](int x, int y, int z) { return static_cast<std::size_t>((z * size.y + y) * size.x + x); };
  for (int power = 1; power <= kMostEmptyPower - 3; ++power) {
    const int side = 1 << power;
    if (size.x % side != 0 || size.z % side != 0) return;
    for (int z = 0; z < size.z; z += side)
      for (int y = 0; y < size.y; y += side)
        for (int x = 0; x < size.x; x += side) {
          bool empty = true;
          const auto inside = [&](int i) { return at(x + i % side, y + i / side % side, z + i / (side * side)); };
          for (int i = 0; i < side * side * side && empty; ++i) empty = bricks[inside(i)] < 0;
          for (int i = 0; i < side * side * side && empty; ++i) bricks[inside(i)] = -4 - power;
        }
  }
}

template <typename T>
gpu::Buffer bufferOf(const std::vector<T>& values) {
  return gpu::Buffer(std::as_bytes(std::span(values)));
}

}  // namespace

Result<TexelSet> TexelSet::create(std::shared_ptr<const bake::TexelBake> bake) {
  if (!bake || bake->levels.empty()) return Error::failed("there are no texels", "render");
  std::size_t places = 0;
  for (const auto& level : bake->levels) places += level.texel->stored().size() * kBrickVoxels;
  if (places * kVoxelWords > kMostTexels) {
    return Error::failed("the texel has more voxels than the renderer can hold", "wither.texel.resolution",
                         "Lower wither.texel.resolution, or plant less on the patch.");
  }
  TexelSet set;
  std::vector<std::int32_t> bricks;
  std::size_t firstPlace = 0;
  for (const auto& level : bake->levels) {
    const Texel& texel = *level.texel;
    const std::size_t firstBrick = bricks.size();
    set.m_levelStarts.push_back(static_cast<int>(firstBrick));
    for (const std::int32_t stored : texel.bricks()) {
      bricks.push_back(
          stored < 0 ? -4 : static_cast<std::int32_t>(firstPlace + static_cast<std::size_t>(stored) * kBrickVoxels));
    }
    markEmptyBricks(texel.grid(), std::span(bricks).subspan(firstBrick));
    firstPlace += texel.stored().size() * kBrickVoxels;
    for (const Voxel& voxel : texel.voxels()) {
      set.m_extinctionRange = std::max(set.m_extinctionRange, extinctions(voxel).x);
    }
  }
  set.m_places = places;
  set.m_bricks = bufferOf(bricks);
  set.m_bricksView = gpu::Texture::ofBuffer(GL_R32I, set.m_bricks);
  set.m_bake = std::move(bake);
  return set;
}

void TexelSet::fillBricks(const Texel& texel, const wither::LitTexel& lit, std::size_t first, const JobContext& job,
                          std::vector<std::uint32_t>& voxels, std::vector<std::uint32_t>& glosses) const {
  base::parallelFor(job, texel.stored().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const Texel::Brick& brick = texel.stored()[b];
      std::size_t at = brick.first;
      for (std::size_t v = 0; v < kBrickVoxels; ++v) {
        if ((brick.mask[v / 64] >> (v % 64) & 1) == 0) continue;
        const std::size_t place = first + b * kBrickVoxels + placeOf(v);
        const Voxel& voxel = texel.voxels()[at];
        voxels[place * kVoxelWords] = mediumWord(voxel, m_extinctionRange);
        voxels[place * kVoxelWords + 1] = colourWord(voxel, lit.voxels[at], m_radianceRange, base::mix64(place));
        glosses[place] = octahedral(voxel.tangent) | byteOf(double{voxel.specular} * double{lit.voxels[at].sun}) << 16;
        ++at;
      }
    }
  });
}

Result<void> TexelSet::relight(const wither::TexelLight& light, const JobContext& job) {
  m_radianceRange = brightest(light);
  std::vector<std::uint32_t> voxels(m_places * kVoxelWords, 0), glosses(m_places, 0);
  std::vector<std::uint32_t> soil(m_bake->soil.size());
  std::size_t first = 0;
  for (std::size_t l = 0; l < m_bake->levels.size(); ++l) {
    const auto& level = m_bake->levels[l];
    const wither::Texel* coarse =
        l + kFarLevels < m_bake->levels.size() ? m_bake->levels[l + kFarLevels].texel.get() : nullptr;
    SWARD_ASSIGN(const wither::LitTexel lit, wither::lightTexel(*level.texel, coarse, level.sky, light, job));
    fillBricks(*level.texel, lit, first, job, voxels, glosses);
    first += level.texel->stored().size() * kBrickVoxels;
    for (std::size_t i = 0; l == 0 && i < soil.size(); ++i) {
      const glm::dvec3 sun = light.sunIrradiance * (std::max(light.toSun.z, 0.0) / std::numbers::pi);
      const glm::dvec3 irradiance = sun * double{lit.groundSun[i]} + light.skyRadiance * double{level.sky.ground[i]};
      soil[i] = colour30(glm::vec3(glm::dvec3(m_bake->soil[i]) * irradiance), m_radianceRange);
    }
  }
  if (job.stop.stop_requested()) return Error::cancelled();
  m_voxels = bufferOf(voxels);
  m_voxelsView = gpu::Texture::ofBuffer(GL_R32UI, m_voxels);
  m_glosses = bufferOf(glosses);
  m_glossesView = gpu::Texture::ofBuffer(GL_R32UI, m_glosses);
  m_soil = bufferOf(soil);
  m_soilView = gpu::Texture::ofBuffer(GL_R32UI, m_soil);
  return {};
}

std::uint64_t TexelSet::bytes() const {
  return m_bricks.size() + m_voxels.size() + m_glosses.size() + m_soil.size();
}

void TexelSet::bind(GLuint first) const {
  m_bricksView.bind(first);
  m_voxelsView.bind(first + 1);
  m_glossesView.bind(first + 2);
  m_soilView.bind(first + 3);
}

}  // namespace sward::render
