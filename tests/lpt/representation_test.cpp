#include "base/check.h"
#include "lpt/hemispherical_harmonics.h"
#include "lpt/layer_stack.h"
#include "representation_help.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

std::vector<std::vector<float>> relit(const Representation& r, const Scene& scene, const glm::dvec3& light,
                                      int threads = 0) {
  std::vector<std::vector<float>> values(static_cast<std::size_t>(scene.channels),
                                         std::vector<float>(scene.layer.size()));
  std::vector<std::span<float>> out(values.begin(), values.end());
  JobContext job;
  job.threads = threads;
  EXPECT_TRUE(r.relight(light, out, job).ok());
  return values;
}

/// The methods that need no density, with the name of each.
struct Case {
  std::string_view name;
  FitOptions options;
};
std::vector<Case> allCases() {
  std::vector<Case> cases;
  for (const Method& method : kMethods) {
    if (method.basis != Basis::Marched) cases.push_back({method.name, method.options({})});
  }
  return cases;
}

TEST(Representation, LptAndPtmAreTheFitQuantised) {
  const Scene scene = randomScene(60, 8, 15, 2, 51);
  for (const Basis basis : {Basis::Lpt, Basis::Ptm}) {
    for (const int bits : {8, 16}) {
      const FitOptions options{.basis = basis, .bits = bits, .clampQuantile = 0.01};
      Fit fit = fitted(scene, options);
      fillEmpty(fit, scene.columns, 1, true);
      LayerStackInput in;
      in.basis = basis;
      in.width = scene.columns, in.height = 1, in.layers = scene.layers;
      const std::size_t texels = static_cast<std::size_t>(scene.columns) * 8;
      in.coverage.assign(texels, 1.0f), in.reflectance.assign(texels, {}), in.sky.assign(texels, {});
      const std::size_t sets = basis == Basis::Lpt ? texels / 8 : texels, count = basis == Basis::Lpt ? 10 : 6;
      for (std::size_t s = 0; s < sets; ++s) {
        // A stack's texels lie layer by layer.
        const auto columns = static_cast<std::size_t>(scene.columns);
        const auto column = static_cast<int>(basis == Basis::Lpt ? s : s % columns);
        const std::size_t layer = basis == Basis::Lpt ? 0 : s / columns;
        for (int c = 0; c < 2; ++c) {
          const auto values = fit.column(column, c).subspan(layer * count, count);
          in.coefficients.insert(in.coefficients.end(), values.begin(), values.end());
        }
      }
      const LayerStack stack = quantise(in, options, true, {});
      const Pointer floats = represented(scene, options), stored = represented(scene, options, true);
      EXPECT_EQ(stored->lightingBytes(), stack.lightingBytes());
      EXPECT_EQ(floats->lightingBytes(), in.coefficients.size() * sizeof(float));
      for (int column = 0; column < scene.columns; ++column) {
        for (int layer = 0; layer < 8; ++layer) {
          const auto set = static_cast<std::size_t>(basis == Basis::Lpt ? column : layer * scene.columns + column);
          for (int c = 0; c < 2; ++c) {
            std::vector<float> b(count);
            dequantise(stack, set, c, b);
            const auto value = [&](std::span<const float> v) {
              return basis == Basis::Lpt ? evaluateLpt(v.first<10>(), kSun.x, kSun.y, layer / 8.0)
                                         : evaluatePtm(v.first<6>(), kSun.x, kSun.y);
            };
            ASSERT_DOUBLE_EQ(stored->evaluate(column, layer, c, kSun), value(b));
            const std::size_t at = basis == Basis::Lpt ? 0 : static_cast<std::size_t>(layer) * 6;
            ASSERT_DOUBLE_EQ(floats->evaluate(column, layer, c, kSun), value(fit.column(column, c).subspan(at)));
          }
        }
      }
    }
  }
}

TEST(Representation, OneLayerLptEqualsPtm) {
  const Scene scene = randomScene(80, 1, 15, 2, 52);
  const Pointer lpt = represented(scene, {}), ptm = represented(scene, {.basis = Basis::Ptm});
  for (int column = 0; column < scene.columns; ++column) {
    for (int c = 0; c < 2; ++c) {
      // Coefficients of some units, rounded to float.
      ASSERT_NEAR(lpt->evaluate(column, 0, c, kSun), ptm->evaluate(column, 0, c, kSun), 1e-5);
    }
  }
}

TEST(Representation, RelightEqualsEvaluateAtTheSamples) {
  const Scene scene = randomScene(300, 16, 15, 2, 53);
  for (const Case& one : allCases()) {
    for (const bool quantised : {false, true}) {
      SCOPED_TRACE(one.name);
      const Pointer r = represented(scene, one.options, quantised);
      const auto values = relit(*r, scene, kSun);
      double largest = 0.0;
      for (std::size_t t = 0; t < scene.layer.size(); ++t) {
        for (int c = 0; c < 2; ++c) {
          const double expected = r->evaluate(columnOf(scene, t), scene.layer[t], c, kSun);
          // At most 25 roundings of float (ten products, sums and constants), each of a partial sum that stays under
          // 100 on samples in [0, 1].
          ASSERT_NEAR(static_cast<double>(values[static_cast<std::size_t>(c)][t]), expected,
                      25.0 * 100.0 * std::numeric_limits<float>::epsilon());
          largest = std::max(largest, std::abs(expected));
        }
      }
      EXPECT_GT(largest, 0.3);
      EXPECT_LT(largest, 30.0);
    }
  }
}

/// The bound on |quantised - float| at a light: half a step of every coefficient times its function, where a step is
/// the range of the coefficient over all sets divided by 255, and the roundings of float in scale and base.
TEST(Representation, QuantisationErsByHalfAStepTimesTheFunctions) {
  const Scene scene = randomScene(200, 8, 15, 2, 54);
  for (const int bits : {8, 16}) {
    FitOptions options{.bits = bits};
    const Fit fit = fitted(scene, options);
    const Pointer floats = represented(scene, options), stored = represented(scene, options, true);
    const double steps = bits == 8 ? 255.0 : 65535.0;
    for (int c = 0; c < 2; ++c) {
      std::array<double, 10> low, high;
      low.fill(1e9), high.fill(-1e9);
      for (int column = 0; column < scene.columns; ++column) {
        for (std::size_t j = 0; j < 10; ++j) {
          low[j] = std::min(low[j], static_cast<double>(fit.column(column, c)[j]));
          high[j] = std::max(high[j], static_cast<double>(fit.column(column, c)[j]));
        }
      }
      double used = 0.0;
      for (int column = 0; column < scene.columns; ++column) {
        for (int layer = 0; layer < 8; ++layer) {
          const auto phi = lptBasis(kSun.x, kSun.y, layer / 8.0);
          double bound = 0.0;
          for (std::size_t j = 0; j < 10; ++j) {
            const double magnitude = std::max(std::abs(low[j]), std::abs(high[j]));
            bound += std::abs(phi[j]) *
                     (0.5 * (high[j] - low[j]) / steps + 8.0 * std::numeric_limits<float>::epsilon() * magnitude);
          }
          const double difference =
              std::abs(stored->evaluate(column, layer, c, kSun) - floats->evaluate(column, layer, c, kSun));
          ASSERT_LE(difference, bound);
          used = std::max(used, difference / bound);
        }
      }
      EXPECT_GT(used, 0.3);  // the bound is not idle
    }
  }
}

TEST(Representation, LightingBytesAreThoseOfDenseTextures) {
  const Scene scene = randomScene(48, 8, 15, 2, 55);
  const std::uint64_t columns = 48 * 2, texels = columns * 8;
  const auto bytes = [&](std::string_view name) {
    return represented(scene, findMethod(name)->options({}), true)->lightingBytes();
  };
  EXPECT_EQ(bytes("constant"), texels);
  EXPECT_EQ(bytes("ptm8"), texels * 6);
  EXPECT_EQ(bytes("ptm"), texels * 12);
  EXPECT_EQ(bytes("lpt_paper"), columns * 10);
  EXPECT_EQ(bytes("lpt8"), columns * 10);
  EXPECT_EQ(bytes("lpt16"), columns * 20);
  EXPECT_EQ(bytes("lpt_clustered2"), columns * 20 + 48);  // both channels share the borders
  EXPECT_EQ(bytes("lpt_clustered4"), columns * 40 + 3 * 48);
  EXPECT_EQ(bytes("hsh"), texels * 4);
}

TEST(Representation, ConstantIsTheMeanOfTheSamples) {
  Scene scene = randomScene(40, 8, 15, 2, 56);
  scene.samples[3][5] = std::numeric_limits<float>::quiet_NaN();
  const Pointer r = represented(scene, {.basis = Basis::Constant, .lightRidge = 0.5});
  for (std::size_t t = 0; t < scene.layer.size(); ++t) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t k = 0; k < 15; ++k) {
      if (std::isnan(scene.samples[3][t]) && k == 3) continue;
      sum += static_cast<double>(scene.sample(1, k, t));
      ++count;
    }
    ASSERT_NEAR(r->evaluate(columnOf(scene, t), scene.layer[t], 1, kSun), sum / count, 1e-7);
  }
}

TEST(Representation, HarmonicsAreOrthonormalOverTheHemisphere) {
  // Gauss-Legendre would do with 3 x 7 points for the products but for sqrt(1 - x^2), which appears only squared in
  // them: midpoints in z and phi converge like 1/n^2 and stay below 1e-5 here.
  constexpr int kRings = 400, kSectors = 16;
  std::array<std::array<double, 9>, 9> gram{};
  for (int i = 0; i < kRings; ++i) {
    const double z = (i + 0.5) / kRings, r = std::sqrt(1.0 - z * z);
    for (int j = 0; j < kSectors; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / kSectors;
      const auto h = hemisphericalHarmonics({r * std::cos(phi), r * std::sin(phi), z}, 3);
      ASSERT_EQ(h.size(), 9u);
      for (std::size_t a = 0; a < 9; ++a) {
        for (std::size_t b = 0; b < 9; ++b) gram[a][b] += h[a] * h[b] * 2.0 * std::numbers::pi / (kRings * kSectors);
      }
    }
  }
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = 0; b < 9; ++b) EXPECT_NEAR(gram[a][b], a == b ? 1.0 : 0.0, 5e-5) << a << ' ' << b;
  }
  const auto four = hemisphericalHarmonics(kSun, 2), nine = hemisphericalHarmonics(kSun, 3);
  EXPECT_TRUE(std::equal(four.begin(), four.end(), nine.begin()));
}

TEST(Representation, HshRecoversItsOwnFunctions) {
  Scene scene;
  scene.layers = 2;
  const std::array<double, 4> truth{0.4, -0.2, 0.3, 0.1};
  const auto response = [&](int, int layer, const glm::dvec3& l) {
    const auto h = hemisphericalHarmonics(l, 2);
    double sum = 0.0;
    for (std::size_t j = 0; j < 4; ++j) sum += (layer + 1) * truth[j] * h[j];
    return sum;
  };
  addColumn(scene, {0, 1}, response);
  const Pointer r = represented(scene, {.basis = Basis::Hsh, .lightRidge = 0.0});
  for (const int layer : {0, 1}) EXPECT_NEAR(r->evaluate(0, layer, 0, kSun), response(0, layer, kSun), 1e-6);
}

/// Weighted squared error over the samples that were fitted, by column.

TEST(Representation, SameBytesOnAnyNumberOfThreads) {
  Scene scene = randomScene(1500, 8, 15, 2, 60);
  scene.samples[4][100] = std::numeric_limits<float>::quiet_NaN();
  for (const Case& one : allCases()) {
    const auto expected = relit(*represented(scene, one.options, true, 1), scene, kSun, 1);
    for (const int threads : {2, 5}) {
      EXPECT_EQ(relit(*represented(scene, one.options, true, threads), scene, kSun, threads), expected) << one.name;
    }
  }
}

TEST(Representation, MissingSamplesLeaveOutTheirRowsOnly) {
  Scene scene = randomScene(30, 8, 15, 2, 61);
  Scene without = scene;
  for (std::size_t t = 0; t < scene.layer.size(); ++t) {
    scene.samples[7][t] = t % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  }
  without.lights.erase(without.lights.begin() + 7);
  without.samples.erase(without.samples.begin() + 22);
  without.samples.erase(without.samples.begin() + 7);
  for (const Case& one : allCases()) {
    // Groups are chosen among complete texels, of which there are none here: equal ones.
    if (one.options.basis == Basis::Clustered) continue;
    const Pointer a = represented(scene, one.options), b = represented(without, one.options);
    for (std::size_t t = 0; t < scene.layer.size(); ++t) {
      const int column = columnOf(scene, t);
      ASSERT_NEAR(a->evaluate(column, scene.layer[t], 0, kSun), b->evaluate(column, scene.layer[t], 0, kSun), 2e-5)
          << one.name;
    }
  }
}

TEST(Representation, DegenerateInputIsFinite) {
  Scene empty;
  empty.columns = 12;
  empty.layers = 4;
  empty.columnStart.assign(13, 0);
  empty.samples.resize(15);
  Scene single = randomScene(12, 4, 1, 2, 62);
  Scene missing = randomScene(12, 4, 15, 2, 63);
  for (auto& samples : missing.samples)
    std::fill(samples.begin(), samples.end(), std::numeric_limits<float>::infinity());
  Scene partly = randomScene(12, 4, 15, 2, 64);
  for (std::size_t t = 0; t < partly.layer.size(); t += 2) partly.samples[t % 30][t] = -INFINITY;
  for (const Scene* scene : {&empty, &single, &missing, &partly}) {
    for (const Case& one : allCases()) {
      for (const bool quantised : {false, true}) {
        const Pointer r = represented(*scene, one.options, quantised);
        for (int column = 0; column < 12; ++column) {
          for (int layer = 0; layer < 4; ++layer) {
            ASSERT_TRUE(std::isfinite(r->evaluate(column, layer, scene->channels - 1, kSun))) << one.name;
          }
        }
        for (const auto& channel : relit(*r, *scene, kSun)) {
          for (const float value : channel) ASSERT_TRUE(std::isfinite(value)) << one.name;
        }
      }
    }
  }
  // One light: every basis gives back its samples at that light, less the ridge's pull on all but the constant.
  const Pointer constant = represented(single, {.basis = Basis::Constant});
  EXPECT_NEAR(constant->evaluate(0, single.layer[0], 0, kSun), static_cast<double>(single.sample(0, 0, 0)), 1e-6);
}

TEST(Representation, WrongInputIsRefused) {
  Scene scene = randomScene(10, 4, 15, 1, 65);
  const trace::LayerHits hits = hitsOf(scene);
  for (const Case& one : allCases()) {
    FitOptions bad = one.options;
    bad.lightRidge = -1.0;
    EXPECT_FALSE(represent({scene.input(), &hits, nullptr}, bad, false, {}).ok()) << one.name;
    FitInput none = scene.input();
    none.lights = {};
    EXPECT_FALSE(represent({none, &hits, nullptr}, one.options, false, {}).ok()) << one.name;
    JobContext job;
    std::stop_source source;
    job.stop = source.get_token();
    source.request_stop();
    const auto stopped = represent({scene.input(), &hits, nullptr}, one.options, false, job);
    ASSERT_FALSE(stopped.ok());
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    const Pointer r = represented(scene, one.options);
    std::vector<float> tooFew(scene.layer.size() - 1);
    const std::array<std::span<float>, 1> out{tooFew};
    EXPECT_THROW(static_cast<void>(r->relight(kSun, out, {})), base::ContractError);
  }
  EXPECT_THROW(static_cast<void>(represent({scene.input(), nullptr, nullptr}, {}, false, {})), base::ContractError);
  EXPECT_THROW(static_cast<void>(fit(scene.input(), {.basis = Basis::Constant}, {})), base::ContractError);
}

TEST(Representation, MethodsAreFoundByName) {
  EXPECT_EQ(findMethod("ptm16"), findMethod("ptm"));
  EXPECT_EQ(findMethod("lpt_clustered4")->clusters, 4);
  EXPECT_EQ(findMethod("nothing"), nullptr);
  for (const Method& method : kMethods) EXPECT_EQ(findMethod(method.name), &method);
}

}  // namespace
}  // namespace sward::lpt::test
