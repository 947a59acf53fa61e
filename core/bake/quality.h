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

}  // namespace sward::bake
