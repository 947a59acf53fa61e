#include "terrain/lod_tree.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::terrain {
namespace {

/// Nodes of level 20 and more have a side of 2^23 samples: no field is so wide, none changes there any more.
constexpr int kLevels = 20;

long nodesAlong(int samples, int level, Border border) {
  const long side = static_cast<long>(kChunkQuads) << level;
  // A clamped field bends from one cell before its first sample to one after its last.
  if (border == Border::Clamp) return samples / side + 2;
  return std::max(samples / side, 1L);
}

std::vector<std::uint16_t> makeIndices(unsigned coarserSides) {
  std::vector<std::uint16_t> out;
  const auto vertex = [](int x, int y) { return static_cast<std::uint16_t>(y * (kChunkQuads + 1) + x); };
  // The ring round a fan's middle, counter-clockwise; odd places are midpoints of sides.
  constexpr std::array<std::array<int, 2>, 8> kRing{
      {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}}};
  for (int y = 1; y < kChunkQuads; y += 2) {
    for (int x = 1; x < kChunkQuads; x += 2) {
      const auto left = [&](std::size_t place) {
        switch (place) {
          case 1:
            return y == 1 && (coarserSides & kSouth) != 0;
          case 3:
            return x == kChunkQuads - 1 && (coarserSides & kEast) != 0;
          case 5:
            return y == kChunkQuads - 1 && (coarserSides & kNorth) != 0;
          case 7:
            return x == 1 && (coarserSides & kWest) != 0;
          default:
            return false;
        }
      };
      for (std::size_t place = 0; place < 8; ++place) {
        if (left(place)) continue;
        const std::size_t next = left((place + 1) % 8) ? (place + 2) % 8 : (place + 1) % 8;
        out.push_back(vertex(x, y));
        out.push_back(vertex(x + kRing[place][0], y + kRing[place][1]));
        out.push_back(vertex(x + kRing[next][0], y + kRing[next][1]));
      }
    }
  }
  return out;
}

}  // namespace

const std::vector<std::uint16_t>& LodTree::indices(unsigned coarserSides) {
  static const std::array<std::vector<std::uint16_t>, 16> all = [] {
    std::array<std::vector<std::uint16_t>, 16> made;
    for (unsigned sides = 0; sides < made.size(); ++sides) made[sides] = makeIndices(sides);
    return made;
  }();
  return all[coarserSides & 15u];
}

LodTree::LodTree(std::shared_ptr<const HeightField> field, const JobContext& job) : m_field(std::move(field)) {
  measureCells(job);
  for (int level = 1; level < kLevels && !job.cancelled(); ++level) measureLevel(level, job);
}

void LodTree::measureCells(const JobContext& job) {
  const HeightGrid& grid = m_field->grid();
  ErrorLevel cells{nodesAlong(grid.columns, 0, grid.border), nodesAlong(grid.rows, 0, grid.border), {}};
  const auto width = static_cast<std::size_t>(cells.columns);
  cells.errors.resize(width * static_cast<std::size_t>(cells.rows));
  const long first = firstNode();
  base::parallelFor(job, static_cast<std::size_t>(cells.rows), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * width; i < end * width; ++i) {
      const long x = (static_cast<long>(i % width) + first) * kChunkQuads;
      const long y = (static_cast<long>(i / width) + first) * kChunkQuads;
      double curvature = 0.0;
      for (long cy = y; cy < y + kChunkQuads; ++cy)
        for (long cx = x; cx < x + kChunkQuads; ++cx)
          curvature = std::max(curvature, curvatureBound(m_field->net(cx, cy)));
      cells.errors[i] = std::nextafter(static_cast<float>(0.25 * curvature), HUGE_VALF);
    }
  });
  m_levels.push_back(std::move(cells));
}

double LodTree::stepError(int level, long x, long y) const {
  // Vertices of the level below, in its own steps, that this level does not have: midpoints of its edges.
  const long steps = 2 * kChunkQuads, x0 = x * steps, y0 = y * steps;
  const int shift = level - 1;
  const auto height = [&](long i, long j) { return m_field->latticeHeight(i << shift, j << shift); };
  double most = 0.0;
  for (long j = y0; j <= y0 + steps; ++j) {
    for (long i = x0; i <= x0 + steps; ++i) {
      const bool oddX = (i & 1) != 0, oddY = (j & 1) != 0;
      if (!oddX && !oddY) continue;
      // Both odd: on the spoke from the fan's corner to its middle, which rises where their halves have one parity.
      const long dx = oddX ? 1 : 0, dy = !oddY ? 0 : oddX && (((i >> 1) ^ (j >> 1)) & 1) != 0 ? -1 : 1;
      most = std::max(most, std::abs(height(i, j) - 0.5 * (height(i - dx, j - dy) + height(i + dx, j + dy))));
    }
  }
  return most;
}

void LodTree::measureLevel(int level, const JobContext& job) {
  const HeightGrid& grid = m_field->grid();
  ErrorLevel nodes{nodesAlong(grid.columns, level, grid.border), nodesAlong(grid.rows, level, grid.border), {}};
  const auto width = static_cast<std::size_t>(nodes.columns);
  nodes.errors.resize(width * static_cast<std::size_t>(nodes.rows));
  const long first = firstNode();
  base::parallelFor(job, static_cast<std::size_t>(nodes.rows), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * width; i < end * width; ++i) {
      const long x = static_cast<long>(i % width) + first, y = static_cast<long>(i / width) + first;
      double below = 0.0;
      for (long child = 0; child < 4; ++child)
        below = std::max(below, errorM({level - 1, 2 * x + (child & 1), 2 * y + (child >> 1)}));
      nodes.errors[i] = std::nextafter(static_cast<float>(below + stepError(level, x, y)), HUGE_VALF);
    }
  });
  m_levels.push_back(std::move(nodes));
}

double LodTree::errorM(const LodNode& node) const {
  if (node.level < 0) {
    // Within a cell, whose curvature is bounded, halving the step quarters the error.
    return std::ldexp(errorM({0, node.x >> -node.level, node.y >> -node.level}), 2 * node.level);
  }
  const ErrorLevel& level = m_levels[static_cast<std::size_t>(std::min<long>(node.level, std::ssize(m_levels) - 1))];
  long x = node.x, y = node.y;
  if (m_field->grid().border == Border::Repeat) {
    x = (x % level.columns + level.columns) % level.columns;
    y = (y % level.rows + level.rows) % level.rows;
  } else {
    x += 1;
    y += 1;
    if (x < 0 || y < 0 || x >= level.columns || y >= level.rows) {
      // Beyond the samples: straight along one axis or both, as the node of the border beside it.
      x = std::clamp(x, 0L, level.columns - 1);
      y = std::clamp(y, 0L, level.rows - 1);
    }
  }
  return static_cast<double>(level.errors[static_cast<std::size_t>(y * level.columns + x)]);
}

void LodTree::vertices(const LodNode& node, const glm::dvec3& anchor, std::span<glm::vec3, kChunkVertices> out) const {
  const HeightGrid& grid = m_field->grid();
  std::size_t at = 0;
  for (long y = 0; y <= kChunkQuads; ++y) {
    for (long x = 0; x <= kChunkQuads; ++x) {
      const long column = node.x * kChunkQuads + x, row = node.y * kChunkQuads + y;
      const glm::dvec2 lattice(std::ldexp(static_cast<double>(column), node.level),
                               std::ldexp(static_cast<double>(row), node.level));
      const glm::dvec2 place = grid.origin + grid.cellM * lattice;
      const double height =
          node.level >= 0 ? m_field->latticeHeight(column << node.level, row << node.level) : m_field->height(place);
      out[at++] = glm::vec3(glm::dvec3(place, height) - anchor);
    }
  }
}

}  // namespace sward::terrain
