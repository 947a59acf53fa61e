#include "lpt/layer_stack.h"

#include "base/check.h"
#include "base/random.h"
#include "lpt/polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::lpt {
namespace {

LayerStackInput makeInput(Basis basis, int channels, std::uint64_t seed) {
  LayerStackInput in;
  in.basis = basis;
  in.width = 7;
  in.height = 5;
  in.images = 2;
  in.layers = 4;
  in.channels = channels;
  const std::size_t columns = 7 * 5 * 2, texels = columns * 4, sets = basis == Basis::Lpt ? columns * 10 : texels * 6;
  base::Random random(seed);
  in.coefficients.resize(sets * static_cast<std::size_t>(channels));
  for (float& b : in.coefficients) b = static_cast<float>(random.uniform(-0.5, 1.5));
  const auto colour = [&] { return glm::vec3(random.uniform(), random.uniform(), random.uniform()); };
  for (std::size_t t = 0; t < texels; ++t) {
    in.coverage.push_back(static_cast<float>(random.uniform(0.1, 1.0)));
    in.reflectance.push_back(colour());
    if (channels == 2) in.transmittance.push_back(colour());
    in.sky.emplace_back(random.uniform(), random.uniform());
  }
  return in;
}

LayerStack quantised(const LayerStackInput& in, const FitOptions& options = {}, bool periodic = false) {
  return quantise(in, options, periodic, {});
}

/// Value j of set s and channel c of the input, and as the stack gives it back.
struct Pair {
  double original, restored;
};
Pair restore(const LayerStackInput& in, const LayerStack& stack, std::size_t set, int channel, std::size_t j) {
  std::vector<float> out(static_cast<std::size_t>(stack.perColumn()));
  dequantise(stack, set, channel, out);
  const std::size_t at =
      (set * static_cast<std::size_t>(stack.channels) + static_cast<std::size_t>(channel)) * out.size() + j;
  return {in.coefficients[at], out[j]};
}

std::size_t setCount(const LayerStack& stack) {
  return stack.basis == Basis::Lpt ? stack.columnCount() : stack.texelCount();
}

/// Half a step, and the roundings of float: of the scale (times the range) and of the two operations.
double coefficientBound(const CoefficientRange& range, int bits) {
  const double steps = bits == 8 ? 255.0 : 65535.0;
  if (range.scale == 0.0f) return 0.0;
  const double width = steps / range.scale, eps = std::numeric_limits<float>::epsilon();
  return 0.5 / range.scale + 2.0 * eps * (width + std::abs(static_cast<double>(range.base)));
}

TEST(LayerStack, QuantisationErsByHalfAStepAtMost) {
  for (const Basis basis : {Basis::Lpt, Basis::Ptm}) {
    for (const int bits : {8, 16}) {
      const LayerStackInput in = makeInput(basis, 2, 41);
      const LayerStack stack = quantised(in, {.bits = bits});
      const auto count = static_cast<std::size_t>(stack.perColumn());
      ASSERT_EQ(stack.lightingBytes(), in.coefficients.size() * static_cast<std::size_t>(bits / 8));
      double largest = 0.0;
      for (std::size_t s = 0; s < setCount(stack); ++s) {
        for (int c = 0; c < 2; ++c) {
          for (std::size_t j = 0; j < count; ++j) {
            const Pair p = restore(in, stack, s, c, j);
            const auto& range = stack.ranges[static_cast<std::size_t>(c) * count + j];
            ASSERT_LE(std::abs(p.restored - p.original), coefficientBound(range, bits));
            largest = std::max(largest, std::abs(p.restored - p.original) * range.scale);
          }
        }
      }
      EXPECT_GT(largest, 0.4);  // the bound is reached: nothing is wasted, nothing is skipped
    }
  }
}

double rms(const LayerStackInput& in, int bits) {
  const LayerStack stack = quantised(in, {.bits = bits});
  double sum = 0.0;
  for (std::size_t s = 0; s < setCount(stack); ++s) {
    for (std::size_t j = 0; j < 10; ++j) {
      const Pair p = restore(in, stack, s, 0, j);
      sum += (p.restored - p.original) * (p.restored - p.original);
    }
  }
  return std::sqrt(sum);
}

TEST(LayerStack, SixteenBitsAreTwoHundredFiftySevenTimesFiner) {
  const LayerStackInput in = makeInput(Basis::Lpt, 1, 42);
  const double ratio = rms(in, 8) / rms(in, 16);
  EXPECT_GT(ratio, 200.0);
  EXPECT_LT(ratio, 320.0);
}

TEST(LayerStack, ConstantCoefficientsAreExact) {
  LayerStackInput in = makeInput(Basis::Lpt, 1, 43);
  for (std::size_t i = 3; i < in.coefficients.size(); i += 10) in.coefficients[i] = 0.1234567f;
  for (std::size_t i = 4; i < in.coefficients.size(); i += 10) in.coefficients[i] = 0.0f;
  // A range so narrow that its scale is not a float.
  for (std::size_t i = 5; i < in.coefficients.size(); i += 10) in.coefficients[i] = i % 20 == 5 ? 1e-42f : 0.0f;
  const LayerStack stack = quantised(in);
  for (std::size_t s = 0; s < stack.columnCount(); ++s) {
    EXPECT_EQ(restore(in, stack, s, 0, 3).restored, static_cast<double>(0.1234567f));
    EXPECT_EQ(restore(in, stack, s, 0, 4).restored, 0.0);
    EXPECT_NEAR(restore(in, stack, s, 0, 5).restored, 0.0, 2e-42);
  }
  EXPECT_EQ(stack.ranges[3].scale, 0.0f);
}

TEST(LayerStack, ClampQuantileCutsOutliersOff) {
  LayerStackInput in = makeInput(Basis::Lpt, 1, 44);
  in.coefficients[0] = 1000.0f;
  in.coefficients[10] = -1000.0f;
  const LayerStack whole = quantised(in), cut = quantised(in, {.clampQuantile = 0.02});
  EXPECT_LT(whole.ranges[0].scale, 0.2f);
  EXPECT_GT(cut.ranges[0].scale, 100.0f);
  EXPECT_LT(restore(in, cut, 0, 0, 0).restored, 2.0);
  EXPECT_GT(restore(in, cut, 0, 0, 0).restored, 1.0);
  EXPECT_LT(restore(in, cut, 1, 0, 0).restored, 0.0);
  EXPECT_NEAR(restore(in, cut, 30, 0, 0).restored, restore(in, cut, 30, 0, 0).original, 0.5);
}

TEST(LayerStack, ValuesThatAreNotFiniteSpoilNothingElse) {
  LayerStackInput in = makeInput(Basis::Lpt, 1, 45);
  const LayerStack clean = quantised(in);
  in.coefficients[27] = std::numeric_limits<float>::quiet_NaN();
  in.coefficients[57] = std::numeric_limits<float>::infinity();
  in.reflectance[3].y = std::numeric_limits<float>::quiet_NaN();
  const LayerStack stack = quantised(in);
  EXPECT_LT(stack.ranges[7].scale, 1e4f);
  EXPECT_TRUE(std::isfinite(restore(in, stack, 2, 0, 7).restored));
  EXPECT_EQ(restore(in, stack, 9, 0, 4).restored, restore(in, clean, 9, 0, 4).restored);
}

TEST(LayerStack, ColoursAreSquareRootEncoded) {
  const LayerStackInput in = makeInput(Basis::Lpt, 2, 46);
  const LayerStack stack = quantised(in);
  const auto encoded = [](float v) { return static_cast<double>(std::sqrt(v)) * 255.0; };
  for (std::size_t t = 0; t < stack.texelCount(); ++t) {
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = t * 4 + static_cast<std::size_t>(c);
      ASSERT_NEAR(stack.surface[at], encoded(in.reflectance[t][c]), 0.5001);
      ASSERT_NEAR(stack.transmission[at], encoded(in.transmittance[t][c]), 0.5001);
    }
    ASSERT_NEAR(stack.surface[t * 4 + 3], in.coverage[t] * 255.0f, 0.5001);
    ASSERT_EQ(stack.transmission[t * 4 + 3], 255);
    ASSERT_NEAR(stack.sky[t * 2], in.sky[t].x * 255.0f, 0.5001);
    ASSERT_NEAR(stack.sky[t * 2 + 1], in.sky[t].y * 255.0f, 0.5001);
  }
}

/// One 8 x 1 image with a red texel at x = 0, and a second layer without any.
LayerStackInput oneCoveredTexel() {
  LayerStackInput in;
  in.width = 8;
  in.height = 1;
  in.layers = 2;
  in.channels = 1;
  in.coefficients.assign(80, 0.5f);
  in.coverage.assign(16, 0.0f);
  in.coverage[0] = 1.0f;
  in.reflectance.assign(16, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
  in.reflectance[0] = {0.64f, 0.04f, 0.0f};
  in.sky.assign(16, glm::vec2(0.0f));
  in.sky[0] = {1.0f, 0.2f};
  return in;
}

TEST(LayerStack, UncoveredTexelsTakeTheirNeighboursColour) {
  const LayerStack stack = quantised(oneCoveredTexel());
  for (std::size_t x = 0; x < 8; ++x) {
    EXPECT_EQ(stack.surface[x * 4], 204) << x;
    EXPECT_EQ(stack.surface[x * 4 + 1], 51) << x;
    EXPECT_EQ(stack.surface[x * 4 + 3], x == 0 ? 255 : 0) << x;
    EXPECT_EQ(stack.sky[x * 2], 255) << x;
    // The other layer has nothing to take.
    EXPECT_EQ(stack.surface[(8 + x) * 4], 0) << x;
    EXPECT_EQ(stack.sky[(8 + x) * 2], 0) << x;
  }
  EXPECT_TRUE(stack.transmission.empty());
}

TEST(LayerStack, FillCrossesPeriodicBordersOnly) {
  LayerStackInput in = oneCoveredTexel();
  in.coverage[4] = 1.0f;
  in.reflectance[4] = {0.0f, 0.0f, 0.64f};
  const LayerStack bordered = quantised(in, {}, false), periodic = quantised(in, {}, true);
  const auto red = [](const LayerStack& s, std::size_t x) { return s.surface[x * 4]; };
  EXPECT_GT(red(periodic, 7), red(bordered, 7) + 40);
  for (const LayerStack* stack : {&bordered, &periodic}) {
    EXPECT_EQ(red(*stack, 0), 204);
    EXPECT_EQ(red(*stack, 4), 0);
  }
}

TEST(LayerStack, SizesThatDoNotMatchAreABug) {
  LayerStackInput in = makeInput(Basis::Lpt, 1, 47);
  in.coverage.pop_back();
  EXPECT_THROW(quantised(in), base::ContractError);
  in = makeInput(Basis::Lpt, 1, 47);
  EXPECT_THROW(quantised(in, {.bits = 12}), base::ContractError);
  EXPECT_THROW(quantised(in, {.clampQuantile = 0.5}), base::ContractError);
}

/// The radiance of header's formula in double, from the input as it is, and how far quantisation may move it.
struct Expected {
  glm::dvec3 radiance{0.0}, bound{0.0};
};

Expected expectRadiance(const LayerStackInput& in, const LayerStack& stack, std::size_t column, std::size_t texel,
                        int layer, const Illumination& light) {
  const auto count = static_cast<std::size_t>(stack.perColumn());
  const double lx = light.sunDirection.x, ly = light.sunDirection.y, u = static_cast<double>(layer) / in.layers;
  double f[2] = {0.0, 0.0}, error[2] = {0.0, 0.0};
  for (std::size_t c = 0; c < static_cast<std::size_t>(in.channels); ++c) {
    for (std::size_t j = 0; j < count; ++j) {
      const double phi = in.basis == Basis::Lpt ? lptBasis(lx, ly, u)[j] : ptmBasis(lx, ly)[j];
      const std::size_t set = in.basis == Basis::Lpt ? column : texel;
      f[c] += phi * in.coefficients[(set * static_cast<std::size_t>(in.channels) + c) * count + j];
      error[c] += std::abs(phi) * coefficientBound(stack.ranges[c * count + j], stack.bits);
    }
    f[c] = std::max(f[c], 0.0);
  }
  // (sqrt(r) + h)^2 - r, and half a step of a linear byte.
  const double h = 0.5 / 255.0;
  const auto colourError = [&](double r) { return 2.0 * std::sqrt(r) * h + h * h; };
  Expected e;
  for (int c = 0; c < 3; ++c) {
    const double sun = light.sunIrradiance[c] / std::numbers::pi, sky = light.skyRadiance[c];
    const double colours[2] = {in.reflectance[texel][c], in.channels == 2 ? in.transmittance[texel][c] : 0.0f};
    const double skies[2] = {in.sky[texel].x, in.sky[texel].y};
    for (int k = 0; k < in.channels; ++k) {
      const double r = colours[k], dr = colourError(r);
      e.radiance[c] += r * f[k] * sun + r * skies[k] * sky;
      e.bound[c] += ((r + dr) * error[k] + dr * f[k]) * sun + ((r + dr) * h + dr * skies[k]) * sky;
    }
    e.bound[c] += 1e-5 * (1.0 + e.radiance[c]);  // float arithmetic: some tens of operations of 6e-8
  }
  return e;
}

TEST(LayerStack, RelitTexelEqualsDirectEvaluationWithinQuantisation) {
  Illumination light;
  light.sunDirection = glm::normalize(glm::dvec3(0.4, -0.7, 0.5));
  light.sunIrradiance = {3.0, 2.5, 2.0};
  light.skyRadiance = {0.2, 0.3, 0.5};
  for (const Basis basis : {Basis::Lpt, Basis::Ptm}) {
    for (const int channels : {1, 2}) {
      for (const int bits : {8, 16}) {
        const LayerStackInput in = makeInput(basis, channels, 48);
        const LayerStack stack = quantised(in, {.bits = bits});
        for (std::size_t t = 0; t < stack.texelCount(); ++t) {
          const int pixel = static_cast<int>(t % 35), layer = static_cast<int>(t / 35 % 4),
                    image = static_cast<int>(t / 140);
          const glm::vec4 out = relitTexel(stack, image, layer, pixel % 7, pixel / 7, light);
          const std::size_t column = static_cast<std::size_t>(image * 35 + pixel);
          const Expected e = expectRadiance(in, stack, column, t, layer, light);
          for (int c = 0; c < 3; ++c) ASSERT_NEAR(out[c], e.radiance[c], e.bound[c]);
          ASSERT_NEAR(out.w, in.coverage[t], 0.5 / 255.0 + 1e-6);
        }
      }
    }
  }
}

TEST(LayerStack, SunBelowTheHorizonLeavesTheSky) {
  const LayerStackInput in = makeInput(Basis::Lpt, 2, 49);
  const LayerStack stack = quantised(in);
  Illumination light;
  light.skyRadiance = {0.2, 0.3, 0.5};
  light.sunDirection = glm::normalize(glm::dvec3(0.3, 0.2, -0.05));
  Illumination dark = light;
  dark.sunIrradiance = glm::dvec3(0.0);
  Illumination up = light;
  up.sunDirection.z = -up.sunDirection.z;
  EXPECT_EQ(relitTexel(stack, 1, 2, 3, 4, light), relitTexel(stack, 1, 2, 3, 4, dark));
  EXPECT_NE(relitTexel(stack, 1, 2, 3, 4, light), relitTexel(stack, 1, 2, 3, 4, up));
}

TEST(LayerStack, NegativeResponsesGiveNoLight) {
  LayerStackInput in = makeInput(Basis::Lpt, 1, 50);
  for (std::size_t i = 0; i < in.coefficients.size(); ++i) in.coefficients[i] = i % 10 == 9 ? -1.0f : 0.0f;
  const glm::vec4 out = relitTexel(quantised(in), 0, 0, 0, 0, {});
  EXPECT_EQ(out.x, 0.0f);
  EXPECT_EQ(out.y, 0.0f);
}

TEST(LayerStack, SavesAndLoads) {
  for (const int bits : {8, 16}) {
    const LayerStack stack = quantised(makeInput(Basis::Ptm, 2, 51), {.bits = bits});
    base::ByteWriter out;
    save(out, stack);
    const auto data = out.take();
    base::ByteReader in(data);
    LayerStack read;
    ASSERT_TRUE(load(in, read));
    EXPECT_TRUE(in.finished());
    EXPECT_EQ(read.basis, stack.basis);
    EXPECT_EQ(read.bits, stack.bits);
    EXPECT_EQ(read.images, 2);
    EXPECT_EQ(read.coefficients, stack.coefficients);
    EXPECT_EQ(read.surface, stack.surface);
    EXPECT_EQ(read.transmission, stack.transmission);
    EXPECT_EQ(read.sky, stack.sky);
    EXPECT_EQ(relitTexel(read, 1, 3, 6, 4, {}), relitTexel(stack, 1, 3, 6, 4, {}));
  }
}

TEST(LayerStack, DamagedDataDoNotLoad) {
  const LayerStack stack = quantised(makeInput(Basis::Lpt, 2, 52));
  base::ByteWriter out;
  save(out, stack);
  const auto data = out.take();
  for (std::size_t length = 0; length < data.size(); ++length) {
    base::ByteReader in{std::span(data).first(length)};
    LayerStack read;
    read.width = 123;
    ASSERT_FALSE(load(in, read)) << length;
    ASSERT_EQ(read.width, 123);
  }
  // Every byte of the shape (basis, six integers) and of the first length, turned over.
  for (std::size_t i = 0; i < 1 + 6 * 4 + 8; ++i) {
    auto damaged = data;
    damaged[i] = ~damaged[i];
    base::ByteReader in(damaged);
    LayerStack read;
    EXPECT_FALSE(load(in, read)) << i;
  }
}

}  // namespace
}  // namespace sward::lpt
