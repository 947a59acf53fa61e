#include "wither/light_sweep.h"

#include "base/parallel.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

constexpr int kBrick = TexelGrid::kBrick;
constexpr int kBandRays = 16;  ///< rows of rays that one task follows: their depths stay in the first cache

int wrapped(int cell, int columns) {
  const int rest = cell % columns;
  return rest < 0 ? rest + columns : rest;
}

/// A piece of every ray within one voxel: ray (u, v) is there in column (u + dx, v + dy), both within [0, columns).
struct Piece {
  int dx = 0, dy = 0, layer = 0;
  float lengthM = 0.0f;
};

/// What happens to the rays on their way down: pieces, and in between the heights at which layers are read.
struct Course {
  std::vector<Piece> pieces;
  std::vector<std::size_t> reads;   ///< by layer: how many pieces lie above where it reads
  std::vector<glm::ivec2> offsets;  ///< by layer: voxel (x, y) reads ray (x, y) + this, within [0, columns)
};

/// The ray from the middle of column (0, 0), in voxels.
class Descent {
 public:
  Descent(const TexelGrid& grid, const glm::dvec3& l) : m_columns(grid.columns), m_layers(grid.layers) {
    const glm::dvec3 perM = l / grid.voxelM();
    m_shift = {perM.x / perM.z, perM.y / perM.z};
    m_shift *= std::min(kMostShift / std::max(std::abs(m_shift.x), std::abs(m_shift.y)), 1.0);
    m_metresALayer = glm::length(glm::dvec3(m_shift * grid.voxelM().x, grid.voxelM().z));
  }

  Course course() {
    Course course;
    course.reads.resize(static_cast<std::size_t>(m_layers));
    course.offsets.resize(static_cast<std::size_t>(m_layers));
    const double out = 1.0 / std::max({std::abs(m_shift.x), std::abs(m_shift.y), 1.0});
    m_z = m_layers;
    for (int c = 0; c < 2; ++c) m_cell[c] = std::floor(at(c, m_z));
    m_layer = m_layers - 1;
    for (int layer = m_layers - 1; layer >= 0; --layer) {
      fall(std::min(layer + 0.5 + out, double{1.0} * m_layers), course.pieces);
      course.reads[static_cast<std::size_t>(layer)] = course.pieces.size();
      const glm::dvec2 ray = glm::round(-m_shift * (layer + 0.5));
      course.offsets[static_cast<std::size_t>(layer)] = {wrapped(static_cast<int>(ray.x), m_columns),
                                                         wrapped(static_cast<int>(ray.y), m_columns)};
    }
    fall(0.0, course.pieces);
    return course;
  }

 private:
  double at(int axis, double z) const { return 0.5 + m_shift[axis] * z; }
  /// The height under the present one at which the ray leaves its column along an axis.
  double exit(int axis) const {
    if (m_shift[axis] == 0.0) return -std::numeric_limits<double>::infinity();
    return (m_cell[axis] + (m_shift[axis] > 0.0 ? 0.0 : 1.0) - 0.5) / m_shift[axis];
  }
  void fall(double to, std::vector<Piece>& pieces) {
    while (m_z > to) {
      const double x = exit(0), y = exit(1), z = m_layer;
      const double next = std::max({x, y, z});
      const double until = std::clamp(next, to, m_z);
      if (until < m_z) {
        pieces.push_back({wrapped(static_cast<int>(m_cell.x), m_columns),
                          wrapped(static_cast<int>(m_cell.y), m_columns), m_layer,
                          static_cast<float>((m_z - until) * m_metresALayer)});
      }
      m_z = until;
      if (next < to) return;
      if (next == x) {
        m_cell.x += m_shift.x > 0.0 ? -1.0 : 1.0;
      } else if (next == y) {
        m_cell.y += m_shift.y > 0.0 ? -1.0 : 1.0;
      } else {
        if (m_layer == 0) return;
        --m_layer;
      }
    }
  }

  int m_columns, m_layers;
  glm::dvec2 m_shift{0.0};  ///< voxels a layer
  double m_metresALayer = 0.0;
  double m_z = 0.0;
  glm::dvec2 m_cell{0.0};
  int m_layer = 0;
};

/// Rows [first, last) of rays on their way down.
class Band {
 public:
  Band(const TexelRows& rows, std::span<const float> extinction, int first, int last)
      : m_rows(rows),
        m_extinction(extinction),
        m_columns(rows.grid().columns),
        m_first(first),
        m_last(last),
        m_depths(static_cast<std::size_t>(last - first) * static_cast<std::size_t>(m_columns), 0.0f) {}

  void add(const Piece& piece) {
    for (int v = m_first; v < m_last; ++v) {
      const TexelRows::Row row = m_rows.row(turned(v + piece.dy), piece.layer);
      if (row.begin == row.end) continue;
      float* depths = depthsOf(v);
      const std::uint16_t* x = m_rows.x().data();
      for (std::uint32_t i = row.begin; i < row.end; ++i) {
        const int u = int{x[i]} - piece.dx;
        depths[u < 0 ? u + m_columns : u] += piece.lengthM * m_extinction[i];
      }
    }
  }
  void read(int layer, const glm::ivec2& offset, std::span<float> out) {
    for (int v = m_first; v < m_last; ++v) {
      const TexelRows::Row row = m_rows.row(turned(v - offset.y + m_columns), layer);
      if (row.begin == row.end) continue;
      const float* depths = depthsOf(v);
      const std::uint16_t* x = m_rows.x().data();
      for (std::uint32_t i = row.begin; i < row.end; ++i) out[i] = depths[turned(x[i] + offset.x)];
    }
  }
  std::span<const float> depths() const { return m_depths; }

 private:
  /// Of a number in [0, 2 columns).
  int turned(int cell) const { return cell >= m_columns ? cell - m_columns : cell; }
  float* depthsOf(int v) {
    return m_depths.data() + static_cast<std::size_t>(v - m_first) * static_cast<std::size_t>(m_columns);
  }

  const TexelRows& m_rows;
  std::span<const float> m_extinction;
  int m_columns, m_first, m_last;
  std::vector<float> m_depths;
};

}  // namespace

void TexelRows::fillBricks(const Texel& texel, std::size_t brickRow) {
  const auto along = static_cast<std::size_t>(m_grid.brickRow());
  const std::span<const std::int32_t> bricks = texel.bricks().subspan(brickRow * along, along);
  const auto held = std::find_if(bricks.begin(), bricks.end(), [](std::int32_t brick) { return brick >= 0; });
  if (held == bricks.end()) return;
  const std::span<const Texel::Brick> stored = texel.stored();
  const auto columns = static_cast<std::size_t>(m_grid.columns);
  const std::size_t firstZ = brickRow / along * kBrick, firstY = brickRow % along * kBrick;
  std::vector<std::uint32_t> next(along);
  for (std::size_t b = 0; b < along; ++b) {
    if (bricks[b] >= 0) next[b] = stored[static_cast<std::size_t>(bricks[b])].first;
  }
  std::uint32_t at = stored[static_cast<std::size_t>(*held)].first;
  for (std::size_t z = 0; z < kBrick; ++z) {
    for (std::size_t y = 0; y < kBrick; ++y) {
      Row& row = m_rows[(firstZ + z) * columns + firstY + y];
      row.begin = at;
      for (std::size_t b = 0; b < along; ++b) {
        if (bricks[b] < 0) continue;
        std::uint64_t bits = stored[static_cast<std::size_t>(bricks[b])].mask[z] >> (y * kBrick) & 0xffu;
        for (; bits != 0; bits &= bits - 1) {
          m_order[at] = next[b]++;
          m_x[at++] = static_cast<std::uint16_t>(b * kBrick + static_cast<std::size_t>(std::countr_zero(bits)));
        }
      }
      row.end = at;
    }
  }
}

TexelRows::TexelRows(const Texel& texel)
    : m_grid(texel.grid()),
      m_order(texel.size()),
      m_x(texel.size()),
      m_rows(static_cast<std::size_t>(m_grid.columns) * static_cast<std::size_t>(m_grid.layers)),
      m_layers(static_cast<std::size_t>(m_grid.layers), 0) {}

Result<TexelRows> TexelRows::create(const Texel& texel, const JobContext& job) {
  TexelRows rows(texel);
  const auto columns = static_cast<std::size_t>(texel.grid().columns);
  const std::size_t brickRows = columns / kBrick * (rows.m_layers.size() / kBrick);
  base::parallelFor(job, brickRows, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) rows.fillBricks(texel, i);
  });
  if (job.cancelled()) return Error::cancelled();
  for (std::size_t i = 0; i < rows.m_rows.size(); ++i) {
    rows.m_layers[i / columns] += rows.m_rows[i].end - rows.m_rows[i].begin;
  }
  return rows;
}

Result<void> sweepDepths(const TexelRows& rows, std::span<const float> extinction, const glm::dvec3& l,
                         std::vector<float>& ground, std::span<float> depths, const JobContext& job) {
  const TexelGrid& grid = rows.grid();
  const auto columns = static_cast<std::size_t>(grid.columns);
  ground.resize(columns * columns);
  const Course course = Descent(grid, l).course();
  base::parallelFor(job, columns, kBandRays, [&](std::size_t begin, std::size_t end) {
    Band band(rows, extinction, static_cast<int>(begin), static_cast<int>(end));
    std::size_t piece = 0;
    const auto addUntil = [&](std::size_t until) {
      for (; piece < until; ++piece) {
        if (!rows.emptyLayer(course.pieces[piece].layer)) band.add(course.pieces[piece]);
      }
    };
    for (int layer = grid.layers - 1; layer >= 0 && !job.cancelled(); --layer) {
      const auto z = static_cast<std::size_t>(layer);
      addUntil(course.reads[z]);
      if (!rows.emptyLayer(layer)) band.read(layer, course.offsets[z], depths);
    }
    addUntil(course.pieces.size());
    std::copy(band.depths().begin(), band.depths().end(),
              ground.begin() + static_cast<std::ptrdiff_t>(begin * columns));
  });
  if (job.cancelled()) return Error::cancelled();
  return {};
}

}  // namespace sward::wither
