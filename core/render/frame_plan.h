#pragma once

#include "base/result.h"
#include "project/project.h"
#include "render/renderer.h"
#include "scene/sun_sky.h"
#include "terrain/heightmap.h"

#include <vector>

namespace sward::render {

/// The sun and sky of a project. Errors: a moment or place that does not exist.
Result<scene::Daylight> daylightOf(const project::Project& project);

/// What a project says of a picture of one view, in its own output's size: camera, exposure (automatic for the
/// daylight, times two to the view's stops and `addedEv`), way to draw. The editor's viewport and `sward render` both
/// ask this. Errors: a view that gives no camera.
Result<Frame> planFrame(const project::Project& project, const scene::View& view, const scene::Daylight& daylight,
                        double addedEv = 0.0);

/// A project's terrain for Renderer::setTerrain(), and what is odd about its file.
Result<terrain::Terrain> terrainOf(const project::Project& project, const JobContext& job = {});

/// What validate() cannot tell without the heights: a terrain that cannot be made, oddities of its file, and views that
/// stand below the ground (warnings).
std::vector<project::Problem> terrainProblems(const project::Project& project);

}  // namespace sward::render
