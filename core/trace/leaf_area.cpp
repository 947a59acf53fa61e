#include "trace/leaf_area.h"

#include "base/check.h"
#include "base/parallel.h"
#include "base/random.h"
#include "mesh/measure.h"
#include "trace/fast_floor.h"
#include "trace/triangle_clip.h"
#include "trace/triangle_field.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <string>

namespace sward::trace {
namespace {

constexpr double kMaxVoxels = 1 << 23;  ///< 600 MB of sums
/// Triangles are cut in blocks of so many, in parallel, and summed block after block: the same sums on any number of
/// threads, in little memory.
constexpr std::size_t kBlock = 2048, kBlocksAtOnce = 32;
constexpr int kSide = 8;  ///< lines along each side of a voxel's face; a mask of them is one word

/// A part of a triangle in a voxel.
struct Fragment {
  std::size_t voxel = 0;
  std::uint32_t triangle = 0;  ///< in the block
  double share = 0.0;          ///< of the triangle's area, times alpha
  std::array<std::uint64_t, 3> lines{};
};
struct Block {
  std::vector<std::array<double, 6>> tensors;  ///< of each triangle: area n n^T / voxel volume
  std::vector<Fragment> fragments;
};
struct Sums {
  std::vector<std::array<double, 6>> tensor;
  std::vector<std::array<std::uint64_t, 3>> lines;
};

/// Mean alpha over a part, from a lattice over each triangle of its fan.
double meanAlpha(const mesh::Model& model, std::uint32_t triangle, const ClipPolygon& part) {
  constexpr int kPoints = 4;
  double sum = 0.0, area = 0.0;
  for (std::size_t i = 2; i < part.count; ++i) {
    const ClipCorner &a = part.corners[0], &b = part.corners[i - 1], &c = part.corners[i];
    const double u1 = b.u - a.u, v1 = b.v - a.v, u2 = c.u - a.u, v2 = c.v - a.v;
    const double weight = std::abs(u1 * v2 - u2 * v1);
    double mean = 0.0;
    int points = 0;
    for (int p = 0; p < kPoints; ++p) {
      for (int q = 0; p + q < kPoints; ++q, ++points) {
        const double s = (p + 1.0 / 3.0) / kPoints, t = (q + 1.0 / 3.0) / kPoints;
        mean += static_cast<double>(mesh::alphaAt(model, triangle, static_cast<float>(a.u + s * u1 + t * u2),
                                                  static_cast<float>(a.v + s * v1 + t * v2)));
      }
    }
    sum += weight * mean / points;
    area += weight;
  }
  return area > 0.0 ? sum / area : 0.0;
}

/// A part as seen along an axis, in units of the lines' spacing; line (i, j) passes at (i + 1/2, j + 1/2).
class Silhouette {
 public:
  Silhouette(const ClipPolygon& part, const glm::ivec3& cell, int axis) : m_part(part), m_count(part.count) {
    const int across = (axis + 1) % 3, along = (axis + 2) % 3;
    for (std::size_t i = 0; i < m_count; ++i) {
      m_at[i] = {(part.corners[i].at[across] - cell[across]) * kSide,
                 (part.corners[i].at[along] - cell[along]) * kSide};
      m_low = i == 0 ? m_at[i] : glm::min(m_low, m_at[i]);
      m_high = i == 0 ? m_at[i] : glm::max(m_high, m_at[i]);
    }
  }

  /// Calls line(bit, u, v) for each line that the part stands in, with its place in the triangle.
  template <typename Line>
  void forEachLine(const Line& line) const {
    for (int i = first(m_low.x); i <= last(m_high.x); ++i) {
      for (int j = first(m_low.y); j <= last(m_high.y); ++j) {
        const glm::dvec2 p(i + 0.5, j + 0.5);
        for (std::size_t k = 2; k < m_count; ++k) {
          if (inFan(p, k, i * kSide + j, line)) break;
        }
      }
    }
  }

 private:
  static int first(double low) { return std::max(0, static_cast<int>(std::ceil(low - 0.5))); }
  static int last(double high) { return std::min(kSide - 1, static_cast<int>(std::floor(high - 0.5))); }

  template <typename Line>
  bool inFan(const glm::dvec2& p, std::size_t k, int bit, const Line& line) const {
    const glm::dvec2 b = m_at[k - 1] - m_at[0], c = m_at[k] - m_at[0], q = p - m_at[0];
    const double area = b.x * c.y - b.y * c.x;
    const double s = (q.x * c.y - q.y * c.x) / area, t = (b.x * q.y - b.y * q.x) / area;
    if (!(s >= 0.0 && t >= 0.0 && s + t <= 1.0)) return false;  // also seen edge-on: not a number
    const ClipCorner &c0 = m_part.corners[0], &c1 = m_part.corners[k - 1], &c2 = m_part.corners[k];
    line(bit, c0.u + s * (c1.u - c0.u) + t * (c2.u - c0.u), c0.v + s * (c1.v - c0.v) + t * (c2.v - c0.v));
    return true;
  }

  const ClipPolygon& m_part;
  std::size_t m_count;
  std::array<glm::dvec2, ClipPolygon::kMost> m_at;
  glm::dvec2 m_low{0.0}, m_high{0.0};
};

class Voxeliser {
 public:
  Voxeliser(const TriangleField& field, const LeafArea& grid) : m_field(field), m_grid(grid) {
    m_toCells = 1.0 / grid.voxelM;
    m_perVolume = 1.0 / (grid.voxelM.x * grid.voxelM.y * grid.voxelM.z);
    for (const auto& model : field.patch().models) {
      m_sides.push_back(model ? mesh::triangleSides(*model) : std::vector<mesh::Side>());
    }
  }

  Block cut(std::uint64_t begin, std::uint64_t end) const {
    Block block;
    block.tensors.reserve(end - begin);
    for (std::uint64_t t = begin; t < end; ++t) addTriangle(block, static_cast<std::uint32_t>(t));
    return block;
  }

 private:
  void addTriangle(Block& block, std::uint32_t number) const {
    const TriangleField::Part& part = m_field.partOf(number);
    const std::uint32_t triangle = number - part.firstTriangle;
    const glm::uvec3 corner = part.model->triangles[triangle];
    const glm::vec3* vertices = m_field.positions().data() + part.firstVertex;
    const glm::dvec3 a(vertices[corner.x]), b(vertices[corner.y]), c(vertices[corner.z]);
    const glm::dvec3 n = glm::cross(b - a, c - a);  // twice the area long
    const double length = glm::length(n);
    if (!(length > 0.0)) return;
    const bool open = m_sides[m_field.patch().instances[part.instance].model][triangle] == mesh::Side::Open;
    const double scale = (open ? 0.5 : 0.25) * m_perVolume / length;
    const auto index = static_cast<std::uint32_t>(block.tensors.size());
    block.tensors.push_back({scale * n.x * n.x, scale * n.x * n.y, scale * n.x * n.z, scale * n.y * n.y,
                             scale * n.y * n.z, scale * n.z * n.z});
    ClipPolygon polygon;
    polygon.add({a * m_toCells, 0.0, 0.0});
    polygon.add({b * m_toCells, 1.0, 0.0});
    polygon.add({c * m_toCells, 0.0, 1.0});
    ClipPolygon under, above;
    splitPolygon(polygon, 2, 0.0, under, above);
    if (above.count < 3) return;
    forEachCell(above, [&](const glm::ivec3& cell, const ClipPolygon& inside) {
      Fragment fragment{voxelOf(cell), index, inside.share(), {}};
      if (part.alpha) fragment.share *= meanAlpha(*part.model, triangle, inside);
      if (!(fragment.share > 0.0)) return;
      for (int axis = 0; axis < 3; ++axis) {
        fragment.lines[static_cast<std::size_t>(axis)] = linesOf(part, number, cell, inside, axis);
      }
      block.fragments.push_back(fragment);
    });
  }
  /// The lines along an axis that a part blocks.
  std::uint64_t linesOf(const TriangleField::Part& part, std::uint32_t number, const glm::ivec3& cell,
                        const ClipPolygon& inside, int axis) const {
    std::uint64_t lines = 0;
    Silhouette(inside, cell, axis).forEachLine([&](int bit, double u, double v) {
      if (part.alpha) {
        const float alpha =
            mesh::alphaAt(*part.model, number - part.firstTriangle, static_cast<float>(u), static_cast<float>(v));
        const std::uint64_t line = voxelOf(cell) * 3 + static_cast<std::uint64_t>(axis);
        if (base::unitFloat(base::mix64(number, line, static_cast<std::uint64_t>(bit))) >= alpha) return;
      }
      lines |= std::uint64_t{1} << bit;
    });
    return lines;
  }
  std::size_t voxelOf(const glm::ivec3& cell) const {
    const int x = wrapped(cell.x, m_grid.columns), y = wrapped(cell.y, m_grid.columns);
    const int z = std::min(cell.z, m_grid.layers - 1);
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(m_grid.columns) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(m_grid.columns) +
           static_cast<std::size_t>(x);
  }

  const TriangleField& m_field;
  const LeafArea& m_grid;
  std::vector<std::vector<mesh::Side>> m_sides;  ///< [model][triangle]
  glm::dvec3 m_toCells{0.0};
  double m_perVolume = 0.0;
};

Result<LeafArea> emptyGrid(const scene::Patch& patch, int columns, int layers) {
  if (!std::isfinite(patch.sideM) || patch.sideM <= 0.0 || !std::isfinite(patch.heightM) || patch.heightM <= 0.0) {
    return Error::badInput("the patch has no size", "voxels of a patch", "Its side and height must be positive metres");
  }
  if (columns < 1 || layers < 1 || 1.0 * columns * columns * layers > kMaxVoxels) {
    return Error::badInput(std::to_string(columns) + " voxels along a side and " + std::to_string(layers) + " layers",
                           "voxels of a patch", "Give at least 1 of each, and at most 2^23 voxels in all");
  }
  LeafArea area;
  area.columns = columns;
  area.layers = layers;
  area.voxelM = {patch.sideM / columns, patch.sideM / columns, patch.heightM / layers};
  return area;
}

void add(const Block& block, Sums& sums) {
  for (const Fragment& f : block.fragments) {
    for (std::size_t i = 0; i < 6; ++i) sums.tensor[f.voxel][i] += f.share * block.tensors[f.triangle][i];
    for (std::size_t i = 0; i < 3; ++i) sums.lines[f.voxel][i] |= f.lines[i];
  }
}

}  // namespace

Result<LeafArea> leafArea(std::shared_ptr<const scene::Patch> patch, int columns, int layers, const JobContext& job) {
  SWARD_CHECK(patch != nullptr);
  SWARD_ASSIGN(LeafArea area, emptyGrid(*patch, columns, layers));
  SWARD_ASSIGN(const std::unique_ptr<TriangleField> field, TriangleField::create(std::move(patch), job));
  const Voxeliser voxeliser(*field, area);
  const std::size_t voxels =
      static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns) * static_cast<std::size_t>(layers);
  Sums sums{std::vector<std::array<double, 6>>(voxels), std::vector<std::array<std::uint64_t, 3>>(voxels)};
  const std::uint64_t triangles = field->triangles();
  base::ProgressCounter progress(job, "Leaf area by voxels", triangles);
  for (std::uint64_t first = 0; first < triangles && !job.cancelled(); first += kBlock * kBlocksAtOnce) {
    const std::uint64_t count = std::min<std::uint64_t>(kBlock * kBlocksAtOnce, triangles - first);
    std::vector<Block> blocks((count + kBlock - 1) / kBlock);
    base::parallelFor(job, count, kBlock, [&](std::size_t begin, std::size_t end) {
      blocks[begin / kBlock] = voxeliser.cut(first + begin, first + end);
    });
    for (const Block& block : blocks) add(block, sums);
    progress.add(count);
  }
  if (job.cancelled()) return Error::cancelled();
  area.tensor.resize(voxels);
  area.blocked.resize(voxels);
  for (std::size_t v = 0; v < voxels; ++v) {
    for (std::size_t i = 0; i < 6; ++i) area.tensor[v][i] = static_cast<float>(sums.tensor[v][i]);
    for (std::size_t i = 0; i < 3; ++i) {
      area.blocked[v][i] = static_cast<std::uint8_t>(std::popcount(sums.lines[v][i]));
    }
  }
  return area;
}

}  // namespace sward::trace
