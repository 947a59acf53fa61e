#include "base/check.h"
#include "base/parallel.h"
#include "image/colour.h"
#include "render/display.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  const auto taken = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < taken; ++i) {
    c.r[i] = pixels[i * stride] * gain;
    c.g[i] = pixels[i * stride + 1] * gain;
    c.b[i] = pixels[i * stride + 2] * gain;
  }
  for (std::size_t i = taken; i < kChunk; ++i) c.r[i] = c.g[i] = c.b[i] = 0.0f;
  return c;
}

/// The colours of a scalar from 0 to 1.
class ColourScale {
 public:
  explicit ColourScale(const Legend& legend) {
    if (legend.stops.empty()) return;
    for (std::size_t i = 0; i < m_colours.size(); ++i) {
      const double at = static_cast<double>(i) / (kCells - 1);
      std::size_t next = 1;
      while (next + 1 < legend.stops.size() && legend.stops[next].at < at) ++next;
      const Legend::Stop &low = legend.stops[next - 1], &high = legend.stops[next];
      const double share = (at - low.at) / (high.at - low.at);
      for (std::size_t c = 0; c < 3; ++c)
        m_colours[i][c] = static_cast<float>(low.colour[c] + share * (high.colour[c] - low.colour[c]));
    }
  }
  /// sRGB times 255; a value that is not a number counts as 0.
  const std::array<float, 3>& operator()(float value) const {
    const float kept = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    return m_colours[static_cast<std::size_t>(kept * (kCells - 1) + 0.5f)];
  }

 private:
  static constexpr std::size_t kCells = 4096;
  std::array<std::array<float, 3>, kCells> m_colours{};
};

constexpr float kLeastGround = 1e-4f;  ///< of a pixel that is shown as ground at all

/// `share` of a colour over the backdrop, in display values: sums of sample weights may miss 1 by a rounding.
void writeOver(const std::array<float, 3>& colour, float share, const ByteColour& behind, std::uint8_t* to) {
  const float kept = share < 0.9999f ? share : 1.0f;
  for (std::size_t c = 0; c < 3; ++c) {
    const float backdrop = behind[c];
    to[c] = static_cast<std::uint8_t>(backdrop + kept * (colour[c] - backdrop) + 0.5f);
  }
  to[3] = 255;
}

void writeScalars(const float* from, int count, float gain, const ColourScale& scale, const ByteColour& backdrop,
                  std::uint8_t* to) {
  for (int i = 0; i < count; ++i, from += 4, to += 4) {
    const float share = from[3] * gain;
    const bool ground = share > kLeastGround;
    writeOver(scale(ground ? from[0] / from[3] : 0.0f), ground ? share : 0.0f, backdrop, to);
  }
}

/// Colours through the view transform; with a backdrop: divided by their alpha, and laid over it by alpha.
void writeColours(const float* from, int count, float gain, ViewTransform transform, std::uint8_t* to,
                  const ByteColour* backdrop = nullptr) {
  const image::SrgbBytes& byte = image::srgbBytes();
  Chunk c = gather(from, count, 4, gain);
  if (backdrop != nullptr) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const float inverse = 1.0f / std::max(from[4 * i + 3] * gain, kLeastGround);
      c.r[i] *= inverse;
      c.g[i] *= inverse;
      c.b[i] *= inverse;
    }
  }
  transformChunk(c, transform);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i, to += 4) {
    to[0] = byte(c.r[i]);
    to[1] = byte(c.g[i]);
    to[2] = byte(c.b[i]);
    to[3] = 255;
    if (backdrop == nullptr) continue;
    const float share = from[4 * i + 3] * gain;
    writeOver({static_cast<float>(to[0]), static_cast<float>(to[1]), static_cast<float>(to[2])},
              share > kLeastGround ? share : 0.0f, *backdrop, to);
  }
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

double displayNoise(const image::Image& mean, const image::Image& variance, ViewTransform transform) {
  if (mean.empty()) return 0.0;
  image::Image above = mean, below = mean;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    const float deviation = std::sqrt(std::max(variance.pixels[i], 0.0f));
    above.pixels[i] += deviation;
    below.pixels[i] = std::max(below.pixels[i] - deviation, 0.0f);
  }
  above = toDisplay(above, transform);
  below = toDisplay(below, transform);
  double sum = 0.0;
  for (std::size_t i = 0; i < above.pixels.size(); ++i) {
    const double half = 0.5 * static_cast<double>(above.pixels[i] - below.pixels[i]);
    sum += half * half;
  }
  return std::sqrt(sum / static_cast<double>(above.pixels.size()));
}

void toDisplayBytes(std::span<const float> rgba, float gain, const DisplayLook& look, Columns columns,
                    image::ByteImage& out) {
  constexpr std::size_t kRows = 16;
  const auto width = static_cast<std::size_t>(out.width), height = static_cast<std::size_t>(out.height);
  SWARD_CHECK_EQ(rgba.size(), width * height * 4);
  SWARD_CHECK(columns.begin >= 0 && columns.begin <= columns.end && columns.end <= out.width);
  out.rgba.resize(rgba.size());
  const ColourScale scale(look.legend);
  const ByteColour backdrop = backdropOf(look.mode);
  base::parallelFor({}, height, kRows, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      const float* row = rgba.data() + (height - 1 - y) * width * 4;
      for (int x = columns.begin; x < columns.end; x += kChunk) {
        const int taken = std::min(kChunk, columns.end - x);
        const float* from = row + static_cast<std::size_t>(x) * 4;
        std::uint8_t* to = out.rgba.data() + (y * width + static_cast<std::size_t>(x)) * 4;
        if (look.mode.plain()) {
          writeColours(from, taken, gain, look.transform, to);
        } else if (look.mode.scalar()) {
          writeScalars(from, taken, gain, scale, backdrop, to);
        } else {
          // The picture itself keeps its look also layer by layer.
          const bool shaded = look.mode.quantity == ViewQuantity::Shaded;
          writeColours(from, taken, gain, shaded ? look.transform : ViewTransform::Standard, to, &backdrop);
        }
      }
    }
  });
}

}  // namespace sward::render
