#include "image/colour.h"
#include "render/renderer.h"

#include <algorithm>

namespace sward::render {
namespace {

/// Stephen Hill's fit of the ACES reference rendering and sRGB output transforms (BakingLab, 2016): into a working
/// space, a rational curve that stands for both tone scales, and back to Rec. 709.
glm::vec3 filmic(const glm::vec3& linear) {
  // glm matrices are column by column.
  static const glm::mat3 kIn{0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f};
  static const glm::mat3 kOut{1.60475f,  -0.10208f, -0.00327f, -0.53108f, 1.10813f,
                              -0.07276f, -0.07367f, -0.00605f, 1.07602f};
  // The fit's mid-grey comes out low by about this factor against the plain sRGB rendering of the same exposure.
  constexpr float kExposureMatch = 1.0f / 0.6f;
  const glm::vec3 v = kIn * (linear * kExposureMatch);
  const glm::vec3 a = v * (v + 0.0245786f) - 0.000090537f;
  const glm::vec3 b = v * (0.983729f * v + 0.4329510f) + 0.238081f;
  return kOut * (a / b);
}

}  // namespace

image::Image toDisplay(const image::Image& linear, ViewTransform transform) {
  image::Image out = linear;
  for (std::size_t i = 0; i + 2 < out.pixels.size(); i += static_cast<std::size_t>(out.channels)) {
    glm::vec3 colour = glm::max(glm::vec3(out.pixels[i], out.pixels[i + 1], out.pixels[i + 2]), glm::vec3(0.0f));
    if (transform == ViewTransform::Filmic) colour = filmic(colour);
    colour = image::srgbFromLinear(glm::clamp(colour, glm::vec3(0.0f), glm::vec3(1.0f)));
    for (int c = 0; c < 3; ++c) out.pixels[i + static_cast<std::size_t>(c)] = colour[c];
  }
  return out;
}

}  // namespace sward::render
