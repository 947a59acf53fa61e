#include "image/colour.h"

#include <cmath>

namespace sward::image {

namespace {

// The primaries' chromaticities are Rec. 709's; their amounts are those that add up to the white. A column is a
// primary.
glm::dmat3 primariesToXyz() {
  const auto unscaled = [](double x, double y) { return glm::dvec3(x / y, 1.0, (1.0 - x - y) / y); };
  const glm::dmat3 primaries(unscaled(0.64, 0.33), unscaled(0.30, 0.60), unscaled(0.15, 0.06));
  const glm::dvec3 amounts = glm::inverse(primaries) * kWhiteXyz;
  return {primaries[0] * amounts.x, primaries[1] * amounts.y, primaries[2] * amounts.z};
}

// CIE 15:2004, 8.2.1.1: the cube root, and below (6/29)^3 its tangent there.
double labCurve(double ratio) {
  constexpr double kKnee = 6.0 / 29.0;
  return ratio > kKnee * kKnee * kKnee ? std::cbrt(ratio) : ratio / (3.0 * kKnee * kKnee) + 4.0 / 29.0;
}

}  // namespace

float srgbFromLinear(float linear) {
  const float size = std::abs(linear);
  const float encoded = size <= 0.0031308f ? 12.92f * size : 1.055f * std::pow(size, 1.0f / 2.4f) - 0.055f;
  return std::copysign(encoded, linear);
}

float linearFromSrgb(float encoded) {
  const float size = std::abs(encoded);
  const float linear = size <= 0.04045f ? size / 12.92f : std::pow((size + 0.055f) / 1.055f, 2.4f);
  return std::copysign(linear, encoded);
}

glm::vec3 srgbFromLinear(const glm::vec3& linear) {
  return {srgbFromLinear(linear.x), srgbFromLinear(linear.y), srgbFromLinear(linear.z)};
}

glm::vec3 linearFromSrgb(const glm::vec3& encoded) {
  return {linearFromSrgb(encoded.x), linearFromSrgb(encoded.y), linearFromSrgb(encoded.z)};
}

float luminance(const glm::vec3& linear) {
  return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z;
}

glm::dvec3 xyzFromLinear(const glm::dvec3& linear) {
  static const glm::dmat3 kMatrix = primariesToXyz();
  return kMatrix * linear;
}

glm::dvec3 linearFromXyz(const glm::dvec3& xyz) {
  static const glm::dmat3 kMatrix = glm::inverse(primariesToXyz());
  return kMatrix * xyz;
}

Lab labFromXyz(const glm::dvec3& xyz) {
  const glm::dvec3 ratio = xyz / kWhiteXyz;
  const double x = labCurve(ratio.x);
  const double y = labCurve(ratio.y);
  const double z = labCurve(ratio.z);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Lab labFromLinear(const glm::dvec3& linear) {
  return labFromXyz(xyzFromLinear(linear));
}

Lab labFromSrgb(const glm::dvec3& encoded) {
  const auto decode = [](double value) {
    const double size = std::abs(value);
    return std::copysign(size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4), value);
  };
  return labFromLinear({decode(encoded.x), decode(encoded.y), decode(encoded.z)});
}

}  // namespace sward::image
