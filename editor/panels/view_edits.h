#pragma once

#include "panels/ui_state.h"
#include "project/project.h"

#include <string>

namespace sward::editor {

/// What the viewport does to a project, apart from how the mouse said so.

/// Turns the sun by so many degrees, azimuth wrapping round, elevation held in [-10, 90]. A sun that stood by date and
/// place becomes one by angles, starting where it stood.
void turnSun(project::Project& project, double azimuthDeg, double elevationDeg);
/// The sun's present angles, whichever way they are given; those of the options when the moment does not exist.
scene::SunAngles sunAnglesOf(const project::Project& project);

/// Whether the ground is texels, of which only the plain picture can be drawn.
bool drawsTexels(const project::Project& project);
/// The view mode and the comparison that the viewport shows: what is chosen, as far as the ground can be drawn so.
render::ViewMode shownMode(const UiState& ui, const project::Project& project);
CompareState shownComparison(const UiState& ui, const project::Project& project);

}  // namespace sward::editor
