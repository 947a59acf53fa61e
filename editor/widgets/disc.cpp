#include "widgets/disc.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::editor {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLowestDeg = -18.0;  ///< the end of astronomical twilight: no light of the sun is left below it

double radians(double degrees) {
  return degrees * kPi / 180.0;
}

double degrees(double value) {
  return value * 180.0 / kPi;
}

}  // namespace

glm::dvec2 discPlace(const SkyAngles& angles, DiscMap map) {
  double distance = 0.0;
  if (map == DiscMap::Equidistant) {
    distance = (90.0 - std::clamp(angles.elevationDeg, kLowestDeg, 90.0)) / 90.0;
  } else {
    // A cap from the zenith down to elevation e has the area 2 pi (1 - sin e) of the hemisphere's 2 pi.
    distance = std::sqrt(std::max(0.0, 1.0 - std::sin(radians(std::clamp(angles.elevationDeg, 0.0, 90.0)))));
  }
  const double a = radians(angles.azimuthDeg);
  return distance * glm::dvec2(std::sin(a), std::cos(a));
}

SkyAngles discAngles(glm::dvec2 place, DiscMap map, double azimuthAtZenith) {
  const double distance = glm::length(place);
  SkyAngles angles{azimuthAtZenith, 90.0};
  if (distance > 1e-9) {
    angles.azimuthDeg = degrees(std::atan2(place.x, place.y));
    if (angles.azimuthDeg < 0.0) angles.azimuthDeg += 360.0;
    if (angles.azimuthDeg >= 360.0) angles.azimuthDeg = 0.0;
  }
  if (map == DiscMap::Equidistant) {
    angles.elevationDeg = std::clamp(90.0 * (1.0 - distance), kLowestDeg, 90.0);
  } else {
    const double r = std::min(distance, 1.0);
    angles.elevationDeg = degrees(std::asin(std::clamp(1.0 - r * r, 0.0, 1.0)));
  }
  return angles;
}

const char* compassPoint(double azimuthDeg) {
  constexpr std::array kNames{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                              "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  const double turns = std::fmod(std::fmod(azimuthDeg, 360.0) + 360.0, 360.0) / 22.5;
  return kNames[static_cast<std::size_t>(std::lround(turns)) % kNames.size()];
}

void paintDisc(ImDrawList* draw, ImVec2 centre, float radius, double reach,
               const std::function<ImU32(glm::dvec2)>& colour) {
  constexpr int kRings = 18, kSectors = 72;
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  draw->PrimReserve(kRings * kSectors * 6, (kRings + 1) * kSectors);
  const auto first = static_cast<unsigned>(draw->_VtxCurrentIdx);
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int sector = 0; sector < kSectors; ++sector) {
      const double distance = reach * ring / kRings, angle = 2.0 * kPi * sector / kSectors;
      const glm::dvec2 place = distance * glm::dvec2(std::sin(angle), std::cos(angle));
      draw->PrimWriteVtx(discScreen(centre, radius, place), white, colour(place));
    }
  }
  const auto index = [&](int ring, int sector) {
    return static_cast<ImDrawIdx>(first + static_cast<unsigned>(ring * kSectors + sector % kSectors));
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int sector = 0; sector < kSectors; ++sector) {
      for (const ImDrawIdx i : {index(ring, sector), index(ring + 1, sector), index(ring + 1, sector + 1),
                                index(ring, sector), index(ring + 1, sector + 1), index(ring, sector + 1)}) {
        draw->PrimWriteIdx(i);
      }
    }
  }
}

ImVec2 discScreen(ImVec2 centre, float radius, glm::dvec2 place) {
  return ImVec2(centre.x + static_cast<float>(place.x) * radius, centre.y - static_cast<float>(place.y) * radius);
}

glm::dvec2 discFromScreen(ImVec2 centre, float radius, ImVec2 screen) {
  return {static_cast<double>((screen.x - centre.x) / radius), static_cast<double>((centre.y - screen.y) / radius)};
}

}  // namespace sward::editor
