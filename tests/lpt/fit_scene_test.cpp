#include "samples.h"

#include <string>

#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

constexpr int kSide = 64, kLayers = 16;

/// A smooth periodic field in about [-1, 1], its own for each seed.
double field(double x, double y, std::uint64_t seed) {
  base::Random random(seed);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double fx = 1.0 + random.index(3), fy = 1.0 + random.index(3),
                 phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    sum += std::sin(2.0 * std::numbers::pi * (fx * x + (i % 2 == 0 ? fy : -fy) * y) / kSide + phase);
  }
  return 0.5 * sum;
}

/// Like the trial's grass: blades cover patches of a layer, so that many pixseries have one or two layers; a light is
/// seen above a horizon that rises with depth on one side; soft edges and noise.
Scene grassLikeScene(std::uint64_t seed) {
  Scene scene;
  scene.layers = kLayers;
  base::Random noise(seed);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      std::vector<int> occupied;
      for (int i = 0; i < kLayers; ++i) {
        if (field(x, y, base::mix64(seed, 1, static_cast<std::uint64_t>(i))) > 0.72) occupied.push_back(i);
      }
      const double tilt = 0.6 + 0.5 * field(x, y, base::mix64(seed, 2)), turn = 2.0 * field(x, y, base::mix64(seed, 3));
      const glm::dvec3 normal(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
      const double side = 3.0 * field(x, y, base::mix64(seed, 4));
      addColumn(scene, occupied, [&](int, int layer, const glm::dvec3& l) {
        const double toward = l.x * std::cos(side) + l.y * std::sin(side);
        const double own = field(x, y, base::mix64(seed, 5, static_cast<std::uint64_t>(layer)));
        const double horizon = 0.25 + 0.25 * layer / kLayers + 0.5 * toward + 0.35 * own;
        const double lit = 1.0 / (1.0 + std::exp(-(l.z - horizon) / 0.04));
        return std::max(lit * std::abs(glm::dot(normal, l)) + noise.uniform(-0.03, 0.03), 0.0);
      });
    }
  }
  for (float& d : scene.visibility) d = static_cast<float>(noise.uniform(0.05, 0.6));
  return scene;
}

/// Sample of a layer of a column, or -1 where the layer is not occupied.
double sampleAt(const Scene& scene, int column, int layer, std::size_t light) {
  const auto at = static_cast<std::size_t>(column);
  for (std::size_t t = scene.columnStart[at]; t < scene.columnStart[at + 1]; ++t) {
    if (scene.layer[t] == layer) return scene.sample(0, light, t);
  }
  return -1.0;
}

struct Errors {
  double on = 0.0, between = 0.0, largest = 0.0;
};

/// RMSE at texels, and half-way between neighbours in x, where a filter draws the mean of both polynomials at each
/// layer that either of them shows; the truth there is the mean of the samples that exist.
Errors measure(const Scene& scene, const Fit& fit) {
  Errors e;
  double on = 0.0, between = 0.0, countOn = 0.0, countBetween = 0.0;
  for (int c = 0; c < scene.columns; ++c) {
    const int next = c % kSide == kSide - 1 ? c - kSide + 1 : c + 1;
    if (fit.path[static_cast<std::size_t>(c)] == FitPath::Empty) continue;
    e.largest = std::max(e.largest, largestCoefficient(fit.column(c, 0)));
    for (int layer = 0; layer < kLayers; ++layer) {
      for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        const double here = sampleAt(scene, c, layer, k), there = sampleAt(scene, next, layer, k);
        const double u = static_cast<double>(layer) / kLayers;
        const double f = predicted(fit, c, 0, scene.lights[k], u);
        if (here >= 0.0) {
          on += (f - here) * (f - here);
          ++countOn;
        }
        if ((here < 0.0 && there < 0.0) || fit.path[static_cast<std::size_t>(next)] == FitPath::Empty) continue;
        const double truth = here < 0.0 ? there : there < 0.0 ? here : 0.5 * (here + there);
        const double d = 0.5 * (f + predicted(fit, next, 0, scene.lights[k], u)) - truth;
        between += d * d;
        ++countBetween;
      }
    }
  }
  e.on = std::sqrt(on / countOn);
  e.between = std::sqrt(between / countBetween);
  return e;
}

TEST(FitScene, RegularisedFitsHoldBetweenTexelsAndThePapersDoNot) {
  for (const std::uint64_t seed : {31u, 32u, 33u}) {
    const Scene scene = grassLikeScene(seed);
    int thin = 0, occupied = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(scene.columns); ++c) {
      const auto layers = scene.columnStart[c + 1] - scene.columnStart[c];
      thin += layers == 1 || layers == 2 ? 1 : 0;
      occupied += layers > 0 ? 1 : 0;
    }
    // The scene is of the trial's kind: there are many thin pixseries, and the response is no polynomial.
    EXPECT_GT(thin, 0.25 * occupied);
    const Errors regularised = measure(scene, fitted(scene));
    const Errors paper = measure(scene, fitted(scene, {.paper = true}));
    SCOPED_TRACE("on, between, largest b: " + std::to_string(regularised.on) + ' ' +
                 std::to_string(regularised.between) + ' ' + std::to_string(regularised.largest) + ", paper " +
                 std::to_string(paper.on) + ' ' + std::to_string(paper.between) + ' ' + std::to_string(paper.largest));
    EXPECT_GT(regularised.on, 0.03);
    EXPECT_LE(regularised.between, 1.05 * regularised.on);
    EXPECT_LT(regularised.largest, 3.0);
    EXPECT_LE(regularised.on, 1.1 * paper.on);
    EXPECT_GT(paper.between, 1.15 * regularised.between);
    EXPECT_GT(paper.largest, 5.0 * regularised.largest);
  }
}

}  // namespace
}  // namespace sward::lpt::test
