#include "wither/voxelise.h"

#include "base/parallel.h"
#include "trace/fast_floor.h"
#include "trace/triangle_clip.h"
#include "trace/triangle_field.h"
#include "wither/leaf_facet.h"
#include "wither/voxel_mean.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>

namespace sward::wither {
namespace {

constexpr int kBrick = TexelGrid::kBrick;
constexpr std::size_t kTriangles = 256;  ///< cut by one task
constexpr std::size_t kBricks = 32;      ///< summed by one task
/// Of a voxel: what lies so little under the ground or above the grid has come there by rounding, and belongs to the
/// layer that it touches.
constexpr double kRounding = 1e-4;

/// A part of a triangle in a voxel.
struct Fragment {
  std::uint32_t brick = 0, voxel = 0, triangle = 0;
  float u = 0.0f, v = 0.0f;  ///< its middle
  double areaM2 = 0.0;       ///< one-sided, times alpha
  glm::vec3 reflectance{0.0f}, transmittance{0.0f};
};

/// Middle and mean surface of a part, the surface weighted by alpha.
struct PartSurface {
  double u = 0.0, v = 0.0, alpha = 0.0;
  glm::dvec3 reflectance{0.0}, transmittance{0.0};
};

/// Means over each triangle of the part's fan: from a lattice where alpha or a texture varies, else at its middle,
/// which is exact for colours that are linear over the triangle.
PartSurface surfaceOf(const mesh::Model& model, std::uint32_t triangle, bool varies, const trace::ClipPolygon& part) {
  const int lattice = varies ? 4 : 1;
  const double weightOfPoint = 2.0 / (lattice * (lattice + 1));
  PartSurface mean;
  double area = 0.0;
  for (std::size_t i = 2; i < part.count; ++i) {
    const trace::ClipCorner &a = part.corners[0], &b = part.corners[i - 1], &c = part.corners[i];
    const double u1 = b.u - a.u, v1 = b.v - a.v, u2 = c.u - a.u, v2 = c.v - a.v;
    const double weight = std::abs(u1 * v2 - u2 * v1);
    area += weight;
    mean.u += weight * (a.u + (u1 + u2) / 3.0);
    mean.v += weight * (a.v + (v1 + v2) / 3.0);
    for (int p = 0; p < lattice; ++p) {
      for (int q = 0; p + q < lattice; ++q) {
        const double s = (p + 1.0 / 3.0) / lattice, t = (q + 1.0 / 3.0) / lattice;
        const mesh::SurfaceSample at = mesh::surfaceAt(model, triangle, static_cast<float>(a.u + s * u1 + t * u2),
                                                       static_cast<float>(a.v + s * v1 + t * v2));
        const double w = weight * weightOfPoint * static_cast<double>(at.alpha);
        mean.alpha += w;
        mean.reflectance += w * glm::dvec3(at.reflectance);
        mean.transmittance += w * glm::dvec3(at.transmittance);
      }
    }
  }
  mean.u /= area;
  mean.v /= area;
  if (mean.alpha > 0.0) {
    mean.reflectance /= mean.alpha;
    mean.transmittance /= mean.alpha;
  }
  mean.alpha /= area;
  return mean;
}

/// The strands that a voxel's leaves belong to.
class StrandTally {
 public:
  void add(std::int32_t strand, double areaM2, double s) {
    for (Share& share : m_shares) {
      if (share.strand != strand) continue;
      share.areaM2 += areaM2;
      share.s += areaM2 * s;
      return;
    }
    m_shares.push_back({strand, areaM2, areaM2 * s});
  }
  /// The strand of most area, the first of equal ones, and the mean s on it.
  Attachment most() const {
    Share most;
    for (const Share& share : m_shares) {
      if (share.areaM2 > most.areaM2) most = share;
    }
    return {most.strand, most.areaM2 > 0.0 ? static_cast<float>(std::clamp(most.s / most.areaM2, 0.0, 1.0)) : 0.0f};
  }

 private:
  struct Share {
    std::int32_t strand = -1;
    double areaM2 = 0.0, s = 0.0;
  };
  std::vector<Share> m_shares;
};

class Voxeliser {
 public:
  Voxeliser(const trace::TriangleField& field, const TexelGrid& grid, const PatchStrands* strands)
      : m_field(field), m_facets(field, strands), m_grid(grid), m_toCells(1.0 / grid.voxelM()) {}

  std::vector<Fragment> cut(std::uint64_t begin, std::uint64_t end) const {
    std::vector<Fragment> fragments;
    for (std::uint64_t t = begin; t < end; ++t) cutTriangle(static_cast<std::uint32_t>(t), fragments);
    return fragments;
  }

  /// The voxels of a brick from its fragments, which it sorts; `attachments` gets one a voxel when there are strands.
  void sum(std::uint32_t brick, std::span<const Fragment*> fragments, Texel::Chunk& chunk,
           std::vector<Attachment>& attachments) const {
    std::stable_sort(fragments.begin(), fragments.end(),
                     [](const Fragment* a, const Fragment* b) { return a->voxel < b->voxel; });
    chunk.bricks.push_back(brick);
    chunk.masks.emplace_back();
    for (std::size_t first = 0, last = 0; first < fragments.size(); first = last) {
      const std::uint32_t voxel = fragments[first]->voxel;
      while (last < fragments.size() && fragments[last]->voxel == voxel) ++last;
      chunk.masks.back()[voxel / 64] |= std::uint64_t{1} << (voxel % 64);
      chunk.voxels.push_back(voxelOf(fragments.subspan(first, last - first), attachments));
    }
  }

 private:
  void cutTriangle(std::uint32_t number, std::vector<Fragment>& fragments) const {
    const double area = m_facets.of(number).areaM2;
    if (!(area > 0.0)) return;
    const trace::TriangleField::Part& part = m_field.partOf(number);
    const std::uint32_t triangle = number - part.firstTriangle;
    const glm::uvec3 corner = part.model->triangles[triangle];
    const glm::vec3* vertices = m_field.positions().data() + part.firstVertex;
    const bool varies = part.alpha || part.model->materials[part.model->triangleMaterial[triangle]].texture >= 0;
    trace::ClipPolygon polygon, under, above, inside;
    polygon.add({glm::dvec3(vertices[corner.x]) * m_toCells, 0.0, 0.0});
    polygon.add({glm::dvec3(vertices[corner.y]) * m_toCells, 1.0, 0.0});
    polygon.add({glm::dvec3(vertices[corner.z]) * m_toCells, 0.0, 1.0});
    trace::splitPolygon(polygon, 2, -kRounding, under, above);
    polygon = above;
    trace::splitPolygon(polygon, 2, m_grid.layers + kRounding, inside, above);
    if (inside.count < 3) return;
    trace::forEachCell(inside, [&](const glm::ivec3& cell, const trace::ClipPolygon& cut) {
      const PartSurface surface = surfaceOf(*part.model, triangle, varies, cut);
      Fragment fragment = placed(cell);
      fragment.triangle = number;
      fragment.areaM2 = area * cut.share() * surface.alpha;
      if (!(fragment.areaM2 > 0.0)) return;
      fragment.u = static_cast<float>(surface.u);
      fragment.v = static_cast<float>(surface.v);
      fragment.reflectance = glm::vec3(surface.reflectance);
      fragment.transmittance = glm::vec3(surface.transmittance);
      fragments.push_back(fragment);
    });
  }

  Fragment placed(const glm::ivec3& cell) const {
    const glm::ivec3 at(trace::wrapped(cell.x, m_grid.columns), trace::wrapped(cell.y, m_grid.columns),
                        std::clamp(cell.z, 0, m_grid.layers - 1));
    const glm::ivec3 brick = at / kBrick, within = at % kBrick;
    Fragment fragment;
    fragment.brick = static_cast<std::uint32_t>((brick.z * m_grid.brickRow() + brick.y) * m_grid.brickRow() + brick.x);
    fragment.voxel = static_cast<std::uint32_t>((within.z * kBrick + within.y) * kBrick + within.x);
    return fragment;
  }

  /// Of the fragments of one voxel, in the order of triangles.
  Voxel voxelOf(std::span<const Fragment* const> fragments, std::vector<Attachment>& attachments) const {
    StrandTally strands;
    LeafSums sums;
    for (const Fragment* fragment : fragments) {
      const LeafFacet facet = m_facets.of(fragment->triangle);
      const double area = fragment->areaM2;
      // A sign that is only guessed must not cancel what neighbours on the same leaf guessed.
      const glm::dvec3 n = !facet.oriented && glm::dot(facet.normal, sums.normal) < 0.0 ? -facet.normal : facet.normal;
      sums.weight += area;
      sums.normal += area * n;
      sums.tangent += area * facet.tangent;
      sums.diffuse += area * glm::dvec3(fragment->reflectance);
      sums.transmitted += area * glm::dvec3(fragment->transmittance);
      const std::array<double, 6> square{n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z};
      for (std::size_t i = 0; i < 6; ++i) sums.spread[i] += area * square[i];
      const double s =
          facet.s + facet.du * static_cast<double>(fragment->u) + facet.dv * static_cast<double>(fragment->v);
      strands.add(facet.strand, area, s);
    }
    attachments.push_back(strands.most());
    const double perVolume = 1.0 / m_grid.voxelVolumeM3();
    sums.specular = sums.weight * static_cast<double>(kLeafSpecular);
    Voxel voxel = sums.means();
    // An area too small for a float's range still is no empty voxel.
    voxel.density = std::max(static_cast<float>(sums.weight * perVolume), std::numeric_limits<float>::min());
    for (std::size_t i = 0; i < 6; ++i) voxel.spread[i] = static_cast<float>(sums.spread[i] * perVolume);
    return voxel;
  }

  const trace::TriangleField& m_field;
  LeafFacets m_facets;
  TexelGrid m_grid;
  glm::dvec3 m_toCells;
};

/// Fragments by brick: those of the i-th brick of `bricks` are [start[i], start[i + 1]) of `fragments`, in the order of
/// triangles.
struct ByBrick {
  std::vector<std::uint32_t> bricks;
  std::vector<std::size_t> start;
  std::vector<const Fragment*> fragments;
};
ByBrick byBrick(const std::vector<std::vector<Fragment>>& blocks, std::size_t brickCount) {
  std::vector<std::size_t> next(brickCount, 0);
  for (const auto& block : blocks) {
    for (const Fragment& fragment : block) ++next[fragment.brick];
  }
  ByBrick sorted;
  sorted.start.push_back(0);
  for (std::size_t brick = 0; brick < brickCount; ++brick) {
    if (next[brick] == 0) continue;
    sorted.bricks.push_back(static_cast<std::uint32_t>(brick));
    sorted.start.push_back(sorted.start.back() + next[brick]);
    next[brick] = *std::prev(sorted.start.end(), 2);
  }
  sorted.fragments.resize(sorted.start.back());
  for (const auto& block : blocks) {
    for (const Fragment& fragment : block) sorted.fragments[next[fragment.brick]++] = &fragment;
  }
  return sorted;
}

Result<void> checkSizes(const scene::Patch& patch, const TexelGrid& grid) {
  SWARD_TRY(checkGrid(grid));
  if (std::abs(patch.sideM - grid.sideM) <= 1e-6 * grid.sideM) return {};
  return Error::badInput(
      "a patch of " + std::to_string(patch.sideM) + " m does not fit a texel of " + std::to_string(grid.sideM) + " m",
      "voxelising", "Give the grid the patch's side.");
}

}  // namespace

Result<VoxelisedPatch> voxelise(const scene::Patch& patch, const TexelGrid& grid, const PatchStrands* strands,
                                const JobContext& job) {
  SWARD_TRY(checkSizes(patch, grid));
  // The field only reads the patch, and does not outlive this call.
  const std::shared_ptr<const scene::Patch> view(std::shared_ptr<const scene::Patch>(), &patch);
  SWARD_ASSIGN(const std::unique_ptr<trace::TriangleField> field, trace::TriangleField::create(view, job));
  const Voxeliser voxeliser(*field, grid, strands);
  const auto triangles = static_cast<std::size_t>(field->triangles());
  base::ProgressCounter progress(job, "Voxelising", triangles);
  std::vector<std::vector<Fragment>> blocks((triangles + kTriangles - 1) / kTriangles);
  base::parallelFor(job, triangles, kTriangles, [&](std::size_t begin, std::size_t end) {
    blocks[begin / kTriangles] = voxeliser.cut(begin, end);
    progress.add(end - begin);
  });
  if (job.cancelled()) return Error::cancelled();
  ByBrick sorted = byBrick(blocks, grid.brickCount());
  const std::size_t count = sorted.bricks.size();
  std::vector<Texel::Chunk> chunks((count + kBricks - 1) / kBricks);
  std::vector<std::vector<Attachment>> attachments(chunks.size());
  base::parallelFor(job, count, kBricks, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<const Fragment*> fragments(sorted.fragments.data() + sorted.start[i],
                                                 sorted.start[i + 1] - sorted.start[i]);
      voxeliser.sum(sorted.bricks[i], fragments, chunks[begin / kBricks], attachments[begin / kBricks]);
    }
  });
  VoxelisedPatch out;
  out.texel = Texel::fromChunks(grid, chunks, job);
  if (job.cancelled()) return Error::cancelled();
  if (strands == nullptr) return out;
  out.attachments.reserve(out.texel.size());
  for (const auto& part : attachments) out.attachments.insert(out.attachments.end(), part.begin(), part.end());
  return out;
}

}  // namespace sward::wither
