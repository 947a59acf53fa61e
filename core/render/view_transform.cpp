#include "base/check.h"
#include "base/parallel.h"
#include "image/colour.h"
#include "render/display.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sward::render {
namespace {

/// Pixels that are worked on together, channel by channel, so that the compiler uses vectors.
constexpr int kChunk = 64;

struct Chunk {
  std::array<float, kChunk> r, g, b;
};

/// Stephen Hill's fit of the ACES reference rendering and sRGB output transforms (BakingLab, 2016): into a working
/// space, a rational curve that stands for both tone scales, and back to Rec. 709.
void filmic(Chunk& c) {
  // The fit's mid-grey comes out low by about this factor against the plain sRGB rendering of the same exposure.
  constexpr float kExposureMatch = 1.0f / 0.6f;
  const auto curve = [](float v) {
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
  };
  for (std::size_t i = 0; i < kChunk; ++i) {
    const float r = c.r[i] * kExposureMatch, g = c.g[i] * kExposureMatch, b = c.b[i] * kExposureMatch;
    const float x = curve(0.59719f * r + 0.35458f * g + 0.04823f * b);
    const float y = curve(0.07600f * r + 0.90834f * g + 0.01566f * b);
    const float z = curve(0.02840f * r + 0.13383f * g + 0.83777f * b);
    c.r[i] = 1.60475f * x + -0.53108f * y + -0.07367f * z;
    c.g[i] = -0.10208f * x + 1.10813f * y + -0.00605f * z;
    c.b[i] = -0.00327f * x + -0.07276f * y + 1.07602f * z;
  }
}

/// Linear values to the linear values of the display, in [0, 1]; NaN stays.
void transformChunk(Chunk& c, ViewTransform transform) {
  for (auto* channel : {&c.r, &c.g, &c.b})
    for (float& v : *channel) v = v < 0.0f ? 0.0f : v;
  if (transform == ViewTransform::Filmic) filmic(c);
  for (auto* channel : {&c.r, &c.g, &c.b}) {
    for (float& v : *channel) {
      v = v < 0.0f ? 0.0f : v;
      v = v > 1.0f ? 1.0f : v;
    }
  }
}

/// Reads `count` pixels of `stride` floats each; the rest of the chunk is black.
Chunk gather(const float* pixels, int count, std::size_t stride, float gain) {
  Chunk c;
  for (std::size_t i = 0; i < kChunk; ++i) {
    const bool there = i < static_cast<std::size_t>(count);
    const float* pixel = pixels + (there ? i * stride : 0);
    c.r[i] = there ? pixel[0] * gain : 0.0f;
    c.g[i] = there ? pixel[1] * gain : 0.0f;
    c.b[i] = there ? pixel[2] * gain : 0.0f;
  }
  return c;
}

}  // namespace

image::Image toDisplay(const image::Image& linear, ViewTransform transform) {
  image::Image out = linear;
  const auto stride = static_cast<std::size_t>(linear.channels);
  SWARD_CHECK(linear.channels >= 3);
  const std::size_t count = linear.pixels.size() / stride;
  for (std::size_t first = 0; first < count; first += kChunk) {
    const auto taken = static_cast<int>(std::min<std::size_t>(kChunk, count - first));
    Chunk c = gather(linear.pixels.data() + first * stride, taken, stride, 1.0f);
    transformChunk(c, transform);
    for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
      float* pixel = out.pixels.data() + (first + i) * stride;
      pixel[0] = image::srgbFromLinear(c.r[i]);
      pixel[1] = image::srgbFromLinear(c.g[i]);
      pixel[2] = image::srgbFromLinear(c.b[i]);
    }
  }
  return out;
}

void toDisplayBytes(std::span<const float> rgba, float gain, ViewTransform transform, Columns columns,
                    image::ByteImage& out) {
  constexpr std::size_t kRows = 16;
  const auto width = static_cast<std::size_t>(out.width), height = static_cast<std::size_t>(out.height);
  SWARD_CHECK_EQ(rgba.size(), width * height * 4);
  SWARD_CHECK(columns.begin >= 0 && columns.begin <= columns.end && columns.end <= out.width);
  out.rgba.resize(rgba.size());
  const image::SrgbBytes& byte = image::srgbBytes();
  base::parallelFor({}, height, kRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const float* row = rgba.data() + (height - 1 - y) * width * 4;
      for (int x = columns.begin; x < columns.end; x += kChunk) {
        const int taken = std::min(kChunk, columns.end - x);
        Chunk c = gather(row + static_cast<std::size_t>(x) * 4, taken, 4, gain);
        transformChunk(c, transform);
        std::uint8_t* pixel = out.rgba.data() + (y * width + static_cast<std::size_t>(x)) * 4;
        for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i, pixel += 4) {
          pixel[0] = byte(c.r[i]);
          pixel[1] = byte(c.g[i]);
          pixel[2] = byte(c.b[i]);
          pixel[3] = 255;
        }
      }
    }
  });
}

}  // namespace sward::render
