#include "base/check.h"
#include "lpt/layer_stack.h"
#include "lpt/representation.h"
#include "samples.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

void addSky(Scene& scene, std::uint64_t seed) {
  base::Random random(seed);
  for (auto& sky : scene.sky) {
    sky.clear();
    for (std::size_t t = 0; t < scene.layer.size(); ++t) sky.push_back(static_cast<float>(random.uniform()));
  }
}
Scene skyScene(int columns, int channels, std::uint64_t seed) {
  Scene scene = randomScene(columns, 8, 15, channels, seed);
  addSky(scene, seed + 1);
  return scene;
}

std::vector<TexelFeatures> featuresOf(const Scene& scene, int column) {
  std::vector<TexelFeatures> features;
  ColumnFeatures above;
  const auto at = static_cast<std::size_t>(column);
  for (std::size_t t = scene.columnStart[at]; t < scene.columnStart[at + 1]; ++t) {
    features.push_back(above.next(scene.sky[0][t], scene.sky[1][t], scene.coverage[t]));
  }
  return features;
}

/// Makes every sample what a function of its features, layer and light says.
template <typename Function>
void setSamples(Scene& scene, const Function& function) {
  for (int column = 0; column < scene.columns; ++column) {
    const auto features = featuresOf(scene, column);
    for (std::size_t i = 0; i < features.size(); ++i) {
      const std::size_t t = scene.columnStart[static_cast<std::size_t>(column)] + i;
      for (std::size_t s = 0; s < scene.samples.size(); ++s) {
        const auto channel = static_cast<int>(s / scene.lights.size());
        scene.samples[s][t] =
            static_cast<float>(function(channel, scene.layer[t], features[i], scene.lights[s % scene.lights.size()]));
      }
    }
  }
}

double predictedOn(const Fit& fit, int column, int channel, int layer, const TexelFeatures& features,
                   const glm::dvec3& light) {
  const CommonAtLight common(fit.common, light);
  const double g = common.coordinate(layer, channel, features);
  const auto basis = responseBasis(light.x, light.y, g);
  double sum = common.response(layer, channel, features);
  for (std::size_t j = 0; j < basis.size(); ++j) sum += basis[j] * fit.column(column, channel)[j];
  return sum;
}

double rmseOf(const Scene& scene, const Fit& fit) {
  double sum = 0.0, count = 0.0;
  for (int column = 0; column < scene.columns; ++column) {
    const auto features = featuresOf(scene, column);
    for (std::size_t i = 0; i < features.size(); ++i) {
      const std::size_t t = scene.columnStart[static_cast<std::size_t>(column)] + i;
      for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        const glm::dvec3& l = scene.lights[k];
        const double f = fit.common.empty() ? predicted(fit, column, 0, l, scene.u(t))
                                            : predictedOn(fit, column, 0, scene.layer[t], features[i], l);
        sum += (f - scene.sample(0, k, t)) * (f - scene.sample(0, k, t));
        count += 1.0;
      }
    }
  }
  return std::sqrt(sum / count);
}

TEST(ResponseFit, WhatAllTexelsShareLeavesColumnsNothing) {
  Scene scene = skyScene(400, 2, 71);
  setSamples(scene, [](int channel, int, const TexelFeatures& f, const glm::dvec3& l) {
    const double side = channel == 0 ? 1.0 : -0.5;
    return 0.2 + 0.5 * f[1] + 0.1 * side * f[2] * l.x + 0.2 * f[4] * l.y * l.y - 0.1 * f[3] * l.x * l.y;
  });
  const Fit fit = fitted(scene);
  ASSERT_FALSE(fit.common.empty());
  // Normal equations of float samples (6e-8), against ridges of 1e-6 on functions whose coefficients are under 1.
  for (const float b : fit.coefficients) ASSERT_LT(std::abs(b), 1e-4f);
  EXPECT_LT(rmseOf(scene, fit), 1e-5);
}

TEST(ResponseFit, BeatsDepthWhereTheSkyTellsWhatIsLit) {
  Scene scene = skyScene(300, 1, 72);
  setSamples(scene, [](int, int, const TexelFeatures& f, const glm::dvec3& l) {
    return static_cast<double>(f[1]) * (0.4 + 0.3 * l.x) + 0.1 * f[1] * f[1] * l.y;
  });
  const double response = rmseOf(scene, fitted(scene));
  const double depth = rmseOf(scene, fitted(scene, {.coordinate = LayerCoordinate::Depth}));
  EXPECT_LT(response, 0.02);
  EXPECT_GT(depth, 5.0 * response);
}

/// What the fit minimises (FitOptions) as a function of a column's nine coefficients, in powers of g.
class Objective {
 public:
  Objective(const Scene& scene, const Fit& fit, int column, int channel, const FitOptions& options)
      : m_options(options) {
    const auto features = featuresOf(scene, column);
    for (std::size_t i = 0; i < features.size(); ++i) {
      const std::size_t t = scene.columnStart[static_cast<std::size_t>(column)] + i;
      const double w = std::max(static_cast<double>(scene.visibility[t]), 0.5 / 16) * scene.coverage[t];
      for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        const CommonAtLight common(fit.common, scene.lights[k]);
        const double g = common.coordinate(scene.layer[t], channel, features[i]);
        const double y = scene.sample(static_cast<std::size_t>(channel), k, t) -
                         static_cast<double>(common.response(scene.layer[t], channel, features[i]));
        m_rows.push_back({w, g, y, scene.lights[k]});
        m_weight += w;
        m_mean += w * g;
      }
    }
    m_mean /= m_weight;
  }

  double operator()(const std::array<double, 10>& b) const {
    double sum = 0.0;
    for (const Row& row : m_rows) {
      const auto basis = responseBasis(row.light.x, row.light.y, row.g);
      double f = -row.y;
      for (std::size_t j = 0; j < basis.size(); ++j) f += b[j] * basis[j];
      sum += row.weight * f * f;
    }
    // In powers of v = g - m: c (v + m)^2 + b (v + m) + a.
    const double m = m_mean;
    const double slope[3] = {b[4] + 2.0 * m * b[0], b[5] + 2.0 * m * b[1], b[8] + m * b[2]};
    const double light[2] = {b[6] + m * b[4] + m * m * b[0], b[7] + m * b[5] + m * m * b[1]};
    double layers = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    for (const double x : slope) layers += x * x;
    return sum / m_weight + m_options.layerRidge * layers +
           m_options.lightRidge * (light[0] * light[0] + light[1] * light[1]);
  }

 private:
  struct Row {
    double weight, g, y;
    glm::dvec3 light;
  };
  FitOptions m_options;
  std::vector<Row> m_rows;
  double m_weight = 0.0, m_mean = 0.0;
};

TEST(ResponseFit, ColumnsHaveTheLeastObjective) {
  const Scene scene = skyScene(60, 2, 73);
  const FitOptions options{.layerRidge = 0.01, .lightRidge = 0.03};
  const Fit fit = fitted(scene, options);
  for (int column = 0; column < scene.columns; ++column) {
    for (int channel = 0; channel < 2; ++channel) {
      const Objective objective(scene, fit, column, channel, options);
      std::array<double, 10> b;
      std::copy_n(fit.column(column, channel).begin(), 10, b.begin());
      EXPECT_EQ(b[3], 0.0);
      const double least = objective(b);
      for (std::size_t j = 0; j < b.size(); ++j) {
        if (j == 3) continue;
        for (const double step : {-0.01, 0.01}) {
          auto moved = b;
          moved[j] += step;
          // Float coefficients are off by 6e-8 of at most 10: second order in the objective.
          EXPECT_GE(objective(moved), least - 1e-10) << column << ' ' << channel << ' ' << j;
        }
      }
    }
  }
}

TEST(ResponseFit, CoordinatesAreMultiplesOfTheMeanResponse) {
  Scene scene = skyScene(400, 1, 74);
  setSamples(scene, [](int, int, const TexelFeatures& f, const glm::dvec3&) { return 0.3 * f[1]; });
  const Fit fit = fitted(scene);
  double sum = 0.0, weights = 0.0;
  for (std::size_t t = 0; t < scene.layer.size(); ++t) {
    const double w = std::max(static_cast<double>(scene.visibility[t]), 0.5 / 16) * scene.coverage[t];
    sum += w * scene.sky[0][t];
    weights += w;
  }
  const CommonAtLight common(fit.common, glm::dvec3(0.0, 0.0, 1.0));
  for (const float sky : {0.1f, 0.5f, 0.9f}) {
    EXPECT_NEAR(common.coordinate(3, 0, {1.0f, sky, 0.4f, 0.6f, 0.2f}), sky / (sum / weights), 1e-3);
  }
  CommonResponse bright = fit.common;
  for (float& value : bright.values) value *= 1000.0f;
  EXPECT_EQ(CommonAtLight(bright, {0.0, 0.0, 1.0}).coordinate(3, 0, {1.0f, 0.9f, 0.4f, 0.6f, 0.2f}),
            kLargestCoordinate);
}

TEST(ResponseFit, WithoutWhatItNeedsTheCoordinateIsDepth) {
  Scene scene = skyScene(50, 1, 75);
  const FitOptions depth{.coordinate = LayerCoordinate::Depth};
  const Fit expected = fitted(scene, depth);
  EXPECT_TRUE(expected.common.empty());
  Scene blind = scene;
  blind.sky = {};
  EXPECT_EQ(fitted(blind).coefficients, expected.coefficients);
  EXPECT_TRUE(fitted(scene, {.paper = true}).common.empty());
  Scene few = randomScene(20, 8, 4, 1, 76);
  addSky(few, 77);
  EXPECT_TRUE(fitted(few).common.empty());
  scene.sky[0].pop_back();
  EXPECT_FALSE(fit(scene.input(), {}, {}).ok());
}

TEST(ResponseFit, SameBytesOnAnyNumberOfThreads) {
  Scene scene = skyScene(3000, 2, 78);
  scene.samples[4][100] = std::numeric_limits<float>::quiet_NaN();
  const Fit one = fitted(scene, {}, 1);
  for (const int threads : {2, 3, 7}) {
    const Fit many = fitted(scene, {}, threads);
    EXPECT_EQ(one.coefficients, many.coefficients);
    EXPECT_EQ(one.common, many.common);
    EXPECT_EQ(one.condition, many.condition);
  }
}

TEST(ResponseFit, ATexelWithAMissingSampleIsLeftOut) {
  Scene scene = skyScene(40, 2, 79), other = scene;
  for (std::size_t t = 0; t < scene.layer.size(); t += 3) {
    scene.samples[t % 30][t] = std::numeric_limits<float>::quiet_NaN();
    other.samples[(t + 7) % 30][t] = std::numeric_limits<float>::infinity();
    other.samples[(t + 9) % 30][t] = 1e30f;
  }
  const Fit a = fitted(scene), b = fitted(other);
  EXPECT_EQ(a.coefficients, b.coefficients);
  EXPECT_EQ(a.common, b.common);
  for (const float value : a.coefficients) EXPECT_TRUE(std::isfinite(value));
}

TEST(ResponseFit, DegenerateScenesAreFinite) {
  Scene dark = skyScene(30, 2, 80);
  setSamples(dark, [](int, int, const TexelFeatures&, const glm::dvec3&) { return 0.0; });
  Scene opaque = skyScene(30, 1, 81);
  std::fill(opaque.sky[1].begin(), opaque.sky[1].end(), 0.0f);
  std::fill(opaque.coverage.begin(), opaque.coverage.end(), 1.0f);
  Scene wild = skyScene(30, 1, 82);
  wild.sky[0][3] = std::numeric_limits<float>::quiet_NaN();
  wild.sky[1][4] = -std::numeric_limits<float>::infinity();
  for (float& y : wild.samples[2]) y *= 1e20f;
  Scene one = randomScene(1, 8, 15, 1, 83);
  addSky(one, 84);
  for (const Scene* scene : {&dark, &opaque, &wild, &one}) {
    for (const FitOptions options : {FitOptions{}, FitOptions{.layerRidge = 0.0, .lightRidge = 0.0}}) {
      const Fit fit = fitted(*scene, options);
      ASSERT_TRUE(fit.common.fits(scene->layers, scene->channels));
      for (const float value : fit.coefficients) ASSERT_TRUE(std::isfinite(value));
    }
  }
}

TEST(ResponseFit, SavesAndLoads) {
  const Fit fit = fitted(skyScene(20, 2, 85));
  base::ByteWriter out;
  save(out, fit);
  const auto data = out.take();
  base::ByteReader in(data);
  Fit read;
  ASSERT_TRUE(load(in, read));
  EXPECT_EQ(read.common, fit.common);
  for (std::size_t length = 0; length < data.size(); length += 7) {
    base::ByteReader cut{std::span(data).first(length)};
    ASSERT_FALSE(load(cut, read)) << length;
  }
}

TEST(ResponseRepresentation, RelightEqualsEvaluateAndTheFit) {
  const Scene scene = skyScene(50, 2, 86);
  const Fit fit = fitted(scene);
  trace::LayerHits hits;
  hits.shape = {scene.columns, 1, scene.layers};
  const auto made = represent({scene.input(), &hits, nullptr}, {}, false, {});
  ASSERT_TRUE(made.ok());
  const Representation& r = **made;
  EXPECT_EQ(r.lightingBytes(), 50u * 2 * 10 * 4 + fit.common.bytes());
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, -0.5, 0.4));
  std::vector<float> reflected(scene.layer.size()), transmitted(scene.layer.size());
  const std::array<std::span<float>, 2> out{reflected, transmitted};
  ASSERT_TRUE(r.relight(sun, out, {}).ok());
  for (int column = 0; column < scene.columns; ++column) {
    const auto features = featuresOf(scene, column);
    for (std::size_t i = 0; i < features.size(); ++i) {
      const std::size_t t = scene.columnStart[static_cast<std::size_t>(column)] + i;
      for (int c = 0; c < 2; ++c) {
        const double expected = predictedOn(fit, column, c, scene.layer[t], features[i], sun);
        EXPECT_NEAR(out[static_cast<std::size_t>(c)][t], expected, 2e-5 * (1.0 + std::abs(expected)));
        EXPECT_NEAR(r.evaluate(column, scene.layer[t], c, sun), expected, 2e-5 * (1.0 + std::abs(expected)));
      }
    }
    for (int layer = 0; layer < scene.layers; ++layer) EXPECT_TRUE(std::isfinite(r.evaluate(column, layer, 0, sun)));
  }
}

TEST(ResponseStack, RelitTexelEqualsDirectEvaluation) {
  LayerStackInput in;
  in.width = 5;
  in.height = 3;
  in.layers = 4;
  base::Random random(87);
  const std::size_t columns = 15, texels = columns * 4;
  for (std::size_t i = 0; i < columns * 20; ++i)
    in.coefficients.push_back(static_cast<float>(random.uniform(0.0, 0.2)));
  for (std::size_t t = 0; t < texels; ++t) {
    in.coverage.push_back(static_cast<float>(random.uniform(0.1, 0.9)));
    in.reflectance.emplace_back(random.uniform(), random.uniform(), random.uniform());
    in.transmittance.emplace_back(random.uniform(), random.uniform(), random.uniform());
    in.sky.emplace_back(random.uniform(), random.uniform());
  }
  in.common.channels = 2;
  for (int i = 0; i < 4 * 2 * 35; ++i) in.common.values.push_back(static_cast<float>(random.uniform(-0.2, 0.6)));
  const LayerStack stack = quantise(in, {.bits = 16}, true, {});
  ASSERT_EQ(stack.common, in.common);
  EXPECT_EQ(stack.lightingBytes(), columns * 40 + in.common.bytes());
  Illumination light;
  light.sunDirection = glm::normalize(glm::dvec3(0.4, -0.7, 0.5));
  const CommonAtLight common(in.common, light.sunDirection);
  const auto unit = [](std::uint8_t byte) { return static_cast<double>(byte) / 255.0; };
  for (int pixel = 0; pixel < 15; ++pixel) {
    double open = 1.0;
    for (int layer = 0; layer < 4; ++layer) {
      const auto t = static_cast<std::size_t>(layer * 15 + pixel);
      const double features[5] = {1.0, unit(stack.sky[t * 2]), unit(stack.sky[t * 2 + 1]),
                                  unit(stack.surface[t * 4 + 3]), open};
      open *= 1.0 - features[3];
      double f[2] = {};
      for (std::size_t c = 0; c < 2; ++c) {
        const auto sum = [&](std::size_t first) {
          double total = 0.0;
          for (std::size_t i = 0; i < 5; ++i) {
            total += features[i] * common.weights()[(static_cast<std::size_t>(layer) * 2 + c) * 10 + first + i];
          }
          return total;
        };
        std::array<float, 10> b;
        dequantise(stack, static_cast<std::size_t>(pixel), static_cast<int>(c), b);
        const auto basis = responseBasis(light.sunDirection.x, light.sunDirection.y, std::clamp(sum(5), 0.0, 4.0));
        f[c] = sum(0);
        for (std::size_t j = 0; j < 10; ++j) f[c] += basis[j] * b[j];
        f[c] = std::max(f[c], 0.0);
      }
      const glm::vec4 out = relitTexel(stack, 0, layer, pixel % 5, pixel / 5, light);
      for (int i = 0; i < 3; ++i) {
        const auto at = t * 4 + static_cast<std::size_t>(i);
        const double r = unit(stack.surface[at]), through = unit(stack.transmission[at]);
        const double expected = (r * r * f[0] + through * through * f[1]) * light.sunIrradiance[i] / std::numbers::pi;
        EXPECT_NEAR(out[i], expected, 1e-5 * (1.0 + expected)) << pixel << ' ' << layer;
      }
    }
  }
  in.common.values.pop_back();
  EXPECT_THROW(quantise(in, {}, true, {}), base::ContractError);
}

}  // namespace
}  // namespace sward::lpt::test
