#include "render/texel_set.h"

#include "base/parallel.h"
#include "base/random.h"
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
constexpr std::size_t kVoxelWords = 2;
constexpr std::size_t kGrain = 4096;
constexpr std::size_t kBrickGrain = 64;
constexpr int kMostEmptyPower = 6;  ///< a ray passes empty cubes of up to 64 voxels in one step

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

/// The upper half of the sphere on two bytes: a normal and its opposite are one.
std::uint32_t hemisphere(const glm::vec3& normal) {
  const float sum = std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z);
  const float scale = sum > 0.0f ? (normal.z < 0.0f ? -127.0f : 127.0f) / sum : 0.0f;
  return nearest(normal.x * scale + 128.0f) | nearest(normal.y * scale + 128.0f) << 8;
}

/// Extinctions along the normal and across it, 1/m: wither/extinction.h of S = share n n^T + (1 - share) I / 3.
glm::vec2 extinctions(float density, float share) {
  const glm::vec2 eigen(1.0f + 2.0f * share, 1.0f - share);
  return density * glm::sqrt(eigen * (5.0f + eigen) * (1.0f / 24.0f));
}

/// One over the ranges that words are kept in.
struct PerRange {
  float extinction = 1.0f, radiance = 1.0f;
};

std::uint32_t mediumWord(const Voxel& voxel, float share, const PerRange& per) {
  const glm::vec2 extinction = extinctions(voxel.density, share);
  const std::uint32_t along = std::max(byteOf(std::sqrt(extinction.x * per.extinction)), 1u);
  return hemisphere(voxel.normal) | byteOf(extinction.y / extinction.x) << 16 | along << 24;
}

/// Five, six and five bits of the square root over the range, rounded up or down by lot: the mean of many has no steps.
std::uint32_t colour16(const glm::vec3& radiance, float perRange, std::uint32_t lots) {
  const auto code = [&](float v, float levels, int shift) {
    const float lot = static_cast<float>(lots >> shift & 0x3ffu) * (1.0f / 1024.0f);
    return static_cast<std::uint32_t>(std::sqrt(std::clamp(v * perRange, 0.0f, 1.0f)) * levels + lot);
  };
  return code(radiance.r, 31.0f, 0) | code(radiance.g, 63.0f, 10) << 5 | code(radiance.b, 31.0f, 20) << 11;
}

std::uint32_t colourWord(const Voxel& voxel, const wither::LitVoxel& lit, float perRange, std::uint64_t lots) {
  // The medium's normal points up: colours are kept by its sides. Without a normal both sides are the front.
  const bool none = voxel.normal == glm::vec3(0.0f);
  const glm::vec3& upper = voxel.normal.z < 0.0f ? lit.back : lit.front;
  const glm::vec3& lower = voxel.normal.z < 0.0f || none ? lit.front : lit.back;
  return colour16(upper, perRange, static_cast<std::uint32_t>(lots)) |
         colour16(lower, perRange, static_cast<std::uint32_t>(lots >> 32)) << 16;
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

/// The largest extinction of them, 1/m.
float mostExtinction(std::span<const Voxel> voxels) {
  std::vector<float> most((voxels.size() + kGrain - 1) / kGrain, 0.0f);
  base::parallelFor({}, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto share = static_cast<float>(wither::normalShare(voxels[i]));
      most[begin / kGrain] = std::max(most[begin / kGrain], extinctions(voxels[i].density, share).x);
    }
  });
  return most.empty() ? 0.0f : *std::max_element(most.begin(), most.end());
}

/// Sums of a level's leaves, weighted by their area and by how much of the sky they see, as an eye above may see them.
struct PhaseSums {
  double weight = 0.0, unordered = 0.0;
  glm::dvec3 reflected{0.0}, passed{0.0}, sun{0.0}, all{0.0};

  void add(const Voxel& voxel, float share, float sky, const glm::vec3& fromSun, const wither::LitVoxel& lit) {
    const double w = double{voxel.density} * double{sky};
    weight += w;
    unordered += w * (1.0 - double{share});
    reflected += w * glm::dvec3(voxel.diffuse);
    passed += w * glm::dvec3(voxel.transmitted);
    sun += w * glm::dvec3(fromSun * (voxel.diffuse + voxel.transmitted));
    all += w * glm::dvec3(lit.front + lit.back);
  }
  void add(const PhaseSums& other) {
    weight += other.weight, unordered += other.unordered;
    reflected += other.reflected, passed += other.passed, sun += other.sun, all += other.all;
  }
  wither::PhaseMeans means() const {
    wither::PhaseMeans out;
    if (weight > 0.0) out.unordered = unordered / weight;
    for (int c = 0; c < 3; ++c) {
      if (reflected[c] > 0.0) out.passed[c] = passed[c] / reflected[c];
      if (all[c] > 0.0) out.sun[c] = std::min(sun[c] / all[c], 1.0);
    }
    return out;
  }
};

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
    set.m_extinctionRange = std::max(set.m_extinctionRange, double{mostExtinction(texel.voxels())});
  }
  set.m_places = places;
  set.m_bricks = bufferOf(bricks);
  set.m_bricksView = gpu::Texture::ofBuffer(GL_R32I, set.m_bricks);
  set.m_bake = std::move(bake);
  return set;
}

Result<void> TexelSet::relight(const wither::TexelLight& light, const JobContext& job) {
  m_radianceRange = brightest(light);
  const PerRange per{static_cast<float>(1.0 / m_extinctionRange), static_cast<float>(1.0 / m_radianceRange)};
  const wither::LeafShading shading(light);
  const glm::vec3 toSun(light.toSun);
  std::vector<std::uint32_t> words(m_places * kVoxelWords, 0), glosses(m_places, 0);
  std::size_t first = 0;
  m_phases.clear();
  for (const auto& level : m_bake->levels) {
    const Texel& texel = *level.texel;
    SWARD_ASSIGN(const wither::SunReach reach, wither::sunReach(texel, light.toSun, job));
    std::vector<PhaseSums> sums((texel.stored().size() + kBrickGrain - 1) / kBrickGrain);
    const auto fill = [&](std::size_t place, std::size_t i, PhaseSums& sum) {
      const Voxel& voxel = texel.voxels()[i];
      const auto share = static_cast<float>(wither::normalShare(voxel));
      const float sun = reach.voxels[i] * wither::throughOwnLeaves(texel.grid(), voxel, share, toSun);
      const wither::LitVoxel lit = shading(voxel, share, level.sky.front[i], level.sky.back[i], sun);
      words[place * kVoxelWords] = mediumWord(voxel, share, per);
      words[place * kVoxelWords + 1] = colourWord(voxel, lit, per.radiance, base::mix64(place));
      sum.add(voxel, share, level.sky.front[i] + level.sky.back[i], shading.fromSun(voxel, share, sun), lit);
      glosses[place] = octahedral(voxel.tangent) | byteOf(voxel.specular * sun) << 16;
    };
    base::parallelFor(job, texel.stored().size(), kBrickGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        const Texel::Brick& brick = texel.stored()[b];
        std::size_t i = brick.first;
        for (std::size_t z = 0; z < brick.mask.size(); ++z) {
          for (std::uint64_t bits = brick.mask[z]; bits != 0; bits &= bits - 1) {
            const std::size_t v = z * 64 + static_cast<std::size_t>(std::countr_zero(bits));
            fill(first + b * kBrickVoxels + placeOf(v), i++, sums[begin / kBrickGrain]);
          }
        }
      }
    });
    PhaseSums whole;
    for (const PhaseSums& some : sums) whole.add(some);
    m_phases.push_back(whole.means());
    if (&level == m_bake->levels.data()) setSoil(light, reach.ground, per.radiance);
    first += texel.stored().size() * kBrickVoxels;
  }
  if (job.cancelled()) return Error::cancelled();
  if (m_voxels.size() == 0) {
    m_voxels = gpu::Buffer(std::span(words).size_bytes());
    m_voxelsView = gpu::Texture::ofBuffer(GL_R32UI, m_voxels);
    m_glosses = gpu::Buffer(std::span(glosses).size_bytes());
    m_glossesView = gpu::Texture::ofBuffer(GL_R32UI, m_glosses);
  }
  m_voxels.write(std::as_bytes(std::span(words)));
  m_glosses.write(std::as_bytes(std::span(glosses)));
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
  return m_bricks.size() + m_voxels.size() + m_glosses.size() + m_soil.size();
}

void TexelSet::bind(GLuint first) const {
  m_bricksView.bind(first);
  m_voxelsView.bind(first + 1);
  m_glossesView.bind(first + 2);
  m_soilView.bind(first + 3);
}

}  // namespace sward::render
