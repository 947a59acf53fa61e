#include "terrain/height_field.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

namespace sward::terrain {
namespace {

/// Weights of four samples at t in [0, 1] between the second and the third, and their derivatives.
struct SplineWeights {
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

SplineWeights catmullRom(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {
      {0.5 * (2.0 * t2 - t3 - t), 0.5 * (3.0 * t3 - 5.0 * t2 + 2.0), 0.5 * (4.0 * t2 - 3.0 * t3 + t), 0.5 * (t3 - t2)},
      {0.5 * (4.0 * t - 3.0 * t2 - 1.0), 0.5 * (9.0 * t2 - 10.0 * t), 0.5 * (8.0 * t - 9.0 * t2 + 1.0),
       0.5 * (3.0 * t2 - 2.0 * t)}};
}

/// Four samples of a Catmull-Rom segment to its four Bezier points: the tangents are half the neighbours' difference.
std::array<double, 4> bezierOf(const std::array<double, 4>& p) {
  return {p[1], p[1] + (p[2] - p[0]) / 6.0, p[2] - (p[3] - p[1]) / 6.0, p[2]};
}

/// Where a coordinate lies: the cell and the place in it.
struct CellPlace {
  long cell = 0;
  double t = 0.0;
};

CellPlace cellPlace(double u, int count, Border border) {
  // A place that is no number, or farther out than a long counts, has the border's height.
  const double limit = border == Border::Clamp ? count : 1e15;
  const double low = border == Border::Clamp ? -1.0 : -1e15;
  const double held = std::isnan(u) ? 0.0 : std::clamp(u, low, limit);
  const double cell = std::floor(held);
  return {static_cast<long>(cell), held - cell};
}

long modulo(long value, long period) {
  const long rest = value % period;
  return rest < 0 ? rest + period : rest;
}

Result<void> checkGrid(const HeightGrid& grid) {
  const std::string size = std::to_string(grid.columns) + " x " + std::to_string(grid.rows);
  if (grid.columns < 2 || grid.rows < 2)
    return Error::badInput("a grid of " + size + " heights has no surface", "terrain", "Give 2 x 2 heights or more.");
  const auto count = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  if (grid.columns > kMaxGridSide || grid.rows > kMaxGridSide || count > kMaxGridSamples)
    return Error::badInput(
        "a grid of " + size + " heights is too large", "terrain",
        "Use at most " + std::to_string(kMaxGridSide) + " a side and " + std::to_string(kMaxGridSamples) + " in all.");
  if (grid.heights.size() != count)
    return Error::badInput("a grid of " + size + " has " + std::to_string(grid.heights.size()) + " heights", "terrain");
  if (!(grid.cellM.x > 0.0) || !(grid.cellM.y > 0.0) || !std::isfinite(grid.cellM.x + grid.cellM.y))
    return Error::badInput("the distance between heights is not above 0", "terrain", "Give a width in metres.");
  if (!std::isfinite(grid.origin.x + grid.origin.y))
    return Error::badInput("the grid's place is not a number", "terrain");
  if (std::any_of(grid.heights.begin(), grid.heights.end(), [](float h) { return !std::isfinite(h); }))
    return Error::badInput("a height is not a number", "terrain");
  const auto odd = [](int side) { return !std::has_single_bit(static_cast<unsigned>(side)); };
  if (grid.border == Border::Repeat && (odd(grid.columns) || odd(grid.rows)))
    return Error::badInput("a grid of " + size + " does not repeat", "terrain", "Use powers of two.");
  return {};
}

HeightRange hullOf(const BezierNet& net) {
  HeightRange hull{net[0][0], net[0][0]};
  for (const auto& row : net)
    for (const double h : row) hull = {std::min(hull.low, h), std::max(hull.high, h)};
  return hull;
}

/// Halves a level of bounds.
HeightField::BoundsLevel halved(const HeightField::BoundsLevel& fine) {
  HeightField::BoundsLevel coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}, {}};
  for (int y = 0; y < coarse.rows; ++y) {
    for (int x = 0; x < coarse.columns; ++x) {
      float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
      for (int fy = 2 * y; fy < std::min(2 * y + 2, fine.rows); ++fy) {
        for (int fx = 2 * x; fx < std::min(2 * x + 2, fine.columns); ++fx) {
          const auto at =
              static_cast<std::size_t>(fy) * static_cast<std::size_t>(fine.columns) + static_cast<std::size_t>(fx);
          low = std::min(low, fine.low[at]);
          high = std::max(high, fine.high[at]);
        }
      }
      coarse.low.push_back(low);
      coarse.high.push_back(high);
    }
  }
  return coarse;
}

}  // namespace

double curvatureBound(const BezierNet& net) {
  // Second derivatives of a cubic are 6 times combinations of the control points' second differences, the mixed one 9
  // times those of the twists.
  double uu = 0.0, vv = 0.0, uv = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      uu = std::max(uu, std::abs(net[i][j + 2] - 2.0 * net[i][j + 1] + net[i][j]));
      vv = std::max(vv, std::abs(net[j + 2][i] - 2.0 * net[j + 1][i] + net[j][i]));
    }
  }
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      uv = std::max(uv, std::abs(net[i + 1][j + 1] - net[i + 1][j] - net[i][j + 1] + net[i][j]));
  return 6.0 * std::max(uu, vv) + 9.0 * uv;
}

Result<std::shared_ptr<const HeightField>> HeightField::create(HeightGrid grid, const JobContext& job) {
  SWARD_TRY(checkGrid(grid));
  std::shared_ptr<HeightField> field(new HeightField());
  field->m_grid = std::move(grid);
  field->makeBounds(job);
  if (job.cancelled()) return Error::cancelled();
  return std::shared_ptr<const HeightField>(std::move(field));
}

long HeightField::wrapColumn(long column) const {
  return m_grid.border == Border::Repeat ? modulo(column, m_grid.columns) : std::clamp(column, 0L, m_grid.columns - 1L);
}

long HeightField::wrapRow(long row) const {
  return m_grid.border == Border::Repeat ? modulo(row, m_grid.rows) : std::clamp(row, 0L, m_grid.rows - 1L);
}

double HeightField::latticeHeight(long column, long row) const {
  return static_cast<double>(m_grid.at(static_cast<int>(wrapColumn(column)), static_cast<int>(wrapRow(row))));
}

BezierNet HeightField::net(long column, long row) const {
  BezierNet across;  // Bezier points along x for each of the four rows of samples
  for (long y = 0; y < 4; ++y) {
    std::array<double, 4> samples;
    for (long x = 0; x < 4; ++x) samples[static_cast<std::size_t>(x)] = latticeHeight(column + x - 1, row + y - 1);
    across[static_cast<std::size_t>(y)] = bezierOf(samples);
  }
  BezierNet net;
  for (std::size_t x = 0; x < 4; ++x) {
    const auto points = bezierOf({across[0][x], across[1][x], across[2][x], across[3][x]});
    for (std::size_t y = 0; y < 4; ++y) net[y][x] = points[y];
  }
  return net;
}

HeightSample HeightField::sample(glm::dvec2 place) const {
  const glm::dvec2 uv = (place - m_grid.origin) / m_grid.cellM;
  const CellPlace x = cellPlace(uv.x, m_grid.columns, m_grid.border);
  const CellPlace y = cellPlace(uv.y, m_grid.rows, m_grid.border);
  const SplineWeights wx = catmullRom(x.t), wy = catmullRom(y.t);
  std::array<long, 4> columns;
  for (long i = 0; i < 4; ++i) columns[static_cast<std::size_t>(i)] = wrapColumn(x.cell + i - 1);
  HeightSample out;
  for (std::size_t j = 0; j < 4; ++j) {
    const long row = wrapRow(y.cell + static_cast<long>(j) - 1);
    const float* heights = m_grid.heights.data() + m_grid.offset(0, static_cast<int>(row));
    double value = 0.0, slope = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const auto h = static_cast<double>(heights[columns[i]]);
      value += wx.value[i] * h;
      slope += wx.slope[i] * h;
    }
    out.heightM += wy.value[j] * value;
    out.gradient += glm::dvec2(wy.value[j] * slope, wy.slope[j] * value);
  }
  out.gradient /= m_grid.cellM;
  return out;
}

glm::dvec3 HeightField::normal(glm::dvec2 place) const {
  return glm::normalize(glm::dvec3(-sample(place).gradient, 1.0));
}

void HeightField::makeBounds(const JobContext& job) {
  const bool clamped = m_grid.border == Border::Clamp;
  // A clamped surface curves on for one cell beyond its samples.
  m_firstCell = clamped ? -1 : 0;
  const int columns = m_grid.columns + (clamped ? 1 : 0), rows = m_grid.rows + (clamped ? 1 : 0);
  const auto width = static_cast<std::size_t>(columns);
  const std::size_t count = width * static_cast<std::size_t>(rows);
  BoundsLevel cells{columns, rows, std::vector<float>(count), std::vector<float>(count)};
  constexpr std::size_t kRowsATime = 8;
  base::parallelFor(job, static_cast<std::size_t>(rows), kRowsATime, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const HeightRange hull = hullOf(net(static_cast<long>(x) + m_firstCell, static_cast<long>(y) + m_firstCell));
        // Rounded outward, so that floats bound the doubles.
        constexpr float kFar = std::numeric_limits<float>::max();
        cells.low[y * width + x] = std::nextafter(static_cast<float>(hull.low), -kFar);
        cells.high[y * width + x] = std::nextafter(static_cast<float>(hull.high), kFar);
      }
    }
  });
  m_bounds.push_back(std::move(cells));
  while (m_bounds.back().low.size() > 1 && !job.cancelled()) m_bounds.push_back(halved(m_bounds.back()));
  m_whole = {static_cast<double>(m_bounds.back().low[0]), static_cast<double>(m_bounds.back().high[0])};
}

HeightRange HeightField::nodeRange(int level, long column, long row) const {
  const BoundsLevel& bounds = m_bounds[static_cast<std::size_t>(level)];
  const auto index = [&](long cell, int count) {
    const long node = (cell - m_firstCell) >> level;
    return m_grid.border == Border::Repeat ? modulo(node, count) : std::clamp(node, 0L, count - 1L);
  };
  const long x = index(column, bounds.columns), y = index(row, bounds.rows);
  const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(bounds.columns) + static_cast<std::size_t>(x);
  return {static_cast<double>(bounds.low[at]), static_cast<double>(bounds.high[at])};
}

HeightRange HeightField::rangeOfCells(long left, long right, long bottom, long top) const {
  const int last = static_cast<int>(m_bounds.size()) - 1;
  int level = 0;
  const auto wide = [&](long low, long high) {
    return ((high - m_firstCell) >> level) - ((low - m_firstCell) >> level) > 3;
  };
  while (level < last && (wide(left, right) || wide(bottom, top))) ++level;
  if (level == last) return m_whole;
  HeightRange range = nodeRange(level, left, bottom);
  const long step = 1L << level;
  const auto start = [&](long cell) { return (((cell - m_firstCell) >> level) << level) + m_firstCell; };
  for (long y = start(bottom); y <= top; y += step) {
    for (long x = start(left); x <= right; x += step) {
      const HeightRange node = nodeRange(level, x, y);
      range = {std::min(range.low, node.low), std::max(range.high, node.high)};
    }
  }
  return range;
}

HeightRange HeightField::range(glm::dvec2 low, glm::dvec2 high) const {
  const glm::dvec2 a = (low - m_grid.origin) / m_grid.cellM, b = (high - m_grid.origin) / m_grid.cellM;
  return rangeOfCells(cellPlace(a.x, m_grid.columns, m_grid.border).cell,
                      cellPlace(b.x, m_grid.columns, m_grid.border).cell,
                      cellPlace(a.y, m_grid.rows, m_grid.border).cell, cellPlace(b.y, m_grid.rows, m_grid.border).cell);
}

}  // namespace sward::terrain
