#include "representation_help.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

Pointer grouped(const Scene& scene, FitOptions options, detail::LayerGroups groups) {
  options.basis = Basis::Clustered;
  const trace::LayerHits hits = hitsOf(scene);
  return made(detail::representClustered({scene.input(), &hits, nullptr}, options, groups, false, {}));
}

std::vector<double> fittedErrors(const Representation& r, const Scene& scene) {
  std::vector<double> errors(static_cast<std::size_t>(scene.columns), 0.0);
  for (std::size_t t = 0; t < scene.layer.size(); ++t) {
    const double w =
        std::max(static_cast<double>(scene.visibility[t]), 0.5 / 16.0) * static_cast<double>(scene.coverage[t]);
    const int column = columnOf(scene, t);
    for (int c = 0; c < scene.channels; ++c) {
      for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        const double d = r.evaluate(column, scene.layer[t], c, scene.lights[k]) -
                         static_cast<double>(scene.sample(static_cast<std::size_t>(c), k, t));
        errors[static_cast<std::size_t>(column)] += w * d * d;
      }
    }
  }
  return errors;
}

TEST(Representation, GroupsNeverFitWorseThanOnePolynomial) {
  const Scene scene = randomScene(120, 16, 15, 2, 57);
  const FitOptions free{.layerRidge = 0.0, .lightRidge = 0.0};
  const auto whole = fittedErrors(*represented(scene, free), scene);
  for (const auto groups : {detail::LayerGroups::Equal, detail::LayerGroups::Adaptive}) {
    FitOptions two = free, four = free;
    two.clusters = 2, four.clusters = 4;
    const auto twos = fittedErrors(*grouped(scene, two, groups), scene);
    const auto fours = fittedErrors(*grouped(scene, four, groups), scene);
    double gain = 0.0;
    for (std::size_t c = 0; c < whole.size(); ++c) {
      // Equal where every layer has its own polynomial already; then coefficients of some tens, rounded to float, move
      // residuals of some tenths by some 1e-5 of themselves.
      ASSERT_LE(twos[c], whole[c] * (1.0 + 1e-4)) << c;
      ASSERT_LE(fours[c], twos[c] * (1.0 + 1e-4)) << c;
      gain += whole[c] - fours[c];
    }
    EXPECT_GT(gain, 0.0);
  }
}

/// What groups are chosen by, written out: each group's own fit, in v of its own mean, ridges included.
double objective(const Scene& scene, const FitOptions& options, int column, std::span<const std::uint16_t> start) {
  double sum = 0.0;
  for (std::size_t g = 0; g <= start.size(); ++g) {
    const int from = g == 0 ? 0 : start[g - 1], to = g == start.size() ? scene.layers : start[g];
    Scene run;
    run.layers = scene.layers, run.channels = scene.channels, run.lights = scene.lights;
    run.samples.resize(scene.samples.size());
    double weight = 0.0, mean = 0.0;
    const auto at = static_cast<std::size_t>(column);
    for (std::size_t t = scene.columnStart[at]; t < scene.columnStart[at + 1]; ++t) {
      if (scene.layer[t] < from || scene.layer[t] >= to) continue;
      run.layer.push_back(scene.layer[t]);
      run.coverage.push_back(scene.coverage[t]);
      run.visibility.push_back(scene.visibility[t]);
      for (std::size_t i = 0; i < run.samples.size(); ++i) run.samples[i].push_back(scene.samples[i][t]);
      const double w =
          std::max(static_cast<double>(scene.visibility[t]), 0.5 / 16.0) * static_cast<double>(scene.coverage[t]);
      weight += w, mean += w * scene.u(t);
    }
    if (run.layer.empty()) continue;
    mean /= weight;
    run.columns = 1;
    run.columnStart = {0, static_cast<std::uint32_t>(run.layer.size())};
    const Fit fit = fitted(run, options);
    sum += fittedErrors(*represented(run, options), run)[0] / static_cast<double>(scene.lights.size());
    for (int c = 0; c < scene.channels; ++c) {
      const auto b = fit.column(0, c);
      const auto d = [&](std::size_t j) { return static_cast<double>(b[j]); };
      const double b6 = d(6) + d(4) * mean, b7 = d(7) + d(5) * mean, b8 = d(8) + d(2) * mean;
      sum += weight * (options.layerRidge * (d(2) * d(2) + d(4) * d(4) + d(5) * d(5) + b8 * b8) +
                       options.lightRidge * (d(0) * d(0) + d(1) * d(1) + d(3) * d(3) + b6 * b6 + b7 * b7));
    }
  }
  return sum;
}

/// Responses that bend with depth, differently above and under some layer.
Scene bentScene(int columns, std::uint64_t seed) {
  Scene scene;
  base::Random random(seed);
  for (int column = 0; column < columns; ++column) {
    std::vector<int> layers;
    for (int i = 0; i < 16; ++i) {
      if (random.uniform() < 0.7) layers.push_back(i);
    }
    if (layers.empty()) layers.push_back(3);
    const double middle = random.uniform(0.2, 0.8), bend = random.uniform(-3.0, 3.0), other = random.uniform(-3.0, 3.0);
    addColumn(scene, layers, [&](int, int layer, const glm::dvec3& l) {
      const double v = layer / 16.0 - middle;
      return 0.5 + (v > 0.0 ? bend : other) * v * v + 0.2 * l.x * v + random.uniform(-0.02, 0.02);
    });
  }
  return scene;
}

TEST(Representation, AdaptiveGroupsHaveTheLeastObjective) {
  const std::array<std::pair<Scene, double>, 2> cases{
      {{randomScene(40, 16, 15, 2, 58), 0.005}, {bentScene(40, 66), 1e-5}}};
  for (const auto& [scene, ridge] : cases) {
    const FitOptions options{.layerRidge = ridge};
    const auto two = detail::bestGroups(scene.input(), options, 2, {});
    const auto four = detail::bestGroups(scene.input(), options, 4, {});
    const auto equal = detail::equalGroups(16, 4);
    int better = 0;
    for (int column = 0; column < scene.columns; ++column) {
      const auto at = static_cast<std::size_t>(column);
      double least = objective(scene, options, column, {});
      for (std::uint16_t border = 1; border < 16; ++border) {
        least = std::min(least, objective(scene, options, column, {&border, 1}));
      }
      // Coefficients of some units, rounded to float, move residuals of some hundredths by less than 1e-4 of
      // themselves.
      ASSERT_LE(objective(scene, options, column, std::span(two).subspan(at, 1)), least * (1.0 + 1e-4)) << column;
      const double mine = objective(scene, options, column, std::span(four).subspan(at * 3, 3));
      const double theirs = objective(scene, options, column, equal);
      ASSERT_LE(mine, theirs * (1.0 + 1e-4)) << column;
      better += mine < theirs * 0.999 ? 1 : 0;
    }
    EXPECT_GT(better, 20);
  }
}

TEST(Representation, LayersAloneInTheirGroupsAreFittedAsPtm) {
  Scene scene;
  scene.layers = 16;
  base::Random random(59);
  for (const std::vector<int>& layers : {std::vector<int>{3}, {2, 9}, {0, 1}, {1, 4, 8, 15}, {5, 6, 7}, {12, 13, 15}}) {
    addColumn(scene, layers, [&](int, int, const glm::dvec3&) { return random.uniform(); });
  }
  const Pointer ptm = represented(scene, {.basis = Basis::Ptm});
  const Pointer alone = grouped(scene, {.clusters = 4}, detail::LayerGroups::Adaptive);
  for (std::size_t t = 0; t < scene.layer.size(); ++t) {
    const int column = columnOf(scene, t);
    ASSERT_NEAR(alone->evaluate(column, scene.layer[t], 0, kSun), ptm->evaluate(column, scene.layer[t], 0, kSun), 1e-5)
        << column << ' ' << int(scene.layer[t]);
  }
}

TEST(Representation, GroupsPartWhereTheResponseJumps) {
  Scene scene;
  scene.layers = 16;
  addColumn(scene, {0, 1, 2, 3, 10, 11, 12, 13},
            [](int, int layer, const glm::dvec3& l) { return layer < 3 ? 0.8 * l.z : 0.1 + 0.05 * l.x; });
  EXPECT_EQ(detail::bestGroups(scene.input(), {}, 2, {}), std::vector<std::uint16_t>{3});
  EXPECT_EQ(detail::equalGroups(16, 4), (std::vector<std::uint16_t>{4, 8, 12}));
  EXPECT_EQ(detail::equalGroups(3, 2), (std::vector<std::uint16_t>{2}));
}

}  // namespace
}  // namespace sward::lpt::test
