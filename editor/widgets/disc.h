#pragma once

#include <functional>

#include <glm/glm.hpp>
#include <imgui.h>

/// The sky's hemisphere as a disc seen from above: north is up, azimuth runs clockwise, the zenith is in the middle.
/// Places on it are (right, up) with the horizon at distance 1.
namespace sward::editor {

struct SkyAngles {
  double azimuthDeg = 0.0;    ///< clockwise from north, [0, 360)
  double elevationDeg = 0.0;  ///< up from the horizon
};

/// How elevation becomes distance from the middle.
enum class DiscMap {
  Equidistant,  ///< degrees are of one length; below the horizon it goes on as far as -18 degrees
  EqualArea     ///< equal solid angles have equal areas (Lambert's zenithal projection); the horizon is the edge
};

/// Place of a direction. Elevations are held in what the map shows.
glm::dvec2 discPlace(const SkyAngles& angles, DiscMap map);
/// The inverse; places beyond the edge are pulled onto it. The azimuth of the middle itself is `azimuthAtZenith`.
SkyAngles discAngles(glm::dvec2 place, DiscMap map, double azimuthAtZenith = 0.0);

/// "NNE" of an azimuth.
const char* compassPoint(double azimuthDeg);

/// Fills the disc with a colour for each place, blended between the corners of a polar net; `reach` is the distance
/// of the outermost ring.
void paintDisc(ImDrawList* draw, ImVec2 centre, float radius, double reach,
               const std::function<ImU32(glm::dvec2)>& colour);

/// Screen position of a place, and back.
ImVec2 discScreen(ImVec2 centre, float radius, glm::dvec2 place);
glm::dvec2 discFromScreen(ImVec2 centre, float radius, ImVec2 screen);

}  // namespace sward::editor
