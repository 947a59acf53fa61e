#pragma once

#include <glm/glm.hpp>

namespace sward::image {

/// sRGB transfer function (IEC 61966-2-1), per value. Linear in, encoded out, and back. Values outside [0, 1] follow
/// the curve's own extension (mirrored for negatives).
float srgbFromLinear(float linear);
float linearFromSrgb(float encoded);
glm::vec3 srgbFromLinear(const glm::vec3& linear);
glm::vec3 linearFromSrgb(const glm::vec3& encoded);

/// Relative luminance of linear Rec. 709 RGB.
float luminance(const glm::vec3& linear);

}  // namespace sward::image
