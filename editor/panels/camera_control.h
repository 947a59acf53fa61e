#pragma once

#include "scene/options.h"

#include <optional>

#include <glm/glm.hpp>

namespace sward::editor {

/// Ways to move a view with the mouse and keys. All keep the picture upright and the eye above the ground, and give a
/// view whose position and target differ. Distances in metres, angles in radians, mouse ways in fractions of the
/// viewport's height, so that they do not depend on its size.

/// Turns the eye about the target: by `right` times half a turn and `up` times half a turn; never past the vertical.
void orbit(scene::View& view, double right, double up);
/// Turns the look about the eye, the same way.
void lookAround(scene::View& view, double right, double up);
/// Moves eye and target in the picture's plane, so that the target's point follows the mouse; `aspect` is the
/// viewport's width / height.
void pan(scene::View& view, double right, double up, double aspect);
/// Moves the eye toward the target (`steps` > 0) by a tenth of their distance a step, never through it.
void dolly(scene::View& view, double steps);
/// Moves eye and target by metres along the look (on the level), to the right, and up.
void fly(scene::View& view, double forward, double right, double up);
/// Looks at a disc of the ground of `radiusM` about `centre` so that it fills the picture, from the present direction.
void frame(scene::View& view, const glm::dvec3& centre, double radiusM, double aspect);

/// The point of the ground (z = 0) under a point of the picture, (x, y) in [0, 1] from the top left; nothing above the
/// horizon.
std::optional<glm::dvec3> groundPoint(const scene::View& view, double x, double y, double aspect);

/// Directions of the standard views.
enum class StandardView { Top, Front, Side };
void look(scene::View& view, StandardView from, double distanceM);

/// Eyes never come nearer to the ground than this.
inline constexpr double kLeastEyeM = 0.02;

}  // namespace sward::editor
