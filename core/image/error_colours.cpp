#include "image/error_colours.h"

#include <algorithm>
#include <array>
#include <string>

namespace sward::image {

namespace {

const std::array<glm::vec3, 18> kMagma{{{0.0015f, 0.0005f, 0.0139f},
                                        {0.0355f, 0.0284f, 0.1252f},
                                        {0.1028f, 0.0630f, 0.2579f},
                                        {0.1915f, 0.0648f, 0.3962f},
                                        {0.2914f, 0.0646f, 0.4755f},
                                        {0.3843f, 0.0979f, 0.5010f},
                                        {0.4758f, 0.1346f, 0.5079f},
                                        {0.5692f, 0.1675f, 0.5041f},
                                        {0.6649f, 0.1981f, 0.4888f},
                                        {0.7611f, 0.2312f, 0.4602f},
                                        {0.8521f, 0.2761f, 0.4186f},
                                        {0.9259f, 0.3468f, 0.3750f},
                                        {0.9697f, 0.4469f, 0.3603f},
                                        {0.9894f, 0.5579f, 0.3917f},
                                        {0.9966f, 0.6683f, 0.4562f},
                                        {0.9967f, 0.7768f, 0.5410f},
                                        {0.9924f, 0.8843f, 0.6401f},
                                        {0.9871f, 0.9914f, 0.7495f}}};

}  // namespace

glm::vec3 errorColour(float error) {
  if (!(error > 0.0f)) return kMagma.front();
  const float position = std::min(error, 1.0f) * static_cast<float>(kMagma.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), kMagma.size() - 2);
  return glm::mix(kMagma[below], kMagma[below + 1], position - static_cast<float>(below));
}

Result<Image> colourErrors(const Image& map) {
  if (map.empty() || map.channels != 1) {
    return Error::badInput("a map of errors is empty or has " + std::to_string(map.channels) + " channels", "error map",
                           "Give a map of one channel.");
  }
  Image picture(map.width, map.height, 3);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const glm::vec3 colour = errorColour(map.pixels[i]);
    for (std::size_t c = 0; c < 3; ++c) picture.pixels[3 * i + c] = colour[static_cast<int>(c)];
  }
  return picture;
}

}  // namespace sward::image
