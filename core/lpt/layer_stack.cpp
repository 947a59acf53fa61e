#include "lpt/layer_stack.h"

#include "base/check.h"
#include "base/parallel.h"
#include "image/pull_push.h"
#include "lpt/polynomial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::lpt {
namespace {

std::size_t product(int a, int b, int c) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

void checkInput(const LayerStackInput& in) {
  SWARD_CHECK(in.width >= 0 && in.height >= 0 && in.images >= 0 && in.layers >= 1 && in.channels >= 1);
  const std::size_t columns = product(in.width, in.height, in.images);
  const std::size_t texels = columns * static_cast<std::size_t>(in.layers);
  SWARD_CHECK_GT(stackCoefficients(in.basis), 0);
  const std::size_t sets =
      (in.basis == Basis::Lpt ? columns : texels) * static_cast<std::size_t>(stackCoefficients(in.basis));
  SWARD_CHECK_EQ(in.coefficients.size(), sets * static_cast<std::size_t>(in.channels));
  SWARD_CHECK_EQ(in.coverage.size(), texels);
  SWARD_CHECK_EQ(in.reflectance.size(), texels);
  SWARD_CHECK(in.transmittance.empty() || in.transmittance.size() == texels);
  SWARD_CHECK_EQ(in.sky.size(), texels);
  SWARD_CHECK(in.common.empty() || (in.basis == Basis::Lpt && in.common.fits(in.layers, in.channels)));
}

std::uint8_t unorm8(float value) {
  // Written so that a NaN becomes 0.
  const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
  return static_cast<std::uint8_t>(std::floor(clamped * 255.0f + 0.5f));
}
std::uint8_t encodedColour(float linear) {
  return unorm8(linear > 0.0f ? std::sqrt(linear) : 0.0f);
}
float finiteOr0(float value) {
  return std::isfinite(value) ? value : 0.0f;
}

/// Colours and sky of one layer image, filled where nothing covers it: [texel]{reflectance, transmittance, sky}.
class SurfaceImage {
 public:
  static constexpr std::size_t kValues = 8;

  SurfaceImage(const LayerStackInput& in, std::size_t layerImage, bool periodic) : m_in(in) {
    m_pixels = static_cast<std::size_t>(in.width) * static_cast<std::size_t>(in.height);
    m_first = layerImage * m_pixels;
    m_values.assign(m_pixels * kValues, 0.0f);
    m_coverage.assign(m_pixels, 0.0f);
    for (std::size_t p = 0; p < m_pixels; ++p) gather(p);
    image::pullPush(m_values, m_coverage, in.width, in.height, static_cast<int>(kValues), periodic);
  }

  void write(LayerStack& stack) const {
    for (std::size_t p = 0; p < m_pixels; ++p) {
      const float* v = &m_values[p * kValues];
      const std::size_t texel = m_first + p;
      for (std::size_t c = 0; c < 3; ++c) stack.surface[texel * 4 + c] = encodedColour(v[c]);
      stack.surface[texel * 4 + 3] = unorm8(m_coverage[p]);
      for (std::size_t c = 0; c < 3 && !stack.transmission.empty(); ++c) {
        stack.transmission[texel * 4 + c] = encodedColour(v[3 + c]);
      }
      stack.sky[texel * 2] = unorm8(v[6]);
      stack.sky[texel * 2 + 1] = unorm8(v[7]);
    }
  }

 private:
  void gather(std::size_t p) {
    const std::size_t texel = m_first + p;
    const float alpha = finiteOr0(m_in.coverage[texel]);
    if (!(alpha > 0.0f)) return;
    m_coverage[p] = alpha;
    float* v = &m_values[p * kValues];
    for (int c = 0; c < 3; ++c) {
      v[c] = finiteOr0(m_in.reflectance[texel][c]);
      if (!m_in.transmittance.empty()) v[3 + c] = finiteOr0(m_in.transmittance[texel][c]);
    }
    v[6] = finiteOr0(m_in.sky[texel].x);
    v[7] = finiteOr0(m_in.sky[texel].y);
  }

  const LayerStackInput& m_in;
  std::size_t m_pixels = 0, m_first = 0;
  std::vector<float> m_values, m_coverage;
};

}  // namespace

LayerStack quantise(const LayerStackInput& input, const FitOptions& options, bool periodic, const JobContext& job) {
  checkInput(input);
  LayerStack stack;
  stack.basis = input.basis;
  stack.width = input.width;
  stack.height = input.height;
  stack.images = input.images;
  stack.layers = input.layers;
  stack.channels = input.channels;
  stack.bits = options.bits;
  stack.common = input.common;
  QuantisedSets sets = quantiseSets(
      input.coefficients, static_cast<std::size_t>(input.channels) * static_cast<std::size_t>(stack.perColumn()),
      options, job);
  stack.ranges = std::move(sets.ranges);
  stack.coefficients = std::move(sets.bytes);
  stack.surface.assign(stack.texelCount() * 4, 0);
  if (!input.transmittance.empty()) stack.transmission.assign(stack.texelCount() * 4, 255);
  stack.sky.assign(stack.texelCount() * 2, 0);
  if (stack.texelCount() == 0) return stack;
  const std::size_t layerImages = static_cast<std::size_t>(input.images) * static_cast<std::size_t>(input.layers);
  base::parallelFor(job, layerImages, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) SurfaceImage(input, i, periodic).write(stack);
  });
  return stack;
}

void dequantise(const LayerStack& stack, std::size_t columnOrTexel, int channel, std::span<float> out) {
  const auto count = static_cast<std::size_t>(stack.perColumn());
  SWARD_CHECK_EQ(out.size(), count);
  SWARD_CHECK(channel >= 0 && channel < stack.channels);
  const auto c = static_cast<std::size_t>(channel);
  const std::size_t first = (columnOrTexel * static_cast<std::size_t>(stack.channels) + c) * count;
  const std::size_t bytes = stack.bits == 8 ? 1 : 2;
  SWARD_CHECK_LE((first + count) * bytes, stack.coefficients.size());
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint8_t* stored = &stack.coefficients[(first + j) * bytes];
    const std::uint32_t q = bytes == 1 ? stored[0] : stored[0] + 256u * stored[1];
    out[j] = stack.ranges[c * count + j].value(q);
  }
}

namespace {

float unit(std::uint8_t byte) {
  return static_cast<float>(byte) / 255.0f;
}

/// Features of a texel as stored.
TexelFeatures featuresOf(const LayerStack& stack, std::size_t texel, int layer) {
  const std::size_t pixels = static_cast<std::size_t>(stack.width) * static_cast<std::size_t>(stack.height);
  const std::size_t top = texel - static_cast<std::size_t>(layer) * pixels;
  ColumnFeatures column;
  TexelFeatures features{};
  for (std::size_t at = top; at <= texel; at += pixels) {
    features = column.next(unit(stack.sky[at * 2]), unit(stack.sky[at * 2 + 1]), unit(stack.surface[at * 4 + 3]));
  }
  return features;
}

float onCommonResponse(const LayerStack& stack, const std::array<float, kLptCoefficients>& b, std::size_t texel,
                       int layer, int channel, float lx, float ly) {
  const TexelFeatures features = featuresOf(stack, texel, layer);
  const CommonAtLight common(stack.common, glm::dvec3(static_cast<double>(lx), static_cast<double>(ly), 0.0), layer);
  const float a = 2.0f * (lx * b[6] + ly * b[7]) + b[9];
  const float slope = 2.0f * (b[4] * lx + b[5] * ly + b[8]);
  const float square = 2.0f * (b[0] * lx + b[1] * ly) + b[2];
  const float g = common.coordinate(layer, channel, features);
  return std::max(a + g * (slope + g * square) + common.response(layer, channel, features), 0.0f);
}

/// max(f, 0) of one channel, in the order that the header gives.
float response(const LayerStack& stack, std::size_t column, std::size_t texel, int layer, int channel, float lx,
               float ly) {
  if (stack.basis == Basis::Constant) {
    std::array<float, 1> b;
    dequantise(stack, texel, channel, b);
    return std::max(b[0], 0.0f);
  }
  if (stack.basis == Basis::Ptm) {
    std::array<float, kPtmCoefficients> b;
    dequantise(stack, texel, channel, b);
    const float f = lx * (b[0] * lx + 2.0f * (b[2] * ly + b[3])) + ly * (b[1] * ly + 2.0f * b[4]) + b[5];
    return std::max(f, 0.0f);
  }
  std::array<float, kLptCoefficients> b;
  dequantise(stack, column, channel, b);
  if (!stack.common.empty()) return onCommonResponse(stack, b, texel, layer, channel, lx, ly);
  const float a = lx * (b[0] * lx + 2.0f * (b[3] * ly + b[6])) + ly * (b[1] * ly + 2.0f * b[7]) + b[9];
  const float slope = 2.0f * (b[4] * lx + b[5] * ly + b[8]);
  const float u = static_cast<float>(layer) / static_cast<float>(stack.layers);
  return std::max(a + u * (slope + u * b[2]), 0.0f);
}

float decodedColour(std::uint8_t byte) {
  const float root = static_cast<float>(byte) / 255.0f;
  return root * root;
}

}  // namespace

glm::vec4 relitTexel(const LayerStack& stack, int image, int layer, int x, int y, const Illumination& light) {
  SWARD_CHECK(image >= 0 && image < stack.images && layer >= 0 && layer < stack.layers);
  SWARD_CHECK(x >= 0 && x < stack.width && y >= 0 && y < stack.height);
  const std::size_t pixels = static_cast<std::size_t>(stack.width) * static_cast<std::size_t>(stack.height);
  const std::size_t pixel =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(stack.width) + static_cast<std::size_t>(x);
  const std::size_t column = static_cast<std::size_t>(image) * pixels + pixel;
  const std::size_t texel =
      (static_cast<std::size_t>(image) * static_cast<std::size_t>(stack.layers) + static_cast<std::size_t>(layer)) *
          pixels +
      pixel;
  const auto lx = static_cast<float>(light.sunDirection.x), ly = static_cast<float>(light.sunDirection.y);
  const bool sun = light.sunDirection.z >= 0.0;
  const bool transmits = stack.channels > kTransmitted && !stack.transmission.empty();
  const float reflected = sun ? response(stack, column, texel, layer, kReflected, lx, ly) : 0.0f;
  const float transmitted = sun && transmits ? response(stack, column, texel, layer, kTransmitted, lx, ly) : 0.0f;
  const float skyReflected = static_cast<float>(stack.sky[texel * 2]) / 255.0f;
  const float skyTransmitted = static_cast<float>(stack.sky[texel * 2 + 1]) / 255.0f;
  glm::vec4 out(0.0f, 0.0f, 0.0f, static_cast<float>(stack.surface[texel * 4 + 3]) / 255.0f);
  for (int c = 0; c < 3; ++c) {
    const std::size_t at = texel * 4 + static_cast<std::size_t>(c);
    const float r = decodedColour(stack.surface[at]);
    const float t = stack.transmission.empty() ? 0.0f : decodedColour(stack.transmission[at]);
    const auto irradiance = static_cast<float>(light.sunIrradiance[c]);
    const auto radiance = static_cast<float>(light.skyRadiance[c]);
    out[c] = (r * reflected + t * transmitted) * irradiance / std::numbers::pi_v<float> +
             (r * skyReflected + t * skyTransmitted) * radiance;
  }
  return out;
}

}  // namespace sward::lpt
