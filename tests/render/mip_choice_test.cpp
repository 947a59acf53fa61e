#include "render/fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <string>

namespace sward {
namespace {

using testing::smallOptions;

// Mips are made of relit colours, not of coefficients (science.md section 1 asks that either be weighted by coverage).
// The truth at a distance is the coverage-weighted mean of what the texels show. Relit colours average to just that but
// for their rounding; mean coefficients are lit after averaging, which cuts negative lobes off later, and multiplies
// means of colour and response instead of averaging their products. Both end in the same bytes before they are drawn,
// so both are rounded here.

struct Totals {
  double relit = 0.0, coefficients = 0.0, truth = 0.0;
  long count = 0;
};

/// A block of a layer as mips of coefficients would have it, weighted by coverage, in double.
glm::dvec3 litMeanCoefficients(const lpt::LayerStack& stack, int layer, int x0, int y0, int size,
                               const lpt::Illumination& light) {
  std::array<std::array<double, 10>, 2> mean{};
  std::array<glm::dvec3, 2> colour{glm::dvec3(0.0), glm::dvec3(0.0)};
  glm::dvec2 sky(0.0);
  double weight = 0.0;
  for (int y = y0; y < y0 + size; ++y) {
    for (int x = x0; x < x0 + size; ++x) {
      const auto column =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(stack.width) + static_cast<std::size_t>(x);
      const std::size_t texel =
          static_cast<std::size_t>(layer) * static_cast<std::size_t>(stack.width * stack.height) + column;
      const double w = stack.surface[4 * texel + 3] / 255.0;
      weight += w;
      std::array<float, 10> b{};
      for (int c = 0; c < 2; ++c) {
        lpt::dequantise(stack, column, c, b);
        const auto channel = static_cast<std::size_t>(c);
        const auto& bytes = c == 0 ? stack.surface : stack.transmission;
        for (std::size_t j = 0; j < 10; ++j) mean[channel][j] += w * static_cast<double>(b[j]);
        for (int k = 0; k < 3; ++k)
          colour[channel][k] += w * std::pow(bytes[4 * texel + static_cast<std::size_t>(k)] / 255.0, 2.0);
        sky[c] += w * stack.sky[2 * texel + channel] / 255.0;
      }
    }
  }
  if (!(weight > 0.0)) return glm::dvec3(0.0);
  const glm::dvec3 l = light.sunDirection;
  const double u = static_cast<double>(layer) / stack.layers;
  const std::array<double, 10> phi{l.x * l.x,     l.y * l.y, u * u,     2.0 * l.x * l.y, 2.0 * l.x * u,
                                   2.0 * l.y * u, 2.0 * l.x, 2.0 * l.y, 2.0 * u,         1.0};
  glm::dvec3 radiance(0.0);
  for (std::size_t c = 0; c < 2; ++c) {
    double f = 0.0;
    for (std::size_t j = 0; j < 10; ++j) f += mean[c][j] / weight * phi[j];
    radiance += colour[c] / weight *
                (std::max(f, 0.0) * light.sunIrradiance / 3.14159265358979 +
                 sky[static_cast<int>(c)] / weight * light.skyRadiance);
  }
  return radiance;
}

/// As relit texels are stored: the square root over the scale, in 8 bits.
glm::dvec3 rounded(const glm::dvec3& radiance, double scale) {
  const glm::dvec3 root = glm::round(glm::sqrt(glm::clamp(radiance / scale, 0.0, 1.0)) * 255.0) / 255.0;
  return root * root * scale;
}

void addLayer(const render::Renderer& renderer, const std::vector<glm::vec4>& relit, const bake::GroundBake& ground,
              int layer, int mip, const lpt::Illumination& light, Totals& totals) {
  const int size = 1 << mip, side = ground.tiles.resolution >> mip, apron = ground.tiles.apron;
  for (int i = 0; i < side * side; ++i) {
    const int x0 = apron + i % side * size, y0 = apron + i / side * size;
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (int k = 0; k < size * size; ++k) {
      const glm::dvec4 texel(lpt::relitTexel(ground.slices, 0, layer, x0 + k % size, y0 + k / size, light));
      sum += glm::dvec3(texel) * texel.a;
      weight += texel.a;
    }
    if (weight < 0.05 * size * size) continue;  // hardly anything to see
    const glm::dvec3 truth = sum / weight;
    const glm::dvec3 stored = glm::dvec3(relit[static_cast<std::size_t>(i)]) * renderer.relightScale();
    const glm::dvec3 lit =
        rounded(litMeanCoefficients(ground.slices, layer, x0, y0, size, light), renderer.relightScale());
    totals.relit += glm::dot(stored - truth, stored - truth);
    totals.coefficients += glm::dot(lit - truth, lit - truth);
    totals.truth += glm::dot(truth, truth);
    ++totals.count;
  }
}

TEST(MipChoice, RelitColoursAverageCloserToTheTruthThanCoefficients) {
  auto options = smallOptions();
  options.bits = 16;
  const auto ground = testing::makeGround(options);
  auto stage = testing::makeStage();
  ASSERT_TRUE(stage.renderer->setGround(ground).ok());
  for (int mip = 1; mip <= 3; ++mip) {
    Totals totals;
    for (const double azimuth : {30.0, 150.0, 270.0}) {
      const auto daylight = testing::daylightAt(azimuth, 25.0);
      stage.renderer->setDaylight(daylight);
      for (int layer = 0; layer < ground->slices.layers; ++layer) {
        const auto relit = stage.renderer->readRelitSlices(0, layer, mip);
        ASSERT_TRUE(relit.ok());
        addLayer(*stage.renderer, *relit, *ground, layer, mip, testing::illuminationOf(daylight), totals);
      }
    }
    ASSERT_GT(totals.count, 20);
    const double relit = std::sqrt(totals.relit / totals.truth);
    const double coefficients = std::sqrt(totals.coefficients / totals.truth);
    RecordProperty("relit_" + std::to_string(mip), std::to_string(relit));
    RecordProperty("coefficients_" + std::to_string(mip), std::to_string(coefficients));
    std::cout << "mip " << mip << ": relative RMS error " << relit << " of relit colours, " << coefficients
              << " of coefficients\n";
    // One level up rounding hides most of the difference; from there on it grows with the blocks.
    EXPECT_LT(relit, coefficients) << "mip " << mip;
    if (mip == 3) {
      EXPECT_LT(relit, 0.5 * coefficients);
    }
  }
}

}  // namespace
}  // namespace sward
