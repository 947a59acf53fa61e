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

/// CIE XYZ of the white of Rec. 709 and sRGB: D65 of chromaticity (0.31271, 0.32902), Y = 1.
inline constexpr glm::dvec3 kWhiteXyz{0.31271 / 0.32902, 1.0, (1.0 - 0.31271 - 0.32902) / 0.32902};

/// CIE 1931 XYZ of linear Rec. 709 RGB, white at kWhiteXyz, and back.
glm::dvec3 xyzFromLinear(const glm::dvec3& linear);
glm::dvec3 linearFromXyz(const glm::dvec3& xyz);

/// CIE 1976 L*, a*, b* against kWhiteXyz: L* is 0 to 100 for colours up to white, and goes on beyond it and below 0.
struct Lab {
  double l = 0.0;
  double a = 0.0;
  double b = 0.0;
};
Lab labFromXyz(const glm::dvec3& xyz);
Lab labFromLinear(const glm::dvec3& linear);
Lab labFromSrgb(const glm::dvec3& encoded);

}  // namespace sward::image
