#include "trace/layers.h"

#include "trace/test_patches.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sward::trace {
namespace {

using testing::addQuad;
using testing::coverageAt;
using testing::hitsOf;
using testing::lightOn;
using testing::patchOf;
using testing::quad;
using testing::sceneOf;
using testing::smallOptions;

glm::dvec3 sun(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation)};
}

/// The whole square covered by one quad at height z of a patch of height 1.
std::shared_ptr<scene::Patch> plate(float z, float side = 1.0f, float height = 1.0f) {
  return patchOf(quad({0.0f, 0.0f, z}, {side, 0.0f, 0.0f}, {0.0f, side, 0.0f}), static_cast<double>(side),
                 static_cast<double>(height));
}

TEST(OctahedralNormal, RoundTripsOverTheSphere) {
  for (int i = 0; i < 2000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 2000.0, phi = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    const glm::vec3 n(r * std::cos(phi), r * std::sin(phi), z);
    // One step of 1/32767 in each coordinate, stretched at most sqrt(6) by the octahedron's projection.
    EXPECT_LT(glm::length(decodeNormal(encodeNormal(n)) - n), 2.5f / 32767.0f);
  }
  EXPECT_EQ(decodeNormal(encodeNormal({0.0f, 0.0f, -1.0f})), glm::vec3(0.0f, 0.0f, -1.0f));
  EXPECT_EQ(decodeNormal(encodeNormal({NAN, 0.0f, 1.0f})), glm::vec3(0.0f, 0.0f, 1.0f));
}

TEST(SampleHits, PutsAPlateInItsSlabAlone) {
  // Height 1, four slabs: z = 0.6 lies in [0.5, 0.75], layer 1.
  const auto scene = sceneOf(plate(0.6f));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  ASSERT_EQ(hits.texels(), 256u);
  for (std::size_t t = 0; t < hits.texels(); ++t) {
    EXPECT_EQ(hits.layer[t], 1);
    EXPECT_FLOAT_EQ(hits.coverage(t), 1.0f);
  }
  for (const Hit& hit : hits.hits) {
    EXPECT_NEAR(hit.position.z, 0.6f, 1e-6f);
    EXPECT_EQ(decodeNormal(hit.normal), glm::vec3(0.0f, 0.0f, 1.0f));
  }
}

TEST(SampleHits, GivesAPlateOnTheBorderOfTwoSlabsToOneOfThem) {
  for (const float z : {0.25f, 0.5f, 0.75f}) {
    const auto scene = sceneOf(plate(z));
    EXPECT_EQ(hitsOf(*scene, LayerSet::Slices, smallOptions()).texels(), 256u) << z;
  }
}

TEST(SampleHits, SeesPlatesAtTheTopAndOnTheGround) {
  for (const float z : {0.0f, 1.0f}) {
    const auto scene = sceneOf(plate(z));
    const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
    ASSERT_EQ(hits.texels(), 256u) << z;
    EXPECT_EQ(hits.layer[0], z == 0.0f ? 3 : 0);
  }
}

TEST(SampleHits, PlacesColumnsAndRowsAlongTheAxes) {
  // A quad over the texels x in [8, 12), y in [2, 4) of 16.
  const auto scene = sceneOf(patchOf(quad({0.5f, 0.125f, 0.9f}, {0.25f, 0.0f, 0.0f}, {0.0f, 0.125f, 0.0f}), 1.0, 1.0));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const bool inside = x >= 8 && x < 12 && y >= 2 && y < 4;
      EXPECT_FLOAT_EQ(coverageAt(hits, x, y, 0), inside ? 1.0f : 0.0f) << x << ' ' << y;
    }
  }
}

TEST(SampleHits, CoversHalfATexelByHalfItsStrata) {
  // The quad's edge at x = 0.5 + 1/32 halves texel column 8: two of the four strata lie inside, whatever the jitter.
  const auto scene = sceneOf(patchOf(quad({0.0f, 0.0f, 0.9f}, {0.53125f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}), 1.0, 1.0));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  for (int y = 0; y < 16; ++y) {
    EXPECT_FLOAT_EQ(coverageAt(hits, 7, y, 0), 1.0f);
    EXPECT_FLOAT_EQ(coverageAt(hits, 8, y, 0), 0.5f);
    EXPECT_FLOAT_EQ(coverageAt(hits, 9, y, 0), 0.0f);
  }
}

TEST(SampleHits, MeetsTheAreaOfASlantedTriangle) {
  SamplingOptions options = smallOptions();
  options.sliceResolution = 64;
  mesh::Model model = quad({0.1f, 0.1f, 0.9f}, {0.7f, 0.2f, 0.0f}, {0.1f, 0.6f, 0.0f});
  model.triangles.resize(1);
  model.triangleMaterial.resize(1);
  const auto scene = sceneOf(patchOf(std::move(model), 1.0, 1.0));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, options);
  const double area = 0.5 * (0.7 * 0.6 - 0.2 * 0.1);
  const double measured = static_cast<double>(hits.hits.size()) / (64.0 * 64.0 * 4.0);
  // Only the texels on the outline, some 120, are uncertain, each by at most a stratum's deviation.
  EXPECT_NEAR(measured, area, 4.0 * std::sqrt(120.0 * 0.05) / 4096.0);
}

TEST(SampleHits, BladesSeeOppositeFacesOfAWallInOppositeOrder) {
  // A wall x = 0.3 over all y and z; four slabs of 0.25: from +x it is in layer 2, from -x in layer 1.
  const auto scene = sceneOf(patchOf(quad({0.3f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}), 1.0, 1.0));
  const SamplingOptions options = smallOptions();
  const LayerHits front = hitsOf(*scene, LayerSet::BladesPosX, options);
  const LayerHits back = hitsOf(*scene, LayerSet::BladesNegX, options);
  ASSERT_EQ(front.texels(), 16u * 8u);
  ASSERT_EQ(back.texels(), 16u * 8u);
  for (std::size_t t = 0; t < front.texels(); ++t) {
    EXPECT_EQ(front.layer[t], 2);
    EXPECT_EQ(back.layer[t], 1);
  }
  for (const Hit& hit : front.hits) EXPECT_GT(decodeNormal(hit.normal).x, 0.999f);
  for (const Hit& hit : back.hits) EXPECT_LT(decodeNormal(hit.normal).x, -0.999f);
  // Edge on from the other axis.
  EXPECT_EQ(hitsOf(*scene, LayerSet::BladesPosY, options).texels(), 0u);
}

TEST(SampleHits, BladesSeeAPlaneOnThePeriodicBorderOnce) {
  for (const float x : {0.0f, 1.0f}) {
    const auto scene = sceneOf(patchOf(quad({x, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}), 1.0, 1.0));
    for (const LayerSet set : {LayerSet::BladesPosX, LayerSet::BladesNegX}) {
      EXPECT_EQ(hitsOf(*scene, set, smallOptions()).texels(), 16u * 8u) << x;
    }
  }
}

TEST(SampleHits, BladeRowsRunUpAndColumnsAlongTheOtherAxis) {
  // y in [0.75, 1), z in [0, 0.25): columns 12 to 15 and rows 0 and 1 of a blade seen along x.
  const auto scene = sceneOf(patchOf(quad({0.1f, 0.75f, 0.0f}, {0.0f, 0.25f, 0.0f}, {0.0f, 0.0f, 0.25f}), 1.0, 1.0));
  for (const LayerSet set : {LayerSet::BladesPosX, LayerSet::BladesNegX}) {
    const LayerHits hits = hitsOf(*scene, set, smallOptions());
    const int layer = set == LayerSet::BladesPosX ? 3 : 0;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 16; ++x) {
        EXPECT_FLOAT_EQ(coverageAt(hits, x, y, layer), x >= 12 && y < 2 ? 1.0f : 0.0f) << x << ' ' << y;
      }
    }
  }
}

TEST(SampleHits, NearestOfTwoPlatesInASlabHidesTheOther) {
  mesh::Model model = quad({0.0f, 0.0f, 0.55f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addQuad(model, {0.0f, 0.0f, 0.7f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addQuad(model, {0.0f, 0.0f, 0.3f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  const auto scene = sceneOf(patchOf(std::move(model), 1.0, 1.0));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  ASSERT_EQ(hits.texels(), 512u);
  for (std::size_t t = 0; t < hits.texels(); ++t) {
    const float z = hits.hits[hits.hitStart[t]].position.z;
    EXPECT_NEAR(z, hits.layer[t] == 1 ? 0.7f : 0.3f, 1e-6f);
  }
}

TEST(SampleHits, FindsNothingInAnEmptyPatch) {
  auto patch = std::make_shared<scene::Patch>();
  const auto scene = sceneOf(patch);
  for (const LayerSet set : kAllLayerSets) {
    const LayerHits hits = hitsOf(*scene, set, smallOptions());
    const bool ground = set == LayerSet::Ground;
    EXPECT_EQ(hits.texels(), ground ? 256u : 0u);
    EXPECT_EQ(hits.columnStart.size(), static_cast<std::size_t>(hits.shape.columns()) + 1);
    const LayerLuminance light = lightOn(*scene, hits, {0.3, 0.1, 1.0});
    EXPECT_EQ(light.reflected.size(), hits.texels());
    const auto visibility = sampleVisibility(*scene, hits, smallOptions(), {});
    ASSERT_TRUE(visibility.ok());
    for (const float sky : visibility->skyReflected) EXPECT_NEAR(sky, 1.0f, 1e-6f);
  }
}

TEST(SampleHits, RefusesSamplingsThatCannotBe) {
  const auto scene = sceneOf(plate(0.5f));
  SamplingOptions none = smallOptions(), huge = smallOptions(), layers = smallOptions();
  none.slices = 0;
  huge.sliceResolution = 1'000'000;
  layers.slices = 257;
  for (const SamplingOptions& options : {none, huge, layers}) {
    const auto hits = sampleHits(*scene, LayerSet::Slices, options, {});
    ASSERT_FALSE(hits.ok());
    EXPECT_EQ(hits.error().kind, ErrorKind::BadInput);
    EXPECT_FALSE(hits.error().remedy.empty());
  }
}

TEST(SampleLuminance, APlateAnswersByLambertAtAnyAngle) {
  const auto scene = sceneOf(plate(0.6f));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  for (const double elevation : {1.57, 1.2, 0.7, 0.3, 0.05, 0.01}) {
    for (const double azimuth : {0.0, 0.4, 2.0, 4.0}) {
      const glm::dvec3 light = sun(azimuth, elevation);
      const LayerLuminance luminance = lightOn(*scene, hits, light);
      for (std::size_t t = 0; t < hits.texels(); ++t) {
        EXPECT_NEAR(luminance.reflected[t], light.z, 1e-4) << elevation;
        EXPECT_EQ(luminance.transmitted[t], 0.0f);
      }
    }
  }
}

TEST(SampleLuminance, AWallReflectsOnTheLitSideAndTransmitsOnTheOther) {
  const auto scene = sceneOf(patchOf(quad({0.3f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.05f}), 1.0, 0.05));
  const glm::dvec3 light = sun(0.2, 0.9);  // from +x; at this height no neighbour's wall stands in the way
  const LayerHits front = hitsOf(*scene, LayerSet::BladesPosX, smallOptions());
  const LayerHits back = hitsOf(*scene, LayerSet::BladesNegX, smallOptions());
  const LayerLuminance lit = lightOn(*scene, front, light), through = lightOn(*scene, back, light);
  for (std::size_t t = 0; t < front.texels(); ++t) {
    EXPECT_NEAR(lit.reflected[t], light.x, 1e-4);
    EXPECT_EQ(lit.transmitted[t], 0.0f);
    EXPECT_EQ(through.reflected[t], 0.0f);
    EXPECT_NEAR(through.transmitted[t], light.x, 1e-4);
  }
}

TEST(SampleVisibility, AnOpenPlateSeesTheWholeSky) {
  const auto scene = sceneOf(plate(0.6f));
  SamplingOptions options = smallOptions();
  for (const int directions : {1, 2, 7, 16}) {
    options.visibilityDirections = directions;
    const LayerHits hits = hitsOf(*scene, LayerSet::Slices, options);
    const auto visibility = sampleVisibility(*scene, hits, options, {});
    ASSERT_TRUE(visibility.ok());
    for (std::size_t t = 0; t < hits.texels(); ++t) {
      EXPECT_FLOAT_EQ(visibility->visibility[t], 1.0f);
      EXPECT_NEAR(visibility->skyReflected[t], 1.0f, 1e-5f);
      EXPECT_EQ(visibility->skyTransmitted[t], 0.0f);
    }
  }
}

TEST(SampleVisibility, APlateBelowAnotherSeesNothing) {
  mesh::Model model = quad({0.0f, 0.0f, 0.9f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addQuad(model, {0.0f, 0.0f, 0.2f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  const auto scene = sceneOf(patchOf(std::move(model), 1.0, 1.0));
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  const auto visibility = sampleVisibility(*scene, hits, smallOptions(), {});
  ASSERT_TRUE(visibility.ok());
  for (std::size_t t = 0; t < hits.texels(); ++t) {
    EXPECT_FLOAT_EQ(visibility->visibility[t], hits.layer[t] == 0 ? 1.0f : 0.0f);
    EXPECT_NEAR(visibility->skyReflected[t], hits.layer[t] == 0 ? 1.0f : 0.0f, 1e-5f);
  }
}

TEST(SampleVisibility, AVerticalWallSharesTheSkyBetweenItsSides) {
  // A low wall in a wide patch: (1/pi) times the integral of a vertical plane's cosine over the upper hemisphere is
  // 1/2 on each side.
  const auto scene = sceneOf(patchOf(quad({0.5f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1e-3f}), 1.0, 1e-3));
  SamplingOptions options = smallOptions();
  options.visibilityDirections = 256;
  const LayerHits hits = hitsOf(*scene, LayerSet::BladesPosX, options);
  const auto visibility = sampleVisibility(*scene, hits, options, {});
  ASSERT_TRUE(visibility.ok());
  ASSERT_GT(hits.texels(), 0u);
  for (std::size_t t = 0; t < hits.texels(); ++t) {
    // Directions below the neighbour's crest, 1e-3 of the hemisphere, may be hidden; the lattice of 256 errs by 1/256.
    EXPECT_NEAR(visibility->skyReflected[t], 0.5f, 0.01f);
    EXPECT_NEAR(visibility->skyTransmitted[t], 0.5f, 0.01f);
    EXPECT_NEAR(visibility->visibility[t], 1.0f, 0.01f);
  }
}

TEST(ShadeSurface, MeansTheMaterialsOfTheHits) {
  const auto patch = plate(0.6f);
  const auto scene = sceneOf(patch);
  const LayerHits hits = hitsOf(*scene, LayerSet::Slices, smallOptions());
  const auto surface = shadeSurface(hits, *patch, {}, {});
  ASSERT_TRUE(surface.ok());
  const mesh::SurfaceSample expected = mesh::surfaceAt(*patch->models[0], 0, 0.3f, 0.3f);
  for (std::size_t t = 0; t < hits.texels(); ++t) {
    EXPECT_LT(glm::length(surface->reflectance[t] - expected.reflectance), 1e-5f);
    EXPECT_LT(glm::length(surface->transmittance[t] - expected.transmittance), 1e-5f);
  }
  const LayerHits ground = hitsOf(*scene, LayerSet::Ground, smallOptions());
  const std::vector<glm::vec3> soil(ground.texels(), glm::vec3(0.1f, 0.07f, 0.05f));
  const auto earth = shadeSurface(ground, *patch, soil, {});
  ASSERT_TRUE(earth.ok());
  EXPECT_EQ(earth->reflectance[17], soil[17]);
  EXPECT_EQ(earth->transmittance[17], glm::vec3(0.0f));
}

}  // namespace
}  // namespace sward::trace
