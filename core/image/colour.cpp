#include "image/colour.h"

#include <cmath>

namespace sward::image {

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

}  // namespace sward::image
