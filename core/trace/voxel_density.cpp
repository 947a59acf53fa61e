#include "trace/voxel_density.h"

#include "base/check.h"
#include "base/parallel.h"
#include "trace/fast_floor.h"
#include "trace/voxel_march.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::trace {
namespace {

constexpr std::size_t kGrain = 16384;

/// -ln(transmittance) along the three axes, summed. Where no line passes, half a line is taken to.
double measuredDepth(const std::array<std::uint8_t, 3>& blocked) {
  double sum = 0.0;
  for (const std::uint8_t lines : blocked) {
    const double free = std::max(static_cast<double>(LeafArea::kLines - lines), 0.5);
    sum -= std::log(free / LeafArea::kLines);
  }
  return sum;
}

/// How often `depth`, of extinctions along the axes, goes into what was measured.
double gainOf(const std::array<std::uint8_t, 3>& blocked, double depth) {
  return depth > 0.0 ? measuredDepth(blocked) / depth : 0.0;
}

constexpr std::array kAxes{glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)};

}  // namespace

VoxelDensity::VoxelDensity(std::shared_ptr<const scene::Patch> patch, const VoxelOptions& options)
    : m_patch(std::move(patch)), m_options(options) {
  for (const auto& model : m_patch->models) {
    m_sides.push_back(model ? mesh::triangleSides(*model) : std::vector<mesh::Side>());
  }
}

Result<std::shared_ptr<const VoxelDensity>> VoxelDensity::create(std::shared_ptr<const scene::Patch> patch,
                                                                 const VoxelOptions& options, const JobContext& job) {
  SWARD_ASSIGN(LeafArea area, leafArea(patch, options.columns, options.layers, job));
  std::shared_ptr<VoxelDensity> density(new VoxelDensity(std::move(patch), options));
  density->m_voxelM = area.voxelM;
  density->fill(area, job);
  if (job.cancelled()) return Error::cancelled();
  if (options.form != VoxelOptions::Form::Packed) return std::shared_ptr<const VoxelDensity>(std::move(density));
  density->m_options.form = VoxelOptions::Form::Dominant;
  return density->packed();
}

void VoxelDensity::fill(const LeafArea& area, const JobContext& job) {
  const bool tensors = m_options.form == VoxelOptions::Form::Tensor;
  const std::size_t count = area.tensor.size();
  if (tensors) {
    m_tensor.resize(count);
  } else {
    m_dominant.resize(count);
  }
  base::parallelFor(job, count, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double depth = 0.0;
      if (tensors) {
        for (int axis = 0; axis < 3; ++axis) {
          depth += boundOf(area.tensor[v], kAxes[static_cast<std::size_t>(axis)]) * m_voxelM[axis];
        }
        const auto gain = static_cast<float>(gainOf(area.blocked[v], depth));
        for (std::size_t i = 0; i < 6; ++i) m_tensor[v][i] = gain * area.tensor[v][i];
      } else {
        m_dominant[v] = dominantOf(area.tensor[v]);
        for (int axis = 0; axis < 3; ++axis) {
          depth += static_cast<double>(m_dominant[v].extinction(glm::vec3(kAxes[static_cast<std::size_t>(axis)]))) *
                   m_voxelM[axis];
        }
        m_dominant[v].density *= static_cast<float>(gainOf(area.blocked[v], depth));
      }
    }
  });
}

std::size_t VoxelDensity::voxels() const {
  const auto columns = static_cast<std::size_t>(m_options.columns);
  return columns * columns * static_cast<std::size_t>(m_options.layers);
}

std::uint64_t VoxelDensity::bytes() const {
  return m_tensor.size() * sizeof(m_tensor[0]) + m_dominant.size() * sizeof(m_dominant[0]) +
         m_packed.size() * sizeof(m_packed[0]);
}

std::size_t VoxelDensity::index(int x, int y, int z) const {
  const auto columns = static_cast<std::size_t>(m_options.columns);
  return (static_cast<std::size_t>(z) * columns + static_cast<std::size_t>(y)) * columns + static_cast<std::size_t>(x);
}

DominantVoxel VoxelDensity::voxel(std::size_t at) const {
  if (!m_dominant.empty()) return m_dominant[at];
  if (!m_tensor.empty()) return dominantOf(m_tensor[at]);
  const std::size_t plane = voxels() / static_cast<std::size_t>(m_options.layers);
  const std::size_t layer = at / plane;
  return unpack(m_packed[layer / 2 * plane + at % plane], layer % 2 == 1, m_largest);
}

double VoxelDensity::extinctionOf(std::size_t at, const glm::dvec3& l) const {
  if (!m_tensor.empty()) return boundOf(m_tensor[at], l);
  return static_cast<double>(voxel(at).extinction(glm::vec3(l)));
}

Result<std::vector<float>> VoxelDensity::extinctions(const glm::dvec3& l, const JobContext& job) const {
  std::vector<float> out(voxels());
  base::parallelFor(job, out.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) out[v] = static_cast<float>(extinctionOf(v, l));
  });
  if (job.cancelled()) return Error::cancelled();
  return out;
}

double VoxelDensity::opticalDepth(const glm::dvec3& from, const glm::dvec3& l, double leadM, double enough) const {
  return VoxelMarch(m_options.columns, m_options.layers, m_voxelM, l).depth(from, leadM, enough, [&](std::size_t v) {
    return extinctionOf(v, l);
  });
}

VoxelDensity::Dominant VoxelDensity::dominant(const glm::dvec3& at) const {
  const glm::dvec3 cell = glm::floor(at / m_voxelM);
  const DominantVoxel found = voxel(index(wrapped(static_cast<int>(cell.x), m_options.columns),
                                          wrapped(static_cast<int>(cell.y), m_options.columns),
                                          std::clamp(static_cast<int>(cell.z), 0, m_options.layers - 1)));
  if (!(found.density > 0.0f)) return {};
  return {glm::dvec3(found.normal), static_cast<double>(found.share)};
}

std::shared_ptr<const VoxelDensity> VoxelDensity::packed() const {
  SWARD_CHECK(m_options.form == VoxelOptions::Form::Dominant);
  std::shared_ptr<VoxelDensity> out(new VoxelDensity(m_patch, m_options));
  out->m_options.form = VoxelOptions::Form::Packed;
  out->m_voxelM = m_voxelM;
  const auto layers = static_cast<std::size_t>(m_options.layers);
  const std::size_t plane = voxels() / layers, pairs = (layers + 1) / 2 * plane;
  const glm::vec3 size(m_voxelM);
  const auto pairAt = [&](std::size_t i) {
    const std::size_t lower = i / plane * 2 * plane + i % plane, upper = lower + plane;
    return paired(m_dominant[lower], upper < m_dominant.size() ? m_dominant[upper] : DominantVoxel{}, size);
  };
  for (std::size_t i = 0; i < pairs; ++i) {
    for (const DominantVoxel& voxel : pairAt(i)) out->m_largest = std::max(out->m_largest, voxel.density);
  }
  out->m_packed.assign(pairs, 0);
  for (std::size_t i = 0; out->m_largest > 0.0f && i < pairs; ++i) {
    const std::array<DominantVoxel, 2> pair = pairAt(i);
    out->m_packed[i] = packPair(pair[0], pair[1], out->m_largest);
  }
  return out;
}

VoxelDensity::Seen VoxelDensity::seen(const Hit& hit) const {
  const scene::Instance& instance = m_patch->instances[hit.instance];
  const mesh::Side side = m_sides[instance.model][hit.triangle];
  if (side == mesh::Side::Open || side == mesh::Side::Flat) return Seen::BothSides;
  const mesh::Model& model = *m_patch->models[instance.model];
  const glm::uvec3 corner = model.triangles[hit.triangle];
  const glm::vec3 a = model.positions[corner.x];
  const glm::vec3 winding =
      glm::mat3(instance.worldFromModel) * glm::cross(model.positions[corner.y] - a, model.positions[corner.z] - a);
  const bool front = glm::dot(decodeNormal(hit.normal), winding) >= 0.0f;
  return front == (side == mesh::Side::Out) ? Seen::Outside : Seen::Inside;
}

}  // namespace sward::trace
