#pragma once

#include <array>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace sward::scene {

/// Sun position given as angles.
struct SunAngles {
  double azimuthDeg = 225.0;   ///< clockwise from north (+y), [0, 360)
  double elevationDeg = 35.0;  ///< up from the horizon, [-90, 90]
  bool operator==(const SunAngles&) const = default;
};

/// Sun position given as a moment and a place.
struct SunMoment {
  int year = 2025, month = 6, day = 21;
  double hourUtc = 15.0;       ///< [0, 24)
  double latitudeDeg = 48.0;   ///< north positive
  double longitudeDeg = 11.0;  ///< east positive
  bool operator==(const SunMoment&) const = default;
};

struct SunOptions {
  bool byMoment = false;  ///< use `moment` instead of `angles`
  SunAngles angles;
  SunMoment moment;
  double intensity = 1.0;  ///< multiplies the physical irradiance
  bool operator==(const SunOptions&) const = default;
};

struct SkyOptions {
  double turbidity = 3.0;  ///< Preetham's: 2 very clear to 10 hazy
  double intensity = 1.0;
  double hazeKm = 12.0;  ///< distance at which aerial perspective hides 63 %; 0: none
  bool operator==(const SkyOptions&) const = default;
};

/// A named view. Looks from position to target (metres, world), z up.
struct View {
  std::string name = "main";
  glm::dvec3 position{0.0, -4.0, 1.6};
  glm::dvec3 target{0.0, 2.0, 0.4};
  double focalLengthMm = 35.0;  ///< on a 36 mm wide sensor
  double exposureEv = 0.0;      ///< stops added to the automatic exposure of the sun and sky
  bool operator==(const View&) const = default;
};

enum class LightPattern { Fibonacci, List, Rings, SunPath };

/// Rings of lights at heights evenly spaced from the lowest to the highest, each ring turned by half a step against the
/// one below.
struct RingOptions {
  int rings = 2;
  int lightsPerRing = 7;
  double lowestDeg = 20.0;   ///< elevation of the first ring, and of the only one
  double highestDeg = 55.0;  ///< of the last ring
  bool zenith = true;        ///< one more light straight above
  bool operator==(const RingOptions&) const = default;
};

/// A day of any year; the sun's path differs by less than half a degree from year to year.
struct SunDate {
  int month = 6;
  int day = 21;
  bool operator==(const SunDate&) const = default;
};

/// Where the sun passes on some days: for scenes that are only ever lit by the sun of one place.
struct SunPathOptions {
  double latitudeDeg = 48.0;  ///< north positive
  std::vector<SunDate> dates{{6, 21}, {3, 20}, {12, 21}};
  int positions = 5;       ///< lights of each day, evenly spaced in time while the sun stands above lowestDeg
  double lowestDeg = 3.0;  ///< elevation
  bool operator==(const SunPathOptions&) const = default;
};

/// The light directions that are baked.
struct LightOptions {
  LightPattern pattern = LightPattern::Fibonacci;
  int count = 15;                     ///< for Fibonacci
  std::vector<SunAngles> directions;  ///< for List
  RingOptions rings;                  ///< for Rings
  SunPathOptions sunPath;             ///< for SunPath
  bool operator==(const LightOptions&) const = default;
};

}  // namespace sward::scene
