#include "wither/texel_light.h"

#include "base/parallel.h"
#include "wither/extinction.h"
#include "wither/light_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace sward::wither {
namespace {

constexpr std::size_t kGrain = 4096;
constexpr int kRings = 3, kPerRing = 5;
constexpr int kSkyDirections = kRings * kPerRing;

/// Directions of equal cosine-weighted solid angle over the upper hemisphere (Malley: the disc, in rings of equal
/// area), each ring turned against the one below.
std::array<glm::dvec3, kSkyDirections> skyDirections() {
  std::array<glm::dvec3, kSkyDirections> directions;
  for (int ring = 0; ring < kRings; ++ring) {
    const double radius = std::sqrt((ring + 0.5) / kRings);
    for (int i = 0; i < kPerRing; ++i) {
      const double azimuth = 2.0 * std::numbers::pi * (i + 0.37 * ring) / kPerRing;
      directions[static_cast<std::size_t>(ring * kPerRing + i)] = {
          radius * std::cos(azimuth), radius * std::sin(azimuth), std::sqrt(1.0 - radius * radius)};
    }
  }
  return directions;
}

/// A voxel's part of leaves that have its normal, and the irradiance that a unit beam from l gives its two sides.
struct Facing {
  float front = 0.0f, back = 0.0f;
};
Facing facing(const glm::vec3& normal, float share, const glm::vec3& l) {
  const float cosine = normal.x * l.x + normal.y * l.y + normal.z * l.z;
  const float any = 0.25f * (1.0f - share);  // leaves of every direction: half of |n.l| = 1/2 on either side
  return {share * std::max(cosine, 0.0f) + any, share * std::max(-cosine, 0.0f) + any};
}

/// What of a voxel counts for light, whatever it comes from: a third of the voxel's bytes, read once a direction.
struct LeafShape {
  LeafSection section;
  glm::vec3 normal;
  float share;
};

/// All directions' light over one texel, row by row.
class SkySweep {
 public:
  SkySweep(const Texel& texel, const TexelRows& rows)
      : m_rows(rows),
        m_shapes(texel.size()),
        m_extinction(texel.size()),
        m_front(texel.size(), 0.0f),
        m_back(texel.size(), 0.0f),
        m_ground(static_cast<std::size_t>(texel.grid().columns) * static_cast<std::size_t>(texel.grid().columns),
                 0.0f) {}

  void prepare(const Texel& texel, const JobContext& job) {
    base::parallelFor(job, m_shapes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Voxel& voxel = texel.voxels()[m_rows.order()[i]];
        m_shapes[i] = {LeafSection(voxel), voxel.normal, static_cast<float>(normalShare(voxel))};
      }
    });
  }

  Result<void> add(const glm::dvec3& l, const JobContext& job) {
    const glm::vec3 toward(l);
    base::parallelFor(job, m_shapes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) m_extinction[i] = m_shapes[i].section(toward);
    });
    SWARD_ASSIGN(const SweptDepths depths, sweepDepths(m_rows, m_extinction, l, job));
    constexpr float kEach = 1.0f / kSkyDirections;
    const auto each = static_cast<float>(1.0 / (kSkyDirections * l.z));
    base::parallelFor(job, m_shapes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const float seen = each * transmittanceOf(depths.voxels[i]);
        const Facing sides = facing(m_shapes[i].normal, m_shapes[i].share, toward);
        m_front[i] += seen * sides.front;
        m_back[i] += seen * sides.back;
      }
    });
    for (std::size_t i = 0; i < m_ground.size(); ++i) m_ground[i] += kEach * transmittanceOf(depths.ground[i]);
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
  const TexelRows& m_rows;
  std::vector<LeafShape> m_shapes;
  std::vector<float> m_extinction, m_front, m_back, m_ground;
};

/// Radiance of leaves that the light reaches with a transmittance of `through`.
LitVoxel litVoxel(const Voxel& voxel, float skyFront, float skyBack, const TexelLight& light, float through) {
  const Facing sides = facing(voxel.normal, static_cast<float>(normalShare(voxel)), glm::vec3(light.toSun));
  const glm::vec3 sun = glm::vec3(light.sunIrradiance / std::numbers::pi) * through;
  // Irradiance over pi of either side; skyRadiance times the share of the sky that a side sees.
  const glm::vec3 front = sun * sides.front + glm::vec3(light.skyRadiance) * skyFront;
  const glm::vec3 back = sun * sides.back + glm::vec3(light.skyRadiance) * skyBack;
  return {voxel.diffuse * front + voxel.transmitted * back, voxel.diffuse * back + voxel.transmitted * front, through};
}

/// Toward the sun; a sun at or under the horizon leaves everything dark.
Result<SweptDepths> sunDepths(const Texel& texel, const TexelRows& rows, const glm::dvec3& l, const JobContext& job) {
  std::vector<float> extinctions(texel.size());
  base::parallelFor(job, extinctions.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const glm::vec3 toward(l);
    for (std::size_t i = begin; i < end; ++i) {
      extinctions[i] = LeafSection(texel.voxels()[rows.order()[i]])(toward);
    }
  });
  return sweepDepths(rows, extinctions, l, job);
}

}  // namespace

Result<TexelSky> sweptSky(const Texel& texel, const JobContext& job) {
  SWARD_ASSIGN(const TexelRows rows, TexelRows::create(texel, job));
  SkySweep sweep(texel, rows);
  sweep.prepare(texel, job);
  for (const glm::dvec3& l : skyDirections()) SWARD_TRY(sweep.add(l, job));
  TexelSky sky = sweep.sky(job);
  if (job.cancelled()) return Error::cancelled();
  return sky;
}

Result<LitTexel> lightTexel(const Texel& texel, const TexelSky& sky, const TexelLight& light, const JobContext& job) {
  if (sky.front.size() != texel.size() || sky.back.size() != texel.size()) {
    return Error::failed("the sky of " + std::to_string(sky.front.size()) + " voxels is not that of a texel of " +
                             std::to_string(texel.size()),
                         "texel");
  }
  LitTexel lit;
  lit.voxels.resize(texel.size());
  const auto columns = static_cast<std::size_t>(texel.grid().columns);
  lit.groundSun.assign(columns * columns, 0.0f);
  const auto shade = [&](std::size_t i, float through) {
    lit.voxels[i] = litVoxel(texel.voxels()[i], sky.front[i], sky.back[i], light, through);
  };
  if (light.toSun.z > 0.0) {
    SWARD_ASSIGN(const TexelRows rows, TexelRows::create(texel, job));
    SWARD_ASSIGN(const SweptDepths depths, sunDepths(texel, rows, light.toSun, job));
    base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) shade(rows.order()[i], transmittanceOf(depths.voxels[i]));
    });
    std::transform(depths.ground.begin(), depths.ground.end(), lit.groundSun.begin(), transmittanceOf);
  } else {
    base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) shade(i, 0.0f);
    });
  }
  if (job.cancelled()) return Error::cancelled();
  return lit;
}

}  // namespace sward::wither
