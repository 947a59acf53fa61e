#pragma once

#include "base/job.h"
#include "image/image.h"

#include <functional>

#include <glm/glm.hpp>

namespace sward::image {

/// Gives what the display shows at a pixel: linear Rec. 709 RGB in [0, 1].
using ShownColour = std::function<glm::vec3(int x, int y)>;

/// FLIP at every pixel of `map` (one channel, its size is the images'). Rows are left out when the job is cancelled.
void fillFlipMap(const ShownColour& reference, const ShownColour& test, double pixelsPerDegree, const JobContext& job,
                 Image& map);

}  // namespace sward::image
