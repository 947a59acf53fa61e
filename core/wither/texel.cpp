#include "wither/texel.h"

#include "base/check.h"
#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace sward::wither {
namespace {

constexpr int kBrick = TexelGrid::kBrick;

std::string text(const glm::ivec3& at) {
  return "(" + std::to_string(at.x) + ", " + std::to_string(at.y) + ", " + std::to_string(at.z) + ")";
}

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const Voxel& voxel) {
  return std::isfinite(voxel.density) && std::isfinite(voxel.specular) && finite(voxel.normal) &&
         finite(voxel.tangent) && finite(voxel.diffuse) && finite(voxel.transmitted) &&
         std::all_of(voxel.spread.begin(), voxel.spread.end(), [](float s) { return std::isfinite(s); });
}

std::size_t countOf(const std::array<std::uint64_t, 8>& mask) {
  int count = 0;
  for (const std::uint64_t word : mask) count += std::popcount(word);
  return static_cast<std::size_t>(count);
}

/// Index of the brick and of the voxel in it.
struct Place {
  std::uint32_t brick = 0, voxel = 0;
};

Place placeOf(const TexelGrid& grid, const glm::ivec3& at) {
  const glm::ivec3 brick = at / kBrick, within = at % kBrick;
  const int row = grid.columns / kBrick;
  return {static_cast<std::uint32_t>((brick.z * row + brick.y) * row + brick.x),
          static_cast<std::uint32_t>((within.z * kBrick + within.y) * kBrick + within.x)};
}

}  // namespace

Result<void> checkGrid(const TexelGrid& grid) {
  const bool whole = grid.columns > 0 && grid.layers > 0 && grid.columns % kBrick == 0 && grid.layers % kBrick == 0;
  if (!whole || grid.columns > 4096 || grid.layers > 4096) {
    return Error::badInput("a texel of " + std::to_string(grid.columns) + " columns and " +
                               std::to_string(grid.layers) + " layers is not of whole bricks",
                           "texel", "Both must be multiples of 8, from 8 to 4096.");
  }
  const bool sized = std::isfinite(grid.sideM) && std::isfinite(grid.heightM) && grid.sideM > 0.0 && grid.heightM > 0.0;
  if (!sized) return Error::badInput("a texel needs a side and a height above 0 m", "texel", "Give both in metres.");
  return {};
}

Result<Texel> Texel::fromEntries(const TexelGrid& grid, std::vector<Entry> entries) {
  SWARD_TRY(checkGrid(grid));
  std::erase_if(entries, [](const Entry& entry) { return entry.voxel.density == 0.0f; });
  const glm::ivec3 size = grid.size();
  std::vector<std::uint64_t> order(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const glm::ivec3& at = entries[i].at;
    if (glm::any(glm::lessThan(at, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(at, size))) {
      return Error::badInput("voxel " + text(at) + " lies outside the texel", "texel",
                             "Places must be inside its " + text(size) + " voxels.");
    }
    if (!finite(entries[i].voxel) || entries[i].voxel.density < 0.0f) {
      return Error::badInput("voxel " + text(at) + " holds a value that is not finite, or a negative density", "texel",
                             "Check what the voxel was made from.");
    }
    const Place place = placeOf(grid, at);
    order[i] = std::uint64_t{place.brick} << 9 | place.voxel;
  }
  std::vector<std::uint32_t> sorted(entries.size());
  std::iota(sorted.begin(), sorted.end(), 0u);
  if (!std::is_sorted(order.begin(), order.end())) {
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) { return order[a] < order[b]; });
  }
  Texel texel;
  texel.m_grid = grid;
  texel.m_bricks.assign(grid.brickCount(), -1);
  texel.m_voxels.reserve(entries.size());
  texel.m_places.reserve(entries.size());
  std::uint64_t last = ~std::uint64_t{0};
  for (const std::uint32_t i : sorted) {
    const Entry& entry = entries[i];
    if (order[i] == last) {
      return Error::badInput("voxel " + text(entry.at) + " is given twice", "texel", "Give every place once.");
    }
    last = order[i];
    const auto brick = static_cast<std::size_t>(order[i] >> 9);
    const auto bit = static_cast<std::uint32_t>(order[i] & 511);
    if (texel.m_bricks[brick] < 0) {
      texel.m_bricks[brick] = static_cast<std::int32_t>(texel.m_stored.size());
      texel.m_stored.push_back({static_cast<std::uint32_t>(texel.m_voxels.size()), {}});
    }
    texel.m_stored.back().mask[bit / 64] |= std::uint64_t{1} << (bit % 64);
    texel.m_voxels.push_back(entry.voxel);
    texel.m_places.emplace_back(entry.at);
  }
  return texel;
}

Texel Texel::fromChunks(const TexelGrid& grid, std::span<const Chunk> chunks, const JobContext& job) {
  std::vector<std::uint32_t> bricks;
  std::vector<std::array<std::uint64_t, 8>> masks;
  std::vector<const Voxel*> first;
  for (const Chunk& chunk : chunks) {
    bricks.insert(bricks.end(), chunk.bricks.begin(), chunk.bricks.end());
    masks.insert(masks.end(), chunk.masks.begin(), chunk.masks.end());
    const Voxel* next = chunk.voxels.data();
    for (const auto& mask : chunk.masks) {
      first.push_back(next);
      next += countOf(mask);
    }
  }
  return fromMasks(
      grid, bricks, masks,
      [&](std::size_t i, std::span<Voxel> voxels) { std::copy_n(first[i], voxels.size(), voxels.begin()); }, job);
}

Texel Texel::fromMasks(const TexelGrid& grid, std::span<const std::uint32_t> bricks,
                       std::span<const std::array<std::uint64_t, 8>> masks,
                       const std::function<void(std::size_t i, std::span<Voxel> voxels)>& fill, const JobContext& job) {
  constexpr std::size_t kBricks = 64;
  Texel texel;
  texel.m_grid = grid;
  texel.m_bricks.assign(grid.brickCount(), -1);
  texel.m_stored.resize(bricks.size());
  std::uint64_t voxels = 0;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    texel.m_stored[i] = {static_cast<std::uint32_t>(voxels), masks[i]};
    voxels += countOf(masks[i]);
  }
  SWARD_CHECK_LE(voxels, std::numeric_limits<std::uint32_t>::max());
  texel.m_voxels.resize(voxels);
  texel.m_places.resize(voxels);
  base::parallelFor(job, bricks.size(), kBricks, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      texel.place(bricks[i], i);
      fill(i, {texel.m_voxels.data() + texel.m_stored[i].first, countOf(masks[i])});
    }
  });
  return job.cancelled() ? Texel() : texel;
}

void Texel::place(std::uint32_t index, std::size_t stored) {
  m_bricks[index] = static_cast<std::int32_t>(stored);
  const auto row = static_cast<std::uint32_t>(m_grid.brickRow());
  const glm::uvec3 corner = glm::uvec3(index % row, index / row % row, index / row / row) * std::uint32_t{kBrick};
  glm::u16vec3* next = m_places.data() + m_stored[stored].first;
  for (std::uint32_t z = 0; z < kBrick; ++z) {
    for (std::uint64_t bits = m_stored[stored].mask[z]; bits != 0; bits &= bits - 1) {
      const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits));
      *next++ = glm::u16vec3(corner + glm::uvec3(bit % kBrick, bit / kBrick, z));
    }
  }
}

std::int64_t Texel::find(const glm::ivec3& at) const {
  const Place place = placeOf(m_grid, at);
  const std::int32_t stored = m_bricks[place.brick];
  if (stored < 0) return -1;
  const Brick& brick = m_stored[static_cast<std::size_t>(stored)];
  const std::uint32_t word = place.voxel / 64;
  const std::uint64_t bit = std::uint64_t{1} << (place.voxel % 64);
  if ((brick.mask[word] & bit) == 0) return -1;
  std::int64_t index = brick.first;
  for (std::uint32_t i = 0; i < word; ++i) index += std::popcount(brick.mask[i]);
  return index + std::popcount(brick.mask[word] & (bit - 1));
}

const Voxel* Texel::at(const glm::ivec3& at) const {
  const std::int64_t index = find(at);
  return index < 0 ? nullptr : &m_voxels[static_cast<std::size_t>(index)];
}

double Texel::areaM2() const {
  double sum = 0.0;
  for (const Voxel& voxel : m_voxels) sum += double{voxel.density};
  return sum * m_grid.voxelVolumeM3();
}

std::uint64_t Texel::bytes() const {
  return m_bricks.size() * sizeof(std::int32_t) + m_stored.size() * sizeof(Brick) + m_voxels.size() * sizeof(Voxel) +
         m_places.size() * sizeof(glm::u16vec3);
}

}  // namespace sward::wither
