#include "scene/camera.h"
#include "scene/lights.h"
#include "scene/sun_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sward::scene {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Directions, AnglesAndVectorsRoundTrip) {
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 30.0) {
    for (double elevation = -80.0; elevation <= 80.0; elevation += 20.0) {
      const SunAngles back = anglesFromDirection(directionFromAngles({azimuth, elevation}));
      EXPECT_NEAR(back.elevationDeg, elevation, 1e-9);
      EXPECT_NEAR(std::remainder(back.azimuthDeg - azimuth, 360.0), 0.0, 1e-9);
    }
  }
  // East is x, north is y.
  EXPECT_NEAR(glm::distance(directionFromAngles({90.0, 0.0}), glm::dvec3(1, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(directionFromAngles({0.0, 0.0}), glm::dvec3(0, 1, 0)), 0.0, 1e-12);
}

TEST(Lights, FibonacciIsEvenOverTheHemisphere) {
  const auto lights = fibonacciHemisphere(1000);
  glm::dvec3 sum{0.0};
  double squares = 0.0;
  for (const auto& light : lights) {
    EXPECT_NEAR(glm::length(light), 1.0, 1e-12);
    EXPECT_GT(light.z, 0.0);
    sum += light;
    squares += light.x * light.x;
  }
  EXPECT_NEAR(sum.z / 1000.0, 0.5, 1e-3);  // mean of z over a hemisphere
  EXPECT_NEAR(sum.x / 1000.0, 0.0, 5e-3);
  EXPECT_NEAR(squares / 1000.0, 1.0 / 3.0, 5e-3);
}

TEST(Lights, ErrorsSayWhich) {
  LightOptions options;
  options.count = 0;
  EXPECT_FALSE(lightDirections(options).ok());
  options = {LightPattern::List, 15, {{10.0, 20.0}, {0.0, -5.0}}};
  const auto below = lightDirections(options);
  ASSERT_FALSE(below.ok());
  EXPECT_NE(below.error().where.find("[1]"), std::string::npos);
}

TEST(Sun, AgreesWithPublishedPositions) {
  // Reda and Andreas (2008), NREL SPA worked example: 17 October 2003, 12:30:30 at UTC-7, latitude 39.742476,
  // longitude -105.1786: topocentric zenith 50.11162 degrees (with refraction of about 0.02), azimuth 194.34024.
  const SunAngles spa = sunAngles({2003, 10, 17, 19.0 + 30.5 / 60.0, 39.742476, -105.1786});
  EXPECT_NEAR(spa.azimuthDeg, 194.34024, 0.02);
  EXPECT_NEAR(spa.elevationDeg, 90.0 - 50.11162, 0.03);
}

TEST(Sun, StandsHighAtMidsummerNoonAndLowAtMidwinter) {
  const SunAngles june = sunAngles({2025, 6, 21, 12.0, 50.0, 0.0});
  EXPECT_NEAR(june.elevationDeg, 90.0 - 50.0 + 23.44, 0.1);
  EXPECT_NEAR(june.azimuthDeg, 180.0, 1.5);
  EXPECT_NEAR(sunAngles({2025, 12, 21, 12.0, 50.0, 0.0}).elevationDeg, 90.0 - 50.0 - 23.44, 0.1);
  // South of the equator the noon sun is in the north.
  const double southern = sunAngles({2025, 6, 21, 12.0, -35.0, 0.0}).azimuthDeg;
  EXPECT_LT(std::abs(std::remainder(southern, 360.0)), 2.0);
}

TEST(Sun, RefusesDatesAndPlacesThatDoNotExist) {
  SunOptions options;
  options.byMoment = true;
  options.moment = {2025, 2, 30, 12.0, 0.0, 0.0};
  EXPECT_FALSE(sunDirection(options).ok());
  options.moment = {2025, 2, 28, 24.0, 0.0, 0.0};
  EXPECT_FALSE(sunDirection(options).ok());
  options.moment = {2025, 2, 28, 12.0, 91.0, 0.0};
  EXPECT_FALSE(sunDirection(options).ok());
  options.moment = {2024, 2, 29, 12.0, 10.0, 0.0};
  EXPECT_TRUE(sunDirection(options).ok());
  options.byMoment = false;
  options.angles = {0.0, std::nan("")};
  EXPECT_FALSE(sunDirection(options).ok());
}

TEST(Sky, IsFiniteAndPositiveEverywhere) {
  for (const double turbidity : {0.0, 1.7, 3.0, 10.0, 50.0}) {
    for (double elevation = -90.0; elevation <= 90.0; elevation += 7.5) {
      SkyOptions sky;
      sky.turbidity = turbidity;
      const Daylight daylight(directionFromAngles({123.0, elevation}), {}, sky);
      for (const glm::dvec3& direction : fibonacciHemisphere(64)) {
        for (const double sign : {1.0, -1.0}) {
          const glm::dvec3 radiance = daylight.skyRadiance({direction.x, direction.y, sign * direction.z});
          for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(std::isfinite(radiance[c]));
            EXPECT_GE(radiance[c], 0.0);
          }
        }
      }
      EXPECT_TRUE(std::isfinite(daylight.autoExposure()));
    }
  }
}

TEST(Sky, ClearNoonHasPlausibleLevelsAndColours) {
  const Daylight noon(directionFromAngles({180.0, 65.0}), {}, {});
  const double horizontal = noon.sunIrradiance().g * std::sin(65.0 * kPi / 180.0);
  EXPECT_GT(horizontal, 0.6 * kPi);
  EXPECT_LT(horizontal, 1.2 * kPi);
  // On a clear noon the sky gives some 10 to 25 % of the horizontal light, and it is blue; the sun is not.
  const double share = kPi * noon.meanSkyRadiance().g / (horizontal + kPi * noon.meanSkyRadiance().g);
  EXPECT_GT(share, 0.05);
  EXPECT_LT(share, 0.35);
  EXPECT_GT(noon.meanSkyRadiance().b, 1.2 * noon.meanSkyRadiance().r);
  EXPECT_GT(noon.sunIrradiance().r, noon.sunIrradiance().b);
  // Toward evening the sun reddens and dims; below the horizon it is gone.
  const Daylight evening(directionFromAngles({270.0, 5.0}), {}, {});
  EXPECT_GT(evening.sunIrradiance().r / evening.sunIrradiance().b,
            2.0 * noon.sunIrradiance().r / noon.sunIrradiance().b);
  EXPECT_LT(evening.sunIrradiance().g, 0.5 * noon.sunIrradiance().g);
  EXPECT_EQ(Daylight(directionFromAngles({270.0, -1.0}), {}, {}).sunIrradiance().g, 0.0);
}

TEST(Sky, MapHoldsTheRadiance) {
  const Daylight daylight(directionFromAngles({40.0, 30.0}), {}, {});
  const image::Image map = daylight.skyMap(64, 32);
  const glm::dvec3 expected =
      daylight.skyRadiance(directionFromAngles({360.0 * 10.5 / 64, 90.0 * (20.5 / 32) * (20.5 / 32)}));
  EXPECT_NEAR(map.at(10, 20, 1), expected.g, 1e-5 * expected.g);
}

TEST(Camera, FramesWhatItLooksAt) {
  const Camera camera = cameraFromView({"v", {1.0, -3.0, 2.0}, {1.0, 5.0, 0.5}, 36.0, 0.0}).value();
  EXPECT_NEAR(glm::distance(camera.rayDirection(0.5, 0.5, 1.6), camera.forward), 0.0, 1e-12);
  // 36 mm on a 36 mm sensor: the edge is half the focal length to the side.
  EXPECT_NEAR(camera.tanHalfWidth, 0.5, 1e-12);
  EXPECT_GT(camera.rayDirection(1.0, 0.5, 1.6).x, 0.0);
  EXPECT_GT(camera.rayDirection(0.5, 0.0, 1.6).z, camera.rayDirection(0.5, 1.0, 1.6).z);
  EXPECT_NEAR(glm::dot(camera.right, camera.up), 0.0, 1e-12);
}

TEST(Camera, LooksStraightDownWithNorthUp) {
  const Camera camera = cameraFromView({"top", {0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}, 35.0, 0.0}).value();
  EXPECT_NEAR(glm::distance(camera.up, glm::dvec3(0, 1, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(camera.right, glm::dvec3(1, 0, 0)), 0.0, 1e-12);
}

TEST(Camera, RefusesWhatCannotBeLookedThrough) {
  EXPECT_FALSE(cameraFromView({"v", {1, 1, 1}, {1, 1, 1}, 35.0, 0.0}).ok());
  EXPECT_FALSE(cameraFromView({"v", {1, 1, 1}, {1, 1, 2}, 0.0, 0.0}).ok());
  EXPECT_FALSE(cameraFromView({"v", {1, NAN, 1}, {1, 1, 2}, 35.0, 0.0}).ok());
}

}  // namespace
}  // namespace sward::scene
