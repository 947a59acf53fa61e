// Light of the reference against closed forms.
#include "trace/reference_fixture.h"

#include "scene/ground_look.h"
#include "trace/sky_light.h"

#include <algorithm>

namespace sward::trace {
namespace {

using testing::cameraAt;
using testing::deviationOf;
using testing::kPi;
using testing::meanOf;
using testing::slabAt;
using testing::smallPicture;
using testing::Stage;
using testing::stageOf;
using testing::sunAt;

/// From above, straight down.
const scene::Camera& downward() {
  static const scene::Camera camera = cameraAt({0.3, 0.4, 4.0}, {0.3, 0.4, 0.0}, 0.3);
  return camera;
}
/// Five deviations: a right result fails once in two million.
constexpr double kSigmas = 5.0;

void expectEverywhere(const image::Image& picture, const glm::dvec3& expected) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c)
        ASSERT_FLOAT_EQ(picture.at(x, y, c), static_cast<float>(expected[c])) << x << ' ' << y;
    }
  }
}

TEST(ReferenceLight, ABarePlaneUnderASunIsExact) {
  for (const double elevation : {4.0, 35.0, 90.0}) {
    Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 8, {0.3f, 0.2f, 0.1f});
    stage.daylight = sunAt(200.0, elevation);
    ReferenceOptions options = smallPicture();
    options.exposure = 1.7;
    const double sine = std::sin(elevation * kPi / 180.0);
    expectEverywhere(stage.picture(downward(), options, 4),
                     1.7 * glm::dvec3(glm::vec3(0.3f, 0.2f, 0.1f)) * stage.daylight.sunIrradiance() * sine / kPi);
  }
}

TEST(ReferenceLight, ASunsDiscBringsWhatItsPointDoes) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 8, glm::vec3(0.3f));
  stage.daylight = sunAt(200.0, 30.0);
  ReferenceOptions options = smallPicture();
  options.sunRadiusDeg = 5.0;
  const auto reference = stage.reference(downward(), options);
  ASSERT_TRUE(reference->addSamples(64, {}).ok());
  const double expected = static_cast<double>(0.3f) * stage.daylight.sunIrradiance().y * 0.5 / kPi;
  const double deviation = deviationOf(reference->variance());
  EXPECT_NEAR(meanOf(reference->mean()), expected, kSigmas * deviation + 1e-6 * expected);
  EXPECT_LT(deviation, 1e-3 * expected);  // so that the line above says something
}

TEST(ReferenceLight, AShadowsEdgeFadesOverTheSunsDisc) {
  // A roof over half of each patch, seen from below it; the sun in the zenith.
  constexpr double kHeight = 0.1, kRadiusDeg = 10.0;
  Stage stage =
      stageOf(testing::patchOf(testing::quad({0.0f, 0.0f, 0.1f}, {0.5f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}), 1.0, kHeight),
              8, glm::vec3(0.5f));
  ReferenceOptions options = smallPicture(32, 8);
  options.sunRadiusDeg = kRadiusDeg;
  options.filter = PixelFilter::Box;
  // Eye 5 cm over the ground; the picture shows x from 0.48 to 0.52.
  const auto reference = stage.reference(cameraAt({0.5, 0.5, 0.05}, {0.5, 0.5, 0.0}, 0.4), options);
  ASSERT_TRUE(reference->addSamples(256, {}).ok());
  const image::Image mean = reference->mean(), variance = reference->variance();
  const double sine = std::sin(kRadiusDeg * kPi / 180.0);
  // The share of the disc, projected on the ground, that a point sees past the roof's edge, by a fine grid.
  const auto share = [&](double x) {
    constexpr int kGrid = 400;
    const double edge = (0.5 - x) / kHeight;
    int seen = 0, all = 0;
    for (int i = 0; i < kGrid; ++i) {
      for (int j = 0; j < kGrid; ++j) {
        const double px = ((i + 0.5) / kGrid * 2.0 - 1.0) * sine, py = ((j + 0.5) / kGrid * 2.0 - 1.0) * sine;
        if (px * px + py * py > sine * sine) continue;
        ++all;
        if (px > edge * std::sqrt(1.0 - px * px - py * py)) ++seen;
      }
    }
    return static_cast<double>(seen) / all;
  };
  const double full = 0.5 * stage.daylight.sunIrradiance().y / kPi;
  int partly = 0;
  for (int x = 0; x < 32; ++x) {
    double expected = 0.0, sum = 0.0, squares = 0.0;
    for (int s = 0; s < 4; ++s) expected += 0.25 * full * share(0.48 + 0.04 * (x + (s + 0.5) / 4.0) / 32.0);
    for (int y = 0; y < 8; ++y) {
      sum += static_cast<double>(mean.at(x, y, 1)) / 8.0;
      squares += static_cast<double>(variance.at(x, y, 1)) / 64.0;
    }
    // Four points in a pixel and a grid of 400: within 0.2 % of full.
    EXPECT_NEAR(sum, expected, kSigmas * std::sqrt(squares) + 0.002 * full) << x;
    if (expected > 0.1 * full && expected < 0.9 * full) ++partly;
  }
  EXPECT_GE(partly, 16);
}

TEST(ReferenceLight, ASlabReflectsAboveAndTransmitsBelow) {
  constexpr double kRoot = 0.8660254037844386;
  Stage stage = stageOf(slabAt(0.3f, 0.4f, 0.2f), 8, glm::vec3(0.0f));
  stage.daylight = sunAt(130.0, 60.0);
  const glm::dvec3 arriving = stage.daylight.sunIrradiance() * kRoot / kPi;
  expectEverywhere(stage.picture(downward(), smallPicture(), 4), static_cast<double>(0.4f) * arriving);
  const auto below = cameraAt({0.5, 0.5, 0.1}, {0.5, 0.6, 0.3}, 0.4);
  const image::Image under = stage.picture(below, smallPicture(), 4);
  for (const float value : under.pixels) ASSERT_GT(value, 0.0f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(meanOf(under, c) / arriving[c], static_cast<double>(0.2f), 1e-6);
}

TEST(ReferenceLight, ASlabUnderAUniformSkyGivesItBackByItsTwoAlbedos) {
  Stage stage = stageOf(slabAt(0.3f, 0.4f, 0.2f), 8, glm::vec3(0.0f));
  stage.daylight = sunAt(0.0, 30.0, 0.0);
  stage.uniformSky = glm::dvec3(1.5);
  ReferenceOptions options = smallPicture();
  options.sky = true;
  for (const bool fromAbove : {true, false}) {
    const auto reference =
        stage.reference(fromAbove ? downward() : cameraAt({0.5, 0.5, 0.1}, {0.5, 0.6, 0.3}, 0.4), options);
    ASSERT_TRUE(reference->addSamples(64, {}).ok());
    const double deviation = deviationOf(reference->variance());
    EXPECT_NEAR(meanOf(reference->mean()), 1.5 * (fromAbove ? 0.4 : 0.2), kSigmas * deviation);
    EXPECT_LT(deviation, 2e-3);
  }
}

TEST(ReferenceLight, LightBouncesBetweenASlabAndTheSoilAsTheSeriesSays) {
  // Above the slab: r E at once; through it to the soil and up through it again, t a t; one round trip more, times r a.
  const double r = 0.4, t = 0.3, a = 0.6;
  Stage stage = stageOf(slabAt(0.3f, 0.4f, 0.3f), 8, glm::vec3(0.6f));
  stage.daylight = sunAt(130.0, 90.0);
  const double arriving = stage.daylight.sunIrradiance().y / kPi;
  const double expected[] = {r, r, r + t * a * t, r + t * a * t, r + t * a * t * (1.0 + r * a)};
  for (int bounces = 0; bounces < 5; ++bounces) {
    ReferenceOptions options = smallPicture();
    options.bounces = bounces;
    const auto reference = stage.reference(downward(), options);
    ASSERT_TRUE(reference->addSamples(256, {}).ok());
    const double deviation = deviationOf(reference->variance());
    EXPECT_NEAR(meanOf(reference->mean()) / arriving, expected[bounces], kSigmas * deviation / arriving + 1e-6);
    EXPECT_LT(deviation / arriving, 2e-3) << bounces;
  }
}

TEST(ReferenceLight, AFurnaceHidesEverything) {
  // White leaves of any attitude over white soil under a white sky: radiance 1 wherever one looks. Few leaves, so that
  // hardly a path is still on its way after 64 bounces.
  mesh::Model leaves = testing::quad({0.3f, 0.3f, 0.1f}, {0.2f, 0.05f, 0.1f}, {0.0f, 0.2f, 0.1f});
  testing::addQuad(leaves, {0.6f, 0.2f, 0.2f}, {0.0f, 0.2f, 0.0f}, {0.02f, 0.0f, 0.2f});
  testing::addQuad(leaves, {0.2f, 0.7f, 0.15f}, {0.3f, 0.0f, 0.0f}, {0.0f, 0.2f, -0.1f});
  for (const double translucency : {0.0, 0.4, 1.0}) {
    const float reflectance = static_cast<float>(1.0 / (1.0 + translucency));
    leaves.materials[0].baseColour = {reflectance, reflectance, reflectance, 1.0f};
    leaves.materials[0].optics = {translucency, glm::dvec3(1.0)};
    Stage stage = stageOf(testing::patchOf(leaves, 1.0, 0.4), 8, glm::vec3(1.0f));
    stage.daylight = sunAt(0.0, 30.0, 0.0);
    stage.uniformSky = glm::dvec3(1.0);
    ReferenceOptions options = smallPicture();
    options.sky = true;
    options.bounces = 64;
    const auto reference = stage.reference(cameraAt({0.5, -1.0, 1.5}, {0.5, 0.5, 0.0}, 0.4), options);
    ASSERT_TRUE(reference->addSamples(256, {}).ok());
    const double deviation = deviationOf(reference->variance());
    EXPECT_NEAR(meanOf(reference->mean()), 1.0, kSigmas * deviation) << translucency;
    EXPECT_LT(deviation, 5e-3);
  }
}

TEST(ReferenceLight, AlphaIsAChance) {
  // Half-transparent: half of what is seen is slab in the sun; half is soil, of which half is lit through the slab.
  mesh::Model slab = testing::quad({0.0f, 0.0f, 0.2f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  slab.materials[0].baseColour = {0.4f, 0.4f, 0.4f, 0.5f};
  slab.materials[0].optics.translucency = 0.0;
  for (const mesh::AlphaMode mode : {mesh::AlphaMode::Blend, mesh::AlphaMode::Mask}) {
    slab.materials[0].alphaMode = mode;
    slab.materials[0].alphaCutoff = 0.6f;  // masked away altogether
    Stage stage = stageOf(testing::patchOf(slab, 1.0, 0.2), 8, glm::vec3(0.8f));
    const auto reference = stage.reference(downward(), smallPicture());
    ASSERT_TRUE(reference->addSamples(256, {}).ok());
    const double expected = mode == mesh::AlphaMode::Blend ? 0.5 * 0.4 + 0.5 * 0.5 * 0.8 : 0.8;
    const double arriving = stage.daylight.sunIrradiance().y / kPi;
    EXPECT_NEAR(meanOf(reference->mean()) / arriving, expected,
                kSigmas * deviationOf(reference->variance()) / arriving + 1e-6);
  }
}

/// Mean radiance of a patch seen from straight above, from what a bake samples: one slab over its whole height, and the
/// soil where that has a gap. `light` of unit irradiance, or (none) a uniform sky of radiance 1 / pi.
double bakedMean(const PatchScene& scene, double soil, const std::optional<glm::dvec3>& light) {
  SamplingOptions options = testing::smallOptions();
  options.sliceResolution = 192;
  options.slices = 1;
  options.visibilityDirections = 64;
  const LayerHits leaves = testing::hitsOf(scene, LayerSet::Slices, options);
  const LayerSurface surface = shadeSurface(leaves, scene.patch(), {}, {}).value();
  double sum = 0.0;
  std::vector<double> through(static_cast<std::size_t>(leaves.shape.columns()), 1.0);
  const auto add = [&](const LayerHits& hits, auto radiance) {
    const LayerLuminance lit = light ? testing::lightOn(scene, hits, *light) : LayerLuminance{};
    const LayerVisibility sky = light ? LayerVisibility{} : sampleVisibility(scene, hits, options, {}).value();
    for (std::size_t column = 0; column < through.size(); ++column) {
      for (std::uint32_t t = hits.columnStart[column]; t < hits.columnStart[column + 1]; ++t) {
        const auto front = static_cast<double>(light ? lit.reflected[t] : sky.skyReflected[t]);
        const auto back = static_cast<double>(light ? lit.transmitted[t] : sky.skyTransmitted[t]);
        sum += radiance(column, t, front, back) / kPi;
      }
    }
  };
  add(leaves, [&](std::size_t column, std::uint32_t t, double front, double back) {
    through[column] = 1.0 - static_cast<double>(leaves.coverage(t));
    return static_cast<double>(leaves.coverage(t)) * (static_cast<double>(surface.reflectance[t].y) * front +
                                                      static_cast<double>(surface.transmittance[t].y) * back);
  });
  add(testing::hitsOf(scene, LayerSet::Ground, options),
      [&](std::size_t column, std::uint32_t, double front, double) { return through[column] * soil * front; });
  return sum / static_cast<double>(through.size());
}

TEST(ReferenceLight, SeenFromAboveAPatchIsWhatBakesSampleOfIt) {
  // Two ways to the same mean: other rays, other sequences, other cuts. The bake multiplies a texel's mean of soil and
  // gap, which are not independent within it, and each side has its noise: 0.2 % and 0.4 % were measured.
  auto patch = testing::smallMeadow();
  Stage stage = stageOf(patch, 16, glm::vec3(0.3f));
  ReferenceOptions options = smallPicture(96, 96);
  options.filter = PixelFilter::Box;
  // One patch, from so far that all rays are vertical to 1e-3.
  const scene::Camera above = cameraAt({0.5, 0.5, 500.0}, {0.5, 0.5, 0.0}, 0.001);
  for (const bool sun : {true, false}) {
    stage.daylight = sunAt(240.0, 40.0, sun ? 1.0 : 0.0);
    options.sky = !sun;
    stage.uniformSky = glm::dvec3(1.0 / kPi);
    const auto reference = stage.reference(above, options);
    ASSERT_TRUE(reference->addSamples(16, {}).ok());
    const double mean = meanOf(reference->mean()) / (sun ? stage.daylight.sunIrradiance().y : 1.0);
    const std::optional<glm::dvec3> light = sun ? std::optional(stage.daylight.sunDirection()) : std::nullopt;
    EXPECT_NEAR(mean / bakedMean(*stage.traced, 0.3, light), 1.0, 0.01) << sun;
  }
}

TEST(ReferenceLight, HazeHidesByTheDistanceToTheShell) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.5), 8, glm::vec3(0.3f));
  stage.daylight = sunAt(200.0, 90.0);
  stage.hazeKm = 0.02;
  // A picture so narrow that it has one distance: 20 m times root 2 from 20.5 m to the shell's top at 0.5 m.
  const image::Image picture = stage.picture(cameraAt({0.0, 0.0, 20.5}, {0.0, 20.0, 0.5}, 1e-5), smallPicture(4, 4), 4);
  const double clear = std::exp(-std::sqrt(2.0));
  const glm::dvec3 horizon = stage.daylight.skyRadiance({0.0, 1.0, 0.0});
  const glm::dvec3 soil = static_cast<double>(0.3f) * stage.daylight.sunIrradiance() / kPi;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(meanOf(picture, c), glm::mix(horizon, soil, clear)[c], 2e-5);
}

TEST(ReferenceLight, TheSkyBehindIsTheDaylightsWithItsDisc) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 8, glm::vec3(0.3f));
  stage.daylight = sunAt(90.0, 20.0);
  const glm::dvec3 sun = stage.daylight.sunDirection(), eye(0.0, 0.0, 2.0);
  const auto seen = [&](const glm::dvec3& direction) {
    return meanOf(stage.picture(cameraAt(eye, eye + direction, 1e-6), smallPicture(2, 2), 2));
  };
  EXPECT_NEAR(seen({0.0, 0.8, 0.6}), stage.daylight.skyRadiance({0.0, 0.8, 0.6}).y, 1e-4);
  EXPECT_NEAR(seen(sun), stage.daylight.skyRadiance(sun).y + scene::kSunDiscGain * stage.daylight.sunIrradiance().y,
              0.01);
}

/// Cosine-weighted integral of a sky over a plane's front, over its samples and over a fine grid of the formula itself.
TEST(SkyLight, IrradianceOfPlanesIsTheFormulas) {
  const scene::Daylight daylight = sunAt(130.0, 25.0);
  const SkyLight sky(daylight, std::nullopt);
  for (const glm::dvec3 normal : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(-0.6, 0.0, 0.8),
                                  glm::dvec3(0.48, -0.64, 0.6)}) {
    glm::dvec3 sampled(0.0), exact(0.0);
    constexpr int kSide = 1024;
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        const glm::dvec2 u((i + 0.5) / kSide, (j + 0.5) / kSide);
        const LightSample sample = sky.sample(u);
        ASSERT_GE(sample.direction.z, 0.0);
        sampled += sample.weight * std::max(glm::dot(normal, sample.direction), 0.0);
        const double radius = std::sqrt(1.0 - u.x * u.x), turn = 2.0 * kPi * u.y;
        const glm::dvec3 direction(radius * std::cos(turn), radius * std::sin(turn), u.x);
        exact += 2.0 * kPi * daylight.skyRadiance(direction) * std::max(glm::dot(normal, direction), 0.0);
      }
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sampled[c] / exact[c], 1.0, 1e-3) << c;
  }
}

}  // namespace
}  // namespace sward::trace
