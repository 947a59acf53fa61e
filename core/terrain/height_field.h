#pragma once

#include "base/job.h"
#include "base/result.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace sward::terrain {

/// What lies beyond the samples of a grid.
enum class Border {
  Clamp,  ///< the border's heights, drawn out straight
  Repeat  ///< the grid again
};

/// Samples on a regular grid, row by row from the south-west.
struct HeightGrid {
  int columns = 0, rows = 0;
  glm::dvec2 origin{0.0};  ///< world place of the first sample
  glm::dvec2 cellM{1.0};   ///< distance between samples, both above 0
  Border border = Border::Clamp;
  std::vector<float> heights;  ///< metres, columns * rows

  float& at(int x, int y) { return heights[offset(x, y)]; }
  float at(int x, int y) const { return heights[offset(x, y)]; }
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }
};

/// Largest side and number of samples of a grid that are read or made: 2^26 samples and what is derived from them take
/// about 1 GiB.
inline constexpr int kMaxGridSide = 24576;
inline constexpr std::size_t kMaxGridSamples = std::size_t{1} << 26;

struct HeightRange {
  double low = 0.0, high = 0.0;
};

/// Height over z = 0 and its slope along x and y (metres a metre).
struct HeightSample {
  double heightM = 0.0;
  glm::dvec2 gradient{0.0};
};

/// A cell's bicubic surface as a Bezier net (Farin, Curves and Surfaces for CAGD, chapter 14): it stays within the
/// net's lowest and highest value. net[row][column], heights at thirds of the cell.
using BezierNet = std::array<std::array<double, 4>, 4>;

/// Largest |second derivative| in any direction of a net's surface, in metres a squared cell: the spectral norm of the
/// Hessian is at most the larger row sum.
double curvatureBound(const BezierNet& net);

/// An immutable surface z = h(x, y) over the whole plane: Catmull-Rom splines along both axes through the samples
/// (Catmull and Rom 1974), so that it meets every sample and its gradient, hence its normal, is continuous everywhere.
/// A plane's samples give that plane, away from clamped borders.
class HeightField {
 public:
  /// Errors: fewer than 2 samples a side or too many, a number of heights that is not columns * rows, a cell size that
  /// is not above 0, a height that is not finite, Border::Repeat with sides that are no powers of two.
  /// Errors::cancelled.
  static Result<std::shared_ptr<const HeightField>> create(HeightGrid grid, const JobContext& job = {});

  const HeightGrid& grid() const { return m_grid; }

  double height(glm::dvec2 place) const { return sample(place).heightM; }
  HeightSample sample(glm::dvec2 place) const;
  /// Unit normal, up.
  glm::dvec3 normal(glm::dvec2 place) const;

  /// Bounds of the heights over the rectangle; never too narrow.
  HeightRange range(glm::dvec2 low, glm::dvec2 high) const;
  HeightRange range() const { return m_whole; }

  /// The sample of a column and row anywhere on the plane: beyond the border as Border says.
  double latticeHeight(long column, long row) const;
  /// The surface over the cell whose south-west sample is (column, row), anywhere on the plane.
  BezierNet net(long column, long row) const;

  /// Distance along a ray (direction of unit length) to where it first meets or passes below the surface, at most
  /// maxDistanceM; 0 when it starts below. Accurate to a millionth of a cell, or 1e-9 of the distance. Walks the
  /// pyramid of bounds (Tevs, Ihrke, Seidel 2008), and inside a cell halves intervals until a bound on the curvature
  /// rules a crossing out: nothing is stepped over. Nothing when it does not meet the surface.
  std::optional<double> rayCast(const glm::dvec3& from, const glm::dvec3& direction, double maxDistanceM) const;

  /// Cells of one level of the pyramid of bounds; level 0 has the grid's own cells, from cell `first` on.
  struct BoundsLevel {
    int columns = 0, rows = 0;
    std::vector<float> low, high;
  };

 private:
  HeightField() = default;
  void makeBounds(const JobContext& job);
  long wrapColumn(long column) const;
  long wrapRow(long row) const;
  /// Bounds of the node that holds level-0 cell (column, row) at `level`.
  HeightRange nodeRange(int level, long column, long row) const;
  HeightRange rangeOfCells(long left, long right, long bottom, long top) const;
  std::optional<double> castInCell(const glm::dvec3& from, const glm::dvec3& direction, long column, long row,
                                   double tLow, double tHigh) const;

  HeightGrid m_grid;
  std::vector<BoundsLevel> m_bounds;
  long m_firstCell = 0;  ///< level-0 bounds start at this column and row: -1 for clamped grids
  HeightRange m_whole;
};

}  // namespace sward::terrain
