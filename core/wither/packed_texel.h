#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::wither {

/// A key frame in memory and on disk: a texel in 20 bytes a voxel and 68 a brick. Which voxels there are is kept
/// exactly. Errors of what it gives back, from half a step of each code:
/// - density: relative, ln(largest / least) / 131068 (the texel's own; under 0.14 % for any floats), 16 bits of its
///   logarithm;
/// - normal: under 0.0011 rad, octahedral in 2 x 12 bits; tangent: under 0.017 rad, in 2 x 8 bits: half a step of both
///   coordinates, times sqrt(18) where the octahedral map is steepest; zero stays zero;
/// - diffuse, transmitted: 1/510 in their square roots; specular: 1/510; values beyond [0, 1] are clamped;
/// - spread: its largest diagonal entry 3/510 of the density, the others 1/508; its trace 1/510, and equal to the
///   density where it was. 8 bits of each entry over the density.
class PackedTexel {
 public:
  PackedTexel() = default;
  static PackedTexel pack(const Texel& texel, const JobContext& job);
  /// An empty texel when the job is cancelled.
  Texel unpack(const JobContext& job) const;

  const TexelGrid& grid() const { return m_grid; }
  std::size_t size() const { return m_codes.size(); }  ///< voxels
  std::uint64_t bytes() const;                         ///< in memory

  std::vector<std::byte> serialised() const;
  /// Errors: bytes that are short, left over or contradict each other; nothing is read outside of them.
  static Result<PackedTexel> parse(std::span<const std::byte> bytes);

 private:
  struct Code {
    std::uint16_t density = 0;
    std::array<std::uint8_t, 3> normal{};
    std::array<std::int8_t, 2> tangent{};
    std::array<std::uint8_t, 3> diffuse{}, transmitted{};
    std::uint8_t specular = 0;
    std::array<std::int8_t, 6> spread{};
  };
  static_assert(sizeof(Code) == 20);

  Code codeOf(const Voxel& voxel) const;
  Voxel voxelOf(const Code& code) const;
  Result<void> check() const;

  TexelGrid m_grid;
  double m_logLeast = 0.0, m_logRange = 0.0;  ///< of the densities' natural logarithms
  std::vector<std::uint32_t> m_bricks;  ///< ascending indices (z * row + y) * row + x of those that hold something
  std::vector<std::array<std::uint64_t, 8>> m_masks;
  std::vector<Code> m_codes;
};

}  // namespace sward::wither
