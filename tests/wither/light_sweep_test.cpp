#include "wither/light_sweep.h"

#include "base/random.h"
#include "wither/extinction.h"
#include "wither/test_texels.h"
#include "wither/texel_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sward::wither {
namespace {

glm::dvec3 sunAt(double elevationDeg, double azimuthDeg) {
  const double e = elevationDeg * std::numbers::pi / 180.0, a = azimuthDeg * std::numbers::pi / 180.0;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

/// Leaves turned every way: the same extinction from every direction, half the density.
Voxel ball(float density) {
  Voxel voxel;
  voxel.density = density;
  voxel.diffuse = glm::vec3(0.3f);
  voxel.spread = {density / 3.0f, 0.0f, 0.0f, density / 3.0f, 0.0f, density / 3.0f};
  return voxel;
}

Texel randomTexel(const TexelGrid& grid, double share, std::uint64_t seed) {
  base::Random random(seed);
  std::vector<Texel::Entry> entries;
  for (int z = 0; z < grid.layers; ++z)
    for (int y = 0; y < grid.columns; ++y)
      for (int x = 0; x < grid.columns; ++x) {
        if (random.uniform() > share) continue;
        Voxel voxel = leafVoxel(random.uniform(1.0, 40.0));
        const double turn = random.uniform(0.0, 6.28);
        voxel.normal = {std::cos(turn), std::sin(turn), 0.0};
        const glm::vec3 n = voxel.normal;
        voxel.spread = {voxel.density * n.x * n.x, voxel.density * n.x * n.y, 0, voxel.density * n.y * n.y, 0, 0};
        entries.push_back({{x, y, z}, voxel});
      }
  return Texel::fromEntries(grid, std::move(entries)).value();
}

/// The ray that the sweep says a voxel reads: one voxel out of its middle, moved to the nearest of those that rise from
/// the middles of the columns' feet.
double marchedAsRead(const Texel& texel, const glm::dvec3& l, const glm::ivec3& at, bool moved) {
  const glm::dvec3 size = texel.grid().voxelM(), perM = l / size;
  const double out = 1.0 / std::max({std::abs(perM.x), std::abs(perM.y), std::abs(perM.z)});
  glm::dvec3 from = (glm::dvec3(at) + 0.5) * size + out * l;
  for (int c = 0; c < 2 && moved; ++c) {
    const double foot = -perM[c] / perM.z * (at.z + 0.5);  // of its own ray, in columns from the middle of its own
    from[c] += (std::round(foot) - foot) * size[c];
  }
  return opticalDepth(texel, from, l);
}

struct Difference {
  double rms = 0.0, mean = 0.0, most = 0.0;
};
/// Of transmittances, the sweep's from marched ones.
Difference differenceOf(const Texel& texel, const glm::dvec3& l, bool moved, std::size_t every = 1) {
  const SunReach reach = sunReach(texel, l, {}).value();
  Difference d;
  std::size_t count = 0;
  for (std::size_t i = 0; i < texel.size(); i += every, ++count) {
    const double miss =
        double{reach.voxels[i]} - std::exp(-marchedAsRead(texel, l, glm::ivec3(texel.places()[i]), moved));
    d.rms += miss * miss;
    d.mean += miss;
    d.most = std::max(d.most, std::abs(miss));
  }
  d.rms = std::sqrt(d.rms / static_cast<double>(count));
  d.mean /= static_cast<double>(count);
  return d;
}

const double kElevations[] = {90.0, 89.0, 60.0, 45.0, 32.0, 20.0, 10.0, 4.0, 2.0};

/// Sums of some hundred products in single precision: 2e-7 of depths up to 40, times exp(-depth), is under 1e-6. Where
/// a ray runs along the corner of a voxel, rounding says which side it takes; such a ray is rare and misses more.
TEST(LightSweep, ReadsExactDepthsOfTheRaysItSays) {
  for (const auto& [columns, layers, height] : {std::tuple(24, 16, 0.5), std::tuple(16, 40, 1.7)}) {
    const Texel texel = randomTexel({columns, layers, 1.0, height}, 0.08, 5);
    for (const double elevation : kElevations) {
      for (const double azimuth : {0.0, 17.0, 90.0, 133.0, 180.0, 263.7}) {
        SCOPED_TRACE(testing::Message() << elevation << ", " << azimuth);
        // Along an axis at 45 degrees every ray runs along edges of voxels.
        if (elevation == 45.0 && std::fmod(azimuth, 90.0) == 0.0) continue;
        // Upright leaves turn their edge to a high sun, where extinctions in single precision miss by 1e-3 of
        // densities.
        EXPECT_LT(differenceOf(texel, sunAt(elevation, azimuth), true).most, elevation > 80.0 ? 2e-3 : 1e-5);
      }
    }
  }
}

TEST(LightSweep, TheGroundIsExactUnderTheMiddleOfEveryColumn) {
  const Texel texel = randomTexel({24, 16, 1.0, 0.5}, 0.08, 5);
  const double step = texel.grid().voxelM().x;
  for (const double elevation : kElevations) {
    const glm::dvec3 l = sunAt(elevation, 71.0);
    const SunReach reach = sunReach(texel, l, {}).value();
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) {
        const double marched = opticalDepth(texel, {(x + 0.5) * step, (y + 0.5) * step, 0.0}, l);
        EXPECT_NEAR(reach.ground[static_cast<std::size_t>(y * 24 + x)], std::exp(-marched),
                    elevation > 80.0 ? 2e-3 : 1e-5);
      }
  }
}

/// Reading the nearest ray moves the place that is lit by up to half a voxel, in x and in y: as much as the light
/// changes within a voxel. On a meadow of 4.3 million voxels that was 0.034 (sun at 60 degrees), 0.025 (32), 0.017 (10)
/// and 0.008 (2) in the root mean square, and a random place within the voxel was off by as much; in the mean it was
/// under 6e-4. These few blades are harder, since they stand alone and upright.
TEST(LightSweep, MissesTheMarchFromMiddlesByWhatChangesWithinAVoxel) {
  const Blades blades = uprightBlades(150, 64, 0.5);
  const Points points = texelToPoints(blades.texel, blades.attachments, blades.strands, 6.0, 1, {}).value();
  const Texel texel = pointsToTexel(points, blades.texel.grid(), 0.6, {}).value();
  for (const double elevation : {60.0, 32.0, 10.0, 2.0}) {
    SCOPED_TRACE(elevation);
    const Difference d = differenceOf(texel, sunAt(elevation, 215.0), false);
    EXPECT_LT(d.rms, 0.06);
    EXPECT_LT(std::abs(d.mean), 0.01);
  }
  EXPECT_LT(differenceOf(texel, {0.0, 0.0, 1.0}, false).most, 1e-3);
}

TEST(LightSweep, AFullSlabFollowsBeersLaw) {
  std::vector<Texel::Entry> entries;
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) entries.push_back({{x, y, z}, ball(3.0f)});
  const Texel texel = Texel::fromEntries({16, 16, 1.0, 1.0}, std::move(entries)).value();
  for (const double elevation : {90.0, 50.0, 20.0, 5.0}) {
    const glm::dvec3 l = sunAt(elevation, 40.0);
    const double sigma = extinction(texel.voxels()[0], l);
    EXPECT_NEAR(sigma, 1.5, 1e-6);
    const SunReach reach = sunReach(texel, l, {}).value();
    for (const float ground : reach.ground) EXPECT_NEAR(ground, std::exp(-sigma * 0.5 / l.z), 1e-6);
    // From one voxel out: (8 - z - 0.5) layers of 1/16 m, less the step out.
    const double out = std::min(1.0, l.z / std::max(std::abs(l.x), std::abs(l.y)));
    for (std::size_t i = 0; i < texel.size(); ++i) {
      const double layersAbove = std::max(7.5 - texel.places()[i].z - out, 0.0);
      EXPECT_NEAR(reach.voxels[i], std::exp(-sigma * layersAbove / 16.0 / l.z), 1e-6);
    }
  }
}

TEST(LightSweep, AnOpaqueColumnsShadowLiesWhereItMust) {
  std::vector<Texel::Entry> entries;
  for (int z = 0; z < 8; ++z) entries.push_back({{20, 12, z}, ball(1e5f)});
  // 32 columns of 1/32 m, layers of the same height; the sun stands in the west (-x) under 45 degrees.
  const Texel texel = Texel::fromEntries({32, 16, 1.0, 0.5}, std::move(entries)).value();
  const SunReach reach = sunReach(texel, glm::normalize(glm::dvec3(-1.0, 0.0, 1.01)), {}).value();
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      // From the column itself as far east as its east face is seen from the middle of a foot: (x - 20.5) / h voxels
      // up.
      const bool shaded = y == 12 && x >= 20 && (x - 20.5) / 0.9901 < 8.0;
      EXPECT_NEAR(reach.ground[static_cast<std::size_t>(y * 32 + x)], shaded ? 0.0 : 1.0, 1e-6) << x << ", " << y;
    }
  // Under a sun in the zenith only its own foot is dark; its top voxel is lit, those under it are not.
  const SunReach noon = sunReach(texel, {0.0, 0.0, 1.0}, {}).value();
  for (std::size_t i = 0; i < 1024; ++i) EXPECT_NEAR(noon.ground[i], i == 12 * 32 + 20 ? 0.0 : 1.0, 1e-6);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(noon.voxels[i], texel.places()[i].z == 7 ? 1.0 : 0.0, 1e-6);
}

/// The lit face of a wall one voxel thick stays lit from wherever it is seen: no voxel shades itself, nor do those
/// beside it in the wall.
TEST(LightSweep, AWallDoesNotShadeItsOwnLitFace) {
  std::vector<Texel::Entry> entries;
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 64; ++y) entries.push_back({{31, y, z}, ball(1e4f)});
  const Texel texel = Texel::fromEntries({64, 16, 1.0, 0.25}, std::move(entries)).value();
  for (const double elevation : {44.0, 30.0, 15.0}) {
    const SunReach reach = sunReach(texel, sunAt(elevation, 20.0), {}).value();
    for (const float sun : reach.voxels) EXPECT_EQ(sun, 1.0f);
  }
}

TEST(LightSweep, WhatIsMovedByWholeColumnsIsLitTheSame) {
  const Texel texel = randomTexel({24, 16, 1.0, 0.5}, 0.05, 9);
  std::vector<Texel::Entry> entries;
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::ivec3 at(texel.places()[i]);
    entries.push_back({{(at.x + 11) % 24, (at.y + 5) % 24, at.z}, texel.voxels()[i]});
  }
  const Texel moved = Texel::fromEntries(texel.grid(), std::move(entries)).value();
  const glm::dvec3 l = sunAt(12.0, 300.0);
  const SunReach a = sunReach(texel, l, {}).value(), b = sunReach(moved, l, {}).value();
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::ivec3 at(texel.places()[i]);
    const auto other = static_cast<std::size_t>(moved.find({(at.x + 11) % 24, (at.y + 5) % 24, at.z}));
    EXPECT_EQ(a.voxels[i], b.voxels[other]);
  }
}

TEST(LightSweep, NothingAndOneVoxel) {
  const TexelGrid grid{8, 8, 1.0, 1.0};
  const Texel empty = Texel::fromEntries(grid, {}).value();
  const Texel one = Texel::fromEntries(grid, {{{7, 0, 3}, ball(1e5f)}}).value();
  for (const double elevation : {90.0, 45.5, 2.0, 1e-3, 0.0, -30.0}) {
    const glm::dvec3 l = sunAt(elevation, 35.0);
    const SunReach none = sunReach(empty, l, {}).value(), single = sunReach(one, l, {}).value();
    EXPECT_TRUE(none.voxels.empty());
    for (const float ground : none.ground) EXPECT_EQ(ground, elevation > 0.0 ? 1.0f : 0.0f);
    ASSERT_EQ(single.voxels.size(), 1u);
    // Under low suns a block's own copies stand in the way; those of this one are met no sooner than 8 columns on.
    if (elevation > 40.0) {
      EXPECT_EQ(single.voxels[0], 1.0f);
    }
  }
  EXPECT_EQ(sunReach(one, {0.0, 0.0, 1.0}, {}).value().ground[7], transmittanceOf(1e9f));
}

/// Every layer shifts light by more voxels than are followed: it stays finite, ordered and dark under leaves.
TEST(LightSweep, SunsOnTheHorizonAreFollowedFromALittleHigher) {
  const Texel texel = randomTexel({16, 16, 1.0, 1.0}, 0.2, 3);
  const SunReach lower = sunReach(texel, sunAt(1e-7, 10.0), {}).value();
  const SunReach low = sunReach(texel, sunAt(0.5, 10.0), {}).value();
  for (std::size_t i = 0; i < texel.size(); ++i) {
    EXPECT_TRUE(lower.voxels[i] >= 0.0f && lower.voxels[i] <= 1.0f);
    if (texel.places()[i].z < 12) {
      EXPECT_LT(low.voxels[i], 0.2f);
      EXPECT_LT(lower.voxels[i], 0.2f);
    }
  }
}

TEST(LightSweep, RowsHoldEveryVoxelOnce) {
  const Texel texel = randomTexel({24, 16, 1.0, 1.0}, 0.1, 4);
  const TexelRows rows = TexelRows::create(texel, {}).value();
  std::vector<int> seen(texel.size(), 0);
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 24; ++y) {
      const TexelRows::Row row = rows.row(y, z);
      for (std::uint32_t i = row.begin; i < row.end; ++i) {
        const glm::ivec3 at(texel.places()[rows.order()[i]]);
        EXPECT_EQ(at, glm::ivec3(rows.x()[i], y, z));
        if (i > row.begin) {
          EXPECT_LT(rows.x()[i - 1], rows.x()[i]);
        }
        ++seen[rows.order()[i]];
      }
    }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

TEST(LightSweep, TransmittanceIsThatOfTheLibrary) {
  for (double depth = 0.0; depth < 79.0; depth += 0.0137) {
    EXPECT_NEAR(transmittanceOf(static_cast<float>(depth)) / std::exp(-double{static_cast<float>(depth)}), 1.0, 3e-7);
  }
  EXPECT_EQ(transmittanceOf(0.0f), 1.0f);
  EXPECT_LT(transmittanceOf(std::numeric_limits<float>::infinity()), 1e-34f);
  EXPECT_GT(transmittanceOf(std::numeric_limits<float>::max()), 0.0f);
}

/// Single precision: 1e-6 of the density, and the root of it where the form cancels.
TEST(LightSweep, ExtinctionsInSinglePrecisionAreThoseInDouble) {
  base::Random random(8);
  const Texel texel = randomTexel({16, 16, 1.0, 1.0}, 0.3, 6);
  for (const Voxel& voxel : texel.voxels()) {
    const glm::dvec3 l = sunAt(random.uniform(0.0, 90.0), random.uniform(0.0, 360.0));
    const auto form = sectionForm(voxel);
    const double x = l.x, y = l.y, z = l.z;
    const double square = x * x * form[0] + y * y * form[3] + z * z * form[5] +
                          2.0 * (x * y * form[1] + x * z * form[2] + y * z * form[4]);
    const double exact = extinction(voxel, l), density = double{voxel.density};
    EXPECT_NEAR(square, exact * exact, 1e-6 * density * density);
    EXPECT_NEAR(sectionToward(voxel, glm::vec3(l)), exact, 1e-3 * density);
  }
}

}  // namespace
}  // namespace sward::wither
