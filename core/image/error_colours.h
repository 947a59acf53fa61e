#pragma once

#include "base/result.h"
#include "image/image.h"

#include <glm/glm.hpp>

namespace sward::image {

/// The sRGB-encoded colour of an error in [0, 1], clamped: black through purple and orange to pale yellow, ever
/// lighter. It is "magma" of van der Walt and Smith (matplotlib, CC0), linear between every 15th of its 256
/// colours, which stays within 0.011 of it. NaN is black.
glm::vec3 errorColour(float error);

/// A picture of a map of one channel in [0, 1], such as FLIP's: sRGB-encoded RGB. Errors: an empty map, or one of
/// several channels.
Result<Image> colourErrors(const Image& map);

}  // namespace sward::image
