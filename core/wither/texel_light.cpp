#include "wither/texel_light.h"

#include "base/parallel.h"
#include "wither/extinction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sward::wither {
namespace {

/// A depth of 8 leaves 3e-4 of the light: under half a step of the ten bits that a renderer keeps of its root.
constexpr double kEnoughDepth = 8.0;
constexpr std::size_t kGrain = 512;
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

glm::dvec3 centreOf(const TexelGrid& grid, const glm::u16vec3& place) {
  return (glm::dvec3(place) + 0.5) * grid.voxelM();
}

/// How far a leaf's own voxel reaches along a direction: the march starts where it ends.
double leadOf(const TexelGrid& grid, const glm::dvec3& l) {
  const glm::dvec3 cells = glm::abs(l) / grid.voxelM();
  return 1.0 / std::max(cells.x, std::max(cells.y, cells.z));
}

double transmitted(const Texel& texel, const TexelExtinction& medium, const glm::dvec3& from, const glm::dvec3& l,
                   double leadM) {
  return std::exp(-opticalDepth(texel, medium, from + leadM * l, l, kEnoughDepth));
}

/// A texel and, for what is far, a coarse level of it, toward one light.
class SunMarch {
 public:
  static Result<SunMarch> create(const Texel& texel, const Texel* coarse, const glm::dvec3& l, const JobContext& job) {
    SunMarch march(texel, coarse, l);
    SWARD_ASSIGN(march.m_fine, TexelExtinction::create(texel, l, job));
    if (coarse != nullptr) {
      SWARD_ASSIGN(march.m_far, TexelExtinction::create(*coarse, l, job));
    }
    return march;
  }
  double transmitted(const glm::dvec3& from, double leadM) const {
    const glm::dvec3 start = from + leadM * m_l;
    if (m_coarse == nullptr) return std::exp(-opticalDepth(*m_texel, m_fine, start, m_l, kEnoughDepth));
    const double near = opticalDepth(*m_texel, m_fine, start, m_l, kEnoughDepth, m_nearM);
    const glm::dvec3 beyond = start + m_nearM * m_l;
    if (near >= kEnoughDepth || beyond.z >= m_texel->grid().heightM) return std::exp(-near);
    return std::exp(-near - opticalDepth(*m_coarse, m_far, beyond, m_l, kEnoughDepth - near));
  }

 private:
  SunMarch(const Texel& texel, const Texel* coarse, const glm::dvec3& l)
      : m_texel(&texel), m_coarse(coarse), m_l(l), m_nearM(kNearVoxels * texel.grid().voxelM().x) {}
  const Texel *m_texel, *m_coarse;
  glm::dvec3 m_l;
  double m_nearM;
  TexelExtinction m_fine, m_far;
};

/// A voxel's part of leaves that have its normal, and the irradiance that a unit beam from l gives its two sides.
struct Facing {
  double front = 0.0, back = 0.0;
};
Facing facing(const glm::vec3& normal, double share, const glm::dvec3& l) {
  const double cosine = glm::dot(glm::dvec3(normal), l);
  const double any = 0.25 * (1.0 - share);  // leaves of every direction: half of |n.l| = 1/2 on either side
  return {share * std::max(cosine, 0.0) + any, share * std::max(-cosine, 0.0) + any};
}

/// What the voxels of a level see of one part of the sky after another.
Result<void> marchSky(const Texel& texel, const TexelExtinction& medium, const glm::dvec3& l, const JobContext& job,
                      TexelSky& sky) {
  const TexelGrid& grid = texel.grid();
  const double lead = leadOf(grid, l);
  const std::span<const Voxel> voxels = texel.voxels();
  const std::span<const glm::u16vec3> places = texel.places();
  const double each = 1.0 / kSkyDirections;
  base::parallelFor(job, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double seen = transmitted(texel, medium, centreOf(grid, places[i]), l, lead) * each / l.z;
      const Facing sides = facing(voxels[i].normal, normalShare(voxels[i]), l);
      sky.front[i] += static_cast<float>(seen * sides.front);
      sky.back[i] += static_cast<float>(seen * sides.back);
    }
  });
  const auto columns = static_cast<std::size_t>(grid.columns);
  base::parallelFor(job, columns, 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t x = 0; x < columns; ++x) {
        const glm::dvec3 foot((static_cast<double>(x) + 0.5) * grid.voxelM().x,
                              (static_cast<double>(y) + 0.5) * grid.voxelM().y, 0.0);
        sky.ground[y * columns + x] += static_cast<float>(transmitted(texel, medium, foot, l, 0.0) * each);
      }
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return {};
}

}  // namespace

Result<TexelSky> marchedSky(const Texel& texel, const JobContext& job) {
  TexelSky sky;
  sky.front.assign(texel.size(), 0.0f);
  sky.back.assign(texel.size(), 0.0f);
  sky.ground.assign(static_cast<std::size_t>(texel.grid().columns) * static_cast<std::size_t>(texel.grid().columns),
                    0.0f);
  for (const glm::dvec3& l : skyDirections()) {
    SWARD_ASSIGN(const TexelExtinction medium, TexelExtinction::create(texel, l, job));
    SWARD_TRY(marchSky(texel, medium, l, job, sky));
  }
  return sky;
}

Result<TexelSky> finerSky(const Texel& texel, const Texel& coarse, const TexelSky& coarseSky, const JobContext& job) {
  const TexelGrid &fine = texel.grid(), &grid = coarse.grid();
  const int ratio = fine.columns / grid.columns;
  if (ratio < 1 || grid.columns * ratio != fine.columns || grid.layers * ratio != fine.layers) {
    return Error::failed("the levels of a texel do not halve one another", "texel");
  }
  TexelSky sky;
  sky.front.assign(texel.size(), 0.0f);
  sky.back.assign(texel.size(), 0.0f);
  const auto columns = static_cast<std::size_t>(fine.columns);
  sky.ground.assign(columns * columns, 0.0f);
  const std::span<const Voxel> voxels = texel.voxels();
  const std::span<const glm::u16vec3> places = texel.places();
  base::parallelFor(job, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::int64_t under = coarse.find(glm::ivec3(places[i]) / ratio);
      if (under < 0) continue;
      const auto c = static_cast<std::size_t>(under);
      // The two sides of the coarse voxel see so much of the sky together; the fine leaf turns its own way in it.
      const double open = double{coarseSky.front[c]} + double{coarseSky.back[c]};
      const double up = 0.5 * (1.0 + double{voxels[i].normal.z});
      sky.front[i] = static_cast<float>(open * up);
      sky.back[i] = static_cast<float>(open * (1.0 - up));
    }
  });
  for (std::size_t y = 0; y < columns; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const auto r = static_cast<std::size_t>(ratio);
      sky.ground[y * columns + x] = coarseSky.ground[y / r * static_cast<std::size_t>(grid.columns) + x / r];
    }
  }
  if (job.cancelled()) return Error::cancelled();
  return sky;
}

Result<LitTexel> lightTexel(const Texel& texel, const Texel* coarse, const TexelSky& sky, const TexelLight& light,
                            const JobContext& job) {
  const TexelGrid& grid = texel.grid();
  const std::span<const Voxel> voxels = texel.voxels();
  const std::span<const glm::u16vec3> places = texel.places();
  LitTexel lit;
  lit.voxels.resize(texel.size());
  const auto columns = static_cast<std::size_t>(grid.columns);
  lit.groundSun.assign(columns * columns, 0.0f);
  const bool sunUp = light.toSun.z > 0.0;
  const double lead = leadOf(grid, light.toSun);
  SWARD_ASSIGN(const SunMarch march, SunMarch::create(texel, coarse, light.toSun, job));
  base::parallelFor(job, voxels.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Voxel& voxel = voxels[i];
      const double through = sunUp ? march.transmitted(centreOf(grid, places[i]), lead) : 0.0;
      const Facing sides = facing(voxel.normal, normalShare(voxel), light.toSun);
      const glm::dvec3 sun = light.sunIrradiance * (through / std::numbers::pi);
      // Irradiance over pi of either side; skyRadiance times the share of the sky that a side sees.
      const glm::dvec3 front = sun * sides.front + light.skyRadiance * double{sky.front[i]};
      const glm::dvec3 back = sun * sides.back + light.skyRadiance * double{sky.back[i]};
      const glm::dvec3 reflected(voxel.diffuse), passed(voxel.transmitted);
      lit.voxels[i] = {glm::vec3(reflected * front + passed * back), glm::vec3(reflected * back + passed * front),
                       static_cast<float>(through)};
    }
  });
  if (sunUp) {
    base::parallelFor(job, columns, 8, [&](std::size_t begin, std::size_t end) {
      for (std::size_t y = begin; y < end; ++y) {
        for (std::size_t x = 0; x < columns; ++x) {
          const glm::dvec3 foot((static_cast<double>(x) + 0.5) * grid.voxelM().x,
                                (static_cast<double>(y) + 0.5) * grid.voxelM().y, 0.0);
          lit.groundSun[y * columns + x] = static_cast<float>(march.transmitted(foot, 0.0));
        }
      }
    });
  }
  if (job.cancelled()) return Error::cancelled();
  return lit;
}

}  // namespace sward::wither
