#pragma once

#include "base/result.h"

#include <array>
#include <cstdint>
#include <span>
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
  bool operator==(const TexelGrid&) const = default;
};

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

/// A texel: voxels in bricks of kBrick^3, of which only those that hold something are stored. Immutable.
class Texel {
 public:
  struct Entry {
    glm::ivec3 at;
    Voxel voxel;
  };

  Texel() = default;
  /// Entries in any order, no place twice, densities finite and at least 0 (those of 0 are left out). Errors: a place
  /// outside the grid or twice, a value that is not finite, a grid that is not of whole bricks.
  static Result<Texel> fromEntries(const TexelGrid& grid, std::vector<Entry> entries);

  const TexelGrid& grid() const { return m_grid; }
  std::size_t size() const { return m_voxels.size(); }  ///< stored voxels
  bool empty() const { return m_voxels.empty(); }
  /// In the order of bricks (x fastest), within a brick x fastest.
  std::span<const Voxel> voxels() const { return m_voxels; }
  std::span<const glm::u16vec3> places() const { return m_places; }
  /// Index into voxels() of what is at a place inside the grid; -1: nothing.
  std::int64_t find(const glm::ivec3& at) const;
  const Voxel* at(const glm::ivec3& at) const;

  /// Leaf area of all voxels, m^2: the sum of density times volume.
  double areaM2() const;
  std::uint64_t bytes() const;  ///< in memory

 private:
  struct Brick {
    std::uint32_t first = 0;              ///< its first voxel
    std::array<std::uint64_t, 8> mask{};  ///< one word a layer of the brick, bit y * 8 + x
  };
  TexelGrid m_grid;
  std::vector<std::int32_t> m_bricks;  ///< [z][y][x] index into m_stored; -1: empty
  std::vector<Brick> m_stored;
  std::vector<Voxel> m_voxels;
  std::vector<glm::u16vec3> m_places;
};

}  // namespace sward::wither
