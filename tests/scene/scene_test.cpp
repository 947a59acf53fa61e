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
  options.pattern = LightPattern::List;
  options.directions = {{10.0, 20.0}, {0.0, -5.0}};
  const auto below = lightDirections(options);
  ASSERT_FALSE(below.ok());
  EXPECT_NE(below.error().where.find("[1]"), std::string::npos);
}

TEST(Lights, RingsStandEvenlyAndStaggered) {
  RingOptions options;
  options.rings = 3;
  options.lightsPerRing = 8;
  options.lowestDeg = 10.0;
  options.highestDeg = 70.0;
  const auto lights = ringLights(options);
  ASSERT_EQ(lights.size(), 25u);
  EXPECT_EQ(lights.back(), glm::dvec3(0, 0, 1));
  for (std::size_t i = 0; i < 24; ++i) {
    EXPECT_NEAR(glm::length(lights[i]), 1.0, 1e-12);
    const SunAngles angles = anglesFromDirection(lights[i]);
    EXPECT_NEAR(angles.elevationDeg, 10.0 + 30.0 * static_cast<double>(i / 8), 1e-9);
    const double expected = 45.0 * static_cast<double>(i % 8) + (i / 8 == 1 ? 22.5 : 0.0);
    EXPECT_NEAR(std::remainder(angles.azimuthDeg - expected, 360.0), 0.0, 1e-9) << i;
  }
  options.rings = 1;
  options.zenith = false;
  const auto single = ringLights(options);
  ASSERT_EQ(single.size(), 8u);
  EXPECT_NEAR(single[3].z, std::sin(10.0 * kPi / 180.0), 1e-12);
}

/// Declination on a day and the hour angle of a light, from the light itself: the pole stands at the latitude.
double declinationDeg(const glm::dvec3& light, double latitudeDeg) {
  const double latitude = latitudeDeg * kPi / 180.0;
  return std::asin(glm::dot(light, {0.0, std::cos(latitude), std::sin(latitude)})) * 180.0 / kPi;
}
double hourAngleDeg(const glm::dvec3& light, double latitudeDeg) {
  const double latitude = latitudeDeg * kPi / 180.0;
  const double south = glm::dot(light, {0.0, -std::sin(latitude), std::cos(latitude)});
  return std::atan2(-light.x, south) * 180.0 / kPi;  // the sun moves west
}

TEST(Lights, SunPathFollowsTheSunOfADay) {
  struct Day {
    SunDate date;
    double declination;
  };
  // Declinations of the solstices are the obliquity; 16 April has some ten degrees.
  for (const Day& day : {Day{{6, 21}, 23.44}, Day{{12, 21}, -23.44}, Day{{4, 16}, 10.2}}) {
    for (const double latitude : {48.0, 0.0, -35.0, 60.0}) {
      SunPathOptions options;
      options.latitudeDeg = latitude;
      options.dates = {day.date};
      options.positions = 7;
      options.lowestDeg = 5.0;
      const auto lights = sunPathLights(options);
      ASSERT_EQ(lights.size(), 7u);
      for (const glm::dvec3& light : lights) {
        EXPECT_NEAR(declinationDeg(light, latitude), day.declination, 0.3);
        EXPECT_GE(light.z, std::sin(5.0 * kPi / 180.0) - 1e-9);
      }
      // The sunset equation, for an elevation h: cos H = (sin h - sin phi sin delta) / (cos phi cos delta).
      const double phi = latitude * kPi / 180.0, delta = declinationDeg(lights[3], latitude) * kPi / 180.0;
      const double half = std::acos((std::sin(5.0 * kPi / 180.0) - std::sin(phi) * std::sin(delta)) /
                                    (std::cos(phi) * std::cos(delta))) *
                          180.0 / kPi;
      for (std::size_t i = 0; i < 7; ++i) {
        const double expected = half * (2.0 * (static_cast<double>(i) + 0.5) / 7.0 - 1.0);
        EXPECT_NEAR(hourAngleDeg(lights[i], latitude), expected, 0.4) << latitude << " " << i;
      }
      // Morning is in the east.
      EXPECT_GT(lights.front().x, 0.0);
      EXPECT_LT(lights.back().x, 0.0);
    }
  }
}

TEST(Lights, SunPathKnowsPolarDayAndNight) {
  SunPathOptions options;
  options.latitudeDeg = 80.0;
  options.dates = {{6, 21}, {12, 21}};
  options.positions = 8;
  const auto lights = sunPathLights(options);
  ASSERT_EQ(lights.size(), 8u);  // of June alone, all round the clock
  for (std::size_t i = 0; i < 8; ++i) {
    const double step = hourAngleDeg(lights[(i + 1) % 8], 80.0) - hourAngleDeg(lights[i], 80.0);
    EXPECT_NEAR(std::remainder(step - 45.0, 360.0), 0.0, 0.1);
  }
  LightOptions night;
  night.pattern = LightPattern::SunPath;
  night.sunPath = options;
  night.sunPath.dates = {{12, 21}};
  const auto none = lightDirections(night);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().where, "lights.sunPath");
  EXPECT_NE(none.error().what.find("never stands higher"), std::string::npos);
  for (const double pole : {90.0, -90.0}) {
    options.latitudeDeg = pole;
    EXPECT_EQ(sunPathLights(options).size(), 8u);
  }
}

TEST(Lights, SunPathLeavesOutDatesThatDoNotExist) {
  SunPathOptions options;
  options.dates = {{2, 30}, {0, 1}, {13, 1}, {1, 0}, {2, 29}};
  EXPECT_EQ(sunPathLights(options).size(), static_cast<std::size_t>(options.positions));
  options.dates = {{6, 21}};
  options.positions = 0;
  EXPECT_TRUE(sunPathLights(options).empty());
}

TEST(Lights, EveryPatternGivesUnitVectorsAboveTheHorizon) {
  LightOptions options;
  options.directions = {{0.0, 0.0}, {90.0, 90.0}};
  options.sunPath.lowestDeg = 0.0;
  for (const LightPattern pattern :
       {LightPattern::Fibonacci, LightPattern::List, LightPattern::Rings, LightPattern::SunPath}) {
    options.pattern = pattern;
    const auto lights = lightDirections(options);
    ASSERT_TRUE(lights.ok());
    EXPECT_EQ(lights->size(), pattern == LightPattern::List ? 2u : 15u);
    for (const glm::dvec3& light : *lights) {
      EXPECT_NEAR(glm::length(light), 1.0, 1e-12);
      EXPECT_GE(light.z, 0.0);
    }
  }
  options.pattern = LightPattern::Rings;
  options.rings.lowestDeg = -5.0;
  EXPECT_FALSE(lightDirections(options).ok());
  options.rings.lowestDeg = std::nan("");
  EXPECT_FALSE(lightDirections(options).ok());
  options.rings = {};
  options.rings.rings = 0;
  options.rings.zenith = false;
  EXPECT_FALSE(lightDirections(options).ok());
  options.pattern = LightPattern::SunPath;
  options.sunPath.latitudeDeg = 91.0;
  EXPECT_FALSE(lightDirections(options).ok());
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
