#pragma once

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace sward::image {

/// A float image: `channels` interleaved values a pixel, rows from the top, values as the name of the variable says
/// (linear RGB unless stated; straight alpha unless stated).
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;  ///< width * height * channels

  Image() = default;
  Image(int w, int h, int c, float value = 0.0f)
      : width(w),
        height(h),
        channels(c),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * static_cast<std::size_t>(c), value) {}

  bool empty() const { return pixels.empty(); }
  std::size_t offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels);
  }
  float& at(int x, int y, int c) { return pixels[offset(x, y) + static_cast<std::size_t>(c)]; }
  float at(int x, int y, int c) const { return pixels[offset(x, y) + static_cast<std::size_t>(c)]; }
  glm::vec3 rgb(int x, int y) const {
    const float* p = pixels.data() + offset(x, y);
    return {p[0], p[1], p[2]};
  }
};

}  // namespace sward::image
