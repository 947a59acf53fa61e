#pragma once

#include "base/job.h"
#include "base/result.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// A block of voxels over a square of the sward, repeated in x and y: columns x columns x layers.
struct TexelGrid {
  int columns = 0;  ///< along x and along y; a multiple of kBrick
  int layers = 0;   ///< over the height; a multiple of kBrick
  double sideM = 1.0;
  double heightM = 1.0;

  static constexpr int kBrick = 8;
  glm::ivec3 size() const { return {columns, columns, layers}; }
  glm::dvec3 voxelM() const { return {sideM / columns, sideM / columns, heightM / layers}; }
  double voxelVolumeM3() const { return voxelM().x * voxelM().y * voxelM().z; }
  /// Bricks along x and y, and of all.
  int brickRow() const { return columns / kBrick; }
  std::size_t brickCount() const {
    return static_cast<std::size_t>(brickRow()) * static_cast<std::size_t>(brickRow()) *
           static_cast<std::size_t>(layers / kBrick);
  }
  bool operator==(const TexelGrid&) const = default;
};
/// Errors: columns or layers that are not multiples of kBrick from 8 to 4096, sizes that are not finite and above 0.
Result<void> checkGrid(const TexelGrid& grid);

/// What a voxel holds of its leaves (TVT paper, section 2.1). Means are weighted by leaf area.
struct Voxel {
  float density = 0.0f;         ///< one-sided leaf area over volume, 1/m; above 0 in a stored voxel
  glm::vec3 normal{0.0f};       ///< unit; zero on a vein and where normals cancel
  glm::vec3 tangent{0.0f};      ///< unit, from root to tip along the blade; zero where tangents cancel
  glm::vec3 diffuse{0.0f};      ///< reflectance, linear RGB
  glm::vec3 transmitted{0.0f};  ///< transmittance, linear RGB
  float specular = 0.0f;        ///< strength of the highlight, 0 to 1
  /// S = sum of area times n n^T over volume: xx, xy, xz, yy, yz, zz, 1/m; its trace is the density where every leaf
  /// has a normal.
  std::array<float, 6> spread{};
};

/// Leaves new elements of a vector as the memory was, for those that are written right after.
template <typename T>
struct UnwrittenAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnwrittenAllocator<U>;
  };
  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A texel: voxels in bricks of kBrick^3, of which only those that hold something are stored. Immutable.
class Texel {
 public:
  struct Entry {
    glm::ivec3 at;
    Voxel voxel;
  };

  /// A brick that holds something. Bit y * 8 + x of word z of its mask says whether the voxel (x, y, z) of the brick is
  /// stored; they follow each other in voxels() in the order of the bits.
  struct Brick {
    std::uint32_t first = 0;  ///< its first voxel
    std::array<std::uint64_t, 8> mask{};
  };
  /// Bricks made one after another: brick i has the index `bricks[i]` = (z * row + y) * row + x of bricks, ascending,
  /// no empty ones; voxels as their masks say.
  struct Chunk {
    std::vector<std::uint32_t> bricks;
    std::vector<std::array<std::uint64_t, 8>> masks;
    std::vector<Voxel> voxels;
  };

  Texel() = default;
  /// Entries in any order, no place twice, densities finite and at least 0 (those of 0 are left out). Errors: a place
  /// outside the grid or twice, a value that is not finite, a grid that is not of whole bricks.
  static Result<Texel> fromEntries(const TexelGrid& grid, std::vector<Entry> entries);
  /// Chunks whose bricks follow each other, of voxels that are already known to be finite and above 0. For what makes
  /// texels brick by brick, in parallel. A job that is cancelled gives an empty texel.
  static Texel fromChunks(const TexelGrid& grid, std::span<const Chunk> chunks, const JobContext& job);
  /// The same where it is known beforehand which voxels there are: fill(i, voxels) sets those of `bricks[i]`, in
  /// parallel, as masks[i] says. Bricks ascend, masks are not empty.
  static Texel fromMasks(const TexelGrid& grid, std::span<const std::uint32_t> bricks,
                         std::span<const std::array<std::uint64_t, 8>> masks,
                         const std::function<void(std::size_t i, std::span<Voxel> voxels)>& fill,
                         const JobContext& job);

  const TexelGrid& grid() const { return m_grid; }
  std::size_t size() const { return m_voxels.size(); }  ///< stored voxels
  bool empty() const { return m_voxels.empty(); }
  /// In the order of bricks (x fastest), within a brick x fastest.
  std::span<const Voxel> voxels() const { return m_voxels; }
  std::span<const glm::u16vec3> places() const { return m_places; }
  /// [z][y][x] of bricks: index into stored(); -1: empty.
  std::span<const std::int32_t> bricks() const { return m_bricks; }
  std::span<const Brick> stored() const { return m_stored; }
  /// Index into voxels() of what is at a place inside the grid; -1: nothing.
  std::int64_t find(const glm::ivec3& at) const;
  const Voxel* at(const glm::ivec3& at) const;

  /// Leaf area of all voxels, m^2: the sum of density times volume.
  double areaM2() const;
  std::uint64_t bytes() const;  ///< in memory

 private:
  void place(std::uint32_t index, std::size_t stored);

  TexelGrid m_grid;
  std::vector<std::int32_t> m_bricks;  ///< [z][y][x] index into m_stored; -1: empty
  std::vector<Brick> m_stored;
  std::vector<Voxel, UnwrittenAllocator<Voxel>> m_voxels;
  std::vector<glm::u16vec3, UnwrittenAllocator<glm::u16vec3>> m_places;
};

}  // namespace sward::wither
