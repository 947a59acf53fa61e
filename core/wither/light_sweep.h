#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// A texel's voxels row by row along x: what a sweep reads. Holds no light, so it serves any number of them.
class TexelRows {
 public:
  /// Errors: Error::cancelled().
  static Result<TexelRows> create(const Texel& texel, const JobContext& job);

  const TexelGrid& grid() const { return m_grid; }
  std::size_t size() const { return m_order.size(); }
  /// Indices into Texel::voxels(). Those of one row are adjacent and x rises along them; rows of one row of bricks are
  /// adjacent, and hold the same range of indices as the bricks do.
  std::span<const std::uint32_t> order() const { return m_order; }
  std::span<const std::uint16_t> x() const { return m_x; }  ///< one an entry of order()

  /// Entries of row (y, z): [begin, end) in order().
  struct Row {
    std::uint32_t begin = 0, end = 0;
  };
  const Row& row(int y, int z) const {
    return m_rows[static_cast<std::size_t>(z) * static_cast<std::size_t>(m_grid.columns) + static_cast<std::size_t>(y)];
  }
  bool emptyLayer(int z) const { return m_layers[static_cast<std::size_t>(z)] == 0; }

 private:
  explicit TexelRows(const Texel& texel);
  void fillBricks(const Texel& texel, std::size_t brickRow);

  TexelGrid m_grid;
  std::vector<std::uint32_t> m_order;
  std::vector<std::uint16_t> m_x;
  std::vector<Row> m_rows;              ///< [z][y]
  std::vector<std::uint32_t> m_layers;  ///< voxels of each
};

/// The optical depth from every voxel of a texel toward a light, in one sweep from the top layer down.
///
/// One ray a column starts in the middle of its foot on the ground and rises to the light, x and y wrapping. All of
/// them pass through voxels in the same way but for whole columns: the lengths of one ray's pieces (Amanatides and Woo
/// 1987) are those of all, and each voxel of a layer adds its extinction times such a length to the few rays that meet
/// it. So the depth of every ray is exact at every height, whatever is empty costs nothing, and rays need nothing of
/// each other: bands of them are swept beside each other, with the same bytes on any number of threads.
///
/// A voxel reads the ray that passes nearest to the point one voxel out of its middle toward the light (along the axis
/// that the light goes along fastest, in voxels): at most half a voxel aside, in x and y. From there no ray meets the
/// voxel itself again but after a whole period of the block, so that a leaf does not shade itself. All voxels of a
/// layer read with the same offset. For the ground nothing is moved.
///
/// `extinction`: toward the light, one an entry of rows.order(), 1/m. `l`: unit, to the light, l.z > 0. A light so low
/// that a layer shifts it by more than kMostShift voxels is followed as if it stood that high (some 1 degree). Time
/// goes with voxels times the columns that the light shifts by a layer. `depths`: above each entry of rows.order(), of
/// its size and not where `extinction` is; `ground`: above the middle of each column at z = 0, [y][x], resized. Errors:
/// Error::cancelled().
Result<void> sweepDepths(const TexelRows& rows, std::span<const float> extinction, const glm::dvec3& l,
                         std::vector<float>& ground, std::span<float> depths, const JobContext& job);
inline constexpr double kMostShift = 64.0;

/// exp(-depth) of a depth from 0 to infinity, to 3e-7 of itself; under exp(-80) it stays there. Cody and Waite's
/// reduction and a Taylor polynomial, written so that loops of it become vector instructions.
inline float transmittanceOf(float depth) {
  constexpr float kLog2E = 1.44269504f, kLn2High = 0.693359375f, kLn2Low = -2.12194440e-4f, kRound = 12582912.0f;
  const float x = -std::min(depth, 80.0f);
  const float n = (x * kLog2E + kRound) - kRound;  // nearest whole number
  const float r = (x - n * kLn2High) - n * kLn2Low;
  const float p =
      1.0f + r * (1.0f + r * (0.5f + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
  return p * std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23);
}

}  // namespace sward::wither
