#include "wither/texel_light.h"

#include "base/parallel.h"
#include "wither/extinction.h"
#include "wither/light_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace sward::wither {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr std::size_t kRings = 3, kPerRing = 5;
constexpr std::size_t kSkyDirections = kRings * kPerRing;

/// Directions of equal cosine-weighted solid angle over the upper hemisphere (Malley: the disc, in rings of equal
/// area), each ring turned against the one below.
std::array<glm::dvec3, kSkyDirections> skyDirections() {
  std::array<glm::dvec3, kSkyDirections> directions;
  for (std::size_t k = 0; k < kSkyDirections; ++k) {
    const auto ring = static_cast<double>(k / kPerRing), i = static_cast<double>(k % kPerRing);
    const double radius = std::sqrt((ring + 0.5) / kRings);
    const double azimuth = 2.0 * std::numbers::pi * (i + 0.37 * ring) / kPerRing;
    directions[k] = {radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1.0 - radius * radius)};
  }
  return directions;
}

/// What of a texel's voxels counts for light, wherever it comes from, and what they see of the sky; row by row.
class SkySweep {
 public:
  SkySweep(const Texel& texel, const TexelRows& rows)
      : m_rows(rows),
        m_front(texel.size(), 0.0f),
        m_back(texel.size(), 0.0f),
        m_ground(static_cast<std::size_t>(texel.grid().columns) * static_cast<std::size_t>(texel.grid().columns),
                 0.0f) {
    for (std::vector<float>& buffer : m_buffers) buffer.resize(texel.size());
    for (std::vector<float>& form : m_form) form.resize(texel.size());
    for (std::vector<float>& side : m_sides) side.resize(texel.size());
  }

  void prepare(const Texel& texel, const JobContext& job) {
    base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Voxel& voxel = texel.voxels()[m_rows.order()[i]];
        const std::array<float, 6> form = sectionForm(voxel);
        for (std::size_t k = 0; k < form.size(); ++k) m_form[k][i] = form[k];
        const auto share = static_cast<float>(normalShare(voxel));
        const glm::vec3 n = share * voxel.normal;
        m_sides[0][i] = n.x, m_sides[1][i] = n.y, m_sides[2][i] = n.z, m_sides[3][i] = 0.25f * (1.0f - share);
      }
    });
  }

  /// A ring at once: what is known of a voxel is read from memory once for all of its directions.
  Result<void> add(std::span<const glm::dvec3, kPerRing> ring, const JobContext& job) {
    base::parallelFor(job, m_front.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t d = 0; d < kPerRing; ++d) setExtinctions(ring[d], m_buffers[d].data(), begin, end);
    });
    for (std::size_t d = 0; d < kPerRing; ++d) {
      std::vector<float>& spare = m_buffers.back();
      SWARD_TRY(sweepDepths(m_rows, m_buffers[d], ring[d], m_depths, spare, job));
      std::swap(m_buffers[d], spare);
      addGround();
    }
    base::parallelFor(job, m_front.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t d = 0; d < kPerRing; ++d) addSeen(ring[d], m_buffers[d].data(), begin, end);
    });
    return {};
  }

  /// In the order of the voxels.
  TexelSky sky(const JobContext& job) {
    TexelSky sky{std::vector<float>(m_front.size()), std::vector<float>(m_back.size()), std::move(m_ground)};
    base::parallelFor(job, m_front.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        sky.front[m_rows.order()[i]] = m_front[i];
        sky.back[m_rows.order()[i]] = m_back[i];
      }
    });
    return sky;
  }

 private:
  void setExtinctions(const glm::dvec3& l, float* extinctions, std::size_t begin, std::size_t end) const {
    const auto x = static_cast<float>(l.x), y = static_cast<float>(l.y), z = static_cast<float>(l.z);
    const float *xx = m_form[0].data(), *xy = m_form[1].data(), *xz = m_form[2].data(), *yy = m_form[3].data(),
                *yz = m_form[4].data(), *zz = m_form[5].data();
    for (std::size_t i = begin; i < end; ++i) {
      const float square =
          x * (xx[i] * x + 2.0f * (xy[i] * y + xz[i] * z)) + y * (yy[i] * y + 2.0f * yz[i] * z) + zz[i] * z * z;
      extinctions[i] = std::sqrt(std::max(square, 0.0f));
    }
  }
  void addGround() {
    constexpr float kEach = 1.0f / kSkyDirections;
    for (std::size_t i = 0; i < m_ground.size(); ++i) m_ground[i] += kEach * transmittanceOf(m_depths[i]);
  }
  /// Three loops, each of few enough arrays for the compiler to see that they are apart. `seen`: depths, and then what
  /// of them is left of the sky's part.
  void addSeen(const glm::dvec3& l, float* seen, std::size_t begin, std::size_t end) {
    const auto each = static_cast<float>(1.0 / (kSkyDirections * l.z));
    for (std::size_t i = begin; i < end; ++i) seen[i] = each * transmittanceOf(seen[i]);
    addSide(glm::vec3(l), seen, m_front.data(), begin, end);
    addSide(-glm::vec3(l), seen, m_back.data(), begin, end);
  }
  void addSide(const glm::vec3& l, const float* seen, float* side, std::size_t begin, std::size_t end) const {
    const float x = l.x, y = l.y, z = l.z;
    const float *nx = m_sides[0].data(), *ny = m_sides[1].data(), *nz = m_sides[2].data(), *any = m_sides[3].data();
    for (std::size_t i = begin; i < end; ++i) {
      const float facing = nx[i] * x + ny[i] * y + nz[i] * z;  // as leafSides: half of |f| + f is what is above 0
      side[i] += seen[i] * (0.5f * (std::abs(facing) + facing) + any[i]);
    }
  }

  const TexelRows& m_rows;
  std::array<std::vector<float>, 6> m_form;   ///< sectionForm
  std::array<std::vector<float>, 4> m_sides;  ///< the normal times its share, and what falls on either side anyhow
  /// Extinctions toward a ring's directions, which one after another become depths; and one to spare.
  std::array<std::vector<float>, kPerRing + 1> m_buffers;
  std::vector<float> m_depths;  ///< of the ground
  std::vector<float> m_front, m_back, m_ground;
};

}  // namespace

Result<TexelSky> sweptSky(const Texel& texel, const JobContext& job) {
  SWARD_ASSIGN(const TexelRows rows, TexelRows::create(texel, job));
  SkySweep sweep(texel, rows);
  sweep.prepare(texel, job);
  const auto directions = skyDirections();
  for (std::size_t ring = 0; ring < kRings; ++ring) {
    SWARD_TRY(sweep.add(std::span(directions).subspan(ring * kPerRing).first<kPerRing>(), job));
  }
  TexelSky sky = sweep.sky(job);
  if (job.cancelled()) return Error::cancelled();
  return sky;
}

float throughOwnLeaves(const TexelGrid& grid, const Voxel& voxel, float share, const glm::vec3& l) {
  const glm::vec3 voxels = glm::abs(l) / glm::vec3(grid.voxelM());
  const float leadM = 1.0f / std::max(voxels.x, std::max(voxels.y, voxels.z));
  return transmittanceOf((1.0f - share) * leadM * sectionToward(voxel, l));
}

Result<SunReach> sunReach(const Texel& texel, const glm::dvec3& toSun, const JobContext& job) {
  const auto columns = static_cast<std::size_t>(texel.grid().columns);
  SunReach reach{std::vector<float>(texel.size(), 0.0f), std::vector<float>(columns * columns, 0.0f)};
  if (!(toSun.z > 0.0)) return reach;
  SWARD_ASSIGN(const TexelRows rows, TexelRows::create(texel, job));
  const std::span<const std::uint32_t> order = rows.order();
  // Voxels are read in their own order, fast; what is left of each is small enough to be put in rows afterwards.
  base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const glm::vec3 l(toSun);
    for (std::size_t i = begin; i < end; ++i) reach.voxels[i] = sectionToward(texel.voxels()[i], l);
  });
  std::vector<float> extinctions(texel.size()), depths(texel.size());
  base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) extinctions[i] = reach.voxels[order[i]];
  });
  SWARD_TRY(sweepDepths(rows, extinctions, toSun, reach.ground, depths, job));
  base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) reach.voxels[order[i]] = transmittanceOf(depths[i]);
  });
  for (float& ground : reach.ground) ground = transmittanceOf(ground);
  if (job.cancelled()) return Error::cancelled();
  return reach;
}

}  // namespace sward::wither
