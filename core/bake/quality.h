#pragma once

#include "project/project.h"

namespace sward::bake {

/// How finely a ground is baked: to be shown at once, soon, and as it is rendered.
enum class Quality { Coarse, Half, Full };
const char* qualityName(Quality quality);

/// The project whose bake stands in for this one's at a quality: the same plants in the same places and tiles as large
/// in metres, sampled more coarsely, so that every node has a key of its own. Full is the project itself. A project
/// whose sizes cannot be divided (tiles of 8 texels, odd sizes) is divided less, down to not at all; a valid project
/// stays valid.
project::Project atQuality(const project::Project& project, Quality quality);

/// Samples the patch with that many texels a side, a power of two times the project's: blades and tiles follow, so that
/// tiles stay as large in metres. False, and nothing is changed, where sizes would not stay whole or valid.
bool setSliceResolution(project::Project& project, int resolution);

}  // namespace sward::bake
