#include "samples.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

struct LightCase {
  std::string name;
  std::vector<glm::dvec3> lights;
};

std::vector<glm::dvec3> ring(int count, double z) {
  std::vector<glm::dvec3> lights;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count, r = std::sqrt(1.0 - z * z);
    lights.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return lights;
}

std::vector<LightCase> lightCases() {
  std::vector<LightCase> cases{{"one", hemisphere(1)},
                               {"three", hemisphere(3)},
                               {"five", hemisphere(5)},
                               {"six", hemisphere(6)},
                               {"ring", ring(12, 0.5)},
                               {"near the horizon", ring(9, 1e-4)},
                               {"zenith only", {{0, 0, 1}}},
                               {"fifteen", hemisphere(15)},
                               {"coincident", {}},
                               {"nearly coincident", {}},
                               {"coplanar", {}}};
  for (int i = 0; i < 15; ++i) {
    cases[8].lights.emplace_back(0.6, 0.0, 0.8);
    cases[9].lights.emplace_back(glm::normalize(glm::dvec3(0.6 + 1e-9 * i, 1e-9 * i * i, 0.8)));
    const double angle = std::numbers::pi * (i + 0.5) / 15.0;
    cases[10].lights.emplace_back(std::cos(angle), 0.0, std::sin(angle));
  }
  return cases;
}

const std::vector<std::vector<int>> kLayerCases{{7}, {0, 15}, {3, 4}, {2, 3, 4}, {0, 5, 10, 15}};

/// Sum of w (f - y)^2 over a column, with f from the fit or, without one, the best constant.
double residual(const Scene& scene, const Fit* fit, int column, bool paper) {
  double sum = 0.0, total = 0.0, mean = 0.0;
  const auto at = static_cast<std::size_t>(column);
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t t = scene.columnStart[at]; t < scene.columnStart[at + 1]; ++t) {
      const double w = paper ? scene.visibility[t]
                             : std::max(static_cast<double>(scene.visibility[t]), 1.0 / 32.0) * scene.coverage[t];
      for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        const double y = scene.sample(0, k, t);
        if (pass == 0) {
          total += w;
          mean += w * y;
          continue;
        }
        const double f = fit ? predicted(*fit, column, 0, scene.lights[k], scene.u(t)) : mean / total;
        sum += w * (f - y) * (f - y);
      }
    }
  }
  return sum;
}

Scene degenerateScene(const std::vector<glm::dvec3>& lights) {
  Scene scene;
  scene.lights = lights;
  base::Random random(21);
  for (const auto& layers : kLayerCases) {
    addColumn(scene, layers, [&](int, int, const glm::dvec3&) { return random.uniform(); });
  }
  addColumn(scene, {}, [](int, int, const glm::dvec3&) { return 0.0; });
  return scene;
}

TEST(FitDegenerate, FewOrDependentLightsNeverFitWorseThanAConstant) {
  for (const LightCase& lights : lightCases()) {
    const Scene scene = degenerateScene(lights.lights);
    for (const FitOptions options :
         {FitOptions{}, FitOptions{.layerRidge = 0.0, .lightRidge = 0.0}, FitOptions{.paper = true}}) {
      const Fit fit = fitted(scene, options);
      const bool ridged = !options.paper && options.layerRidge > 0.0;
      for (int c = 0; c < static_cast<int>(kLayerCases.size()); ++c) {
        SCOPED_TRACE(lights.name + " lights, column " + std::to_string(c) + (options.paper ? ", paper" : "") +
                     (ridged ? ", ridge" : ""));
        for (const float b : fit.column(c, 0)) ASSERT_TRUE(std::isfinite(b));
        EXPECT_LE(residual(scene, &fit, c, options.paper),
                  residual(scene, nullptr, c, options.paper) * (1.0 + 1e-5) + 1e-9);
        if (ridged) {
          EXPECT_LT(largestCoefficient(fit.column(c, 0)), 10.0);
        }
        EXPECT_GE(fit.rank[static_cast<std::size_t>(c)], 1);
      }
      EXPECT_EQ(fit.path.back(), FitPath::Empty);
      EXPECT_EQ(fit.weight.back(), 0.0f);
      EXPECT_EQ(fit.condition.back(), 0.0f);
      EXPECT_EQ(largestCoefficient(fit.column(scene.columns - 1, 0)), 0.0);
    }
    const Fit ptm = fitted(scene, {.basis = Basis::Ptm});
    for (const float b : ptm.coefficients) ASSERT_TRUE(std::isfinite(b)) << lights.name;
    EXPECT_LT(largestCoefficient(ptm.coefficients), 10.0) << lights.name;
  }
}

TEST(FitDegenerate, RanksOfKnownLightSets) {
  const auto rank = [](const std::vector<glm::dvec3>& lights, std::size_t column, FitOptions options) {
    return static_cast<int>(fitted(degenerateScene(lights), options).rank[column]);
  };
  for (const FitOptions options : {FitOptions{}, FitOptions{.paper = true}}) {
    EXPECT_EQ(rank(hemisphere(1), 0, options), 1);
    EXPECT_EQ(rank(hemisphere(3), 0, options), 3);
    EXPECT_EQ(rank(hemisphere(15), 0, options), 6);
    EXPECT_EQ(rank(hemisphere(15), 1, options), 9);
    EXPECT_EQ(rank(hemisphere(15), 4, options), 10);
    EXPECT_EQ(rank(ring(12, 0.5), 0, options), 5);  // lx^2 + ly^2 is constant on a ring
    EXPECT_EQ(rank(ring(12, 0.5), 4, options), 9);
    EXPECT_EQ(rank(lightCases()[10].lights, 0, options), 3);  // lx^2, lx, 1
  }
}

TEST(FitDegenerate, TooFewLightsTakeTheOrthogonalPath) {
  const Fit five = fitted(degenerateScene(hemisphere(5))), six = fitted(degenerateScene(hemisphere(6)));
  EXPECT_EQ(five.path[4], FitPath::Orthogonal);
  EXPECT_EQ(six.path[4], FitPath::Moments);
}

TEST(FitDegenerate, BothPathsAgreeWhereTheyMeet) {
  // A NaN in a channel of its own sends every column through the orthogonal path, with one row less of 15.
  Scene moments = randomScene(50, 16, 15, 1, 22);
  Scene rows = moments;
  rows.channels = 2;
  rows.lights.push_back({0.1, 0.2, std::sqrt(0.95)});
  rows.samples.assign(32, std::vector<float>(rows.layer.size(), 0.5f));
  for (std::size_t k = 0; k < 15; ++k) rows.samples[k] = moments.samples[k];
  rows.samples[31].assign(rows.layer.size(), kNan);
  const Fit a = fitted(moments), b = fitted(rows);
  for (int c = 0; c < 50; ++c) {
    ASSERT_EQ(b.path[static_cast<std::size_t>(c)], FitPath::Orthogonal);
    ASSERT_LT(relativeDifference(a.column(c, 0), b.column(c, 0)), 1e-6);
    ASSERT_EQ(a.rank[static_cast<std::size_t>(c)], b.rank[static_cast<std::size_t>(c)]);
    ASSERT_NEAR(b.condition[static_cast<std::size_t>(c)] / a.condition[static_cast<std::size_t>(c)], 1.05, 0.06);
  }
}

TEST(FitDegenerate, VisibilityZeroEverywhere) {
  Scene scene = randomScene(30, 16, 15, 1, 23);
  std::fill(scene.visibility.begin(), scene.visibility.end(), 0.0f);
  const Fit fit = fitted(scene);
  Scene even = scene;
  std::fill(even.visibility.begin(), even.visibility.end(), 0.02f);  // also under 1/32
  EXPECT_EQ(fit.coefficients, fitted(even).coefficients);
  for (const float w : fit.weight) EXPECT_GT(w, 0.0f);
  // The paper's weights leave nothing to fit.
  const Fit paper = fitted(scene, {.paper = true});
  for (std::size_t c = 0; c < 30; ++c) EXPECT_EQ(paper.path[c], FitPath::Empty);
}

TEST(FitDegenerate, AWeightOf1e12CountsForNothing) {
  Scene scene;
  const auto low = [](int, int layer, const glm::dvec3& l) { return layer == 2 ? 0.3 + 0.2 * l.x : 0.9 - 0.4 * l.y; };
  addColumn(scene, {2, 9}, low);
  scene.coverage = {1.0f, 1e-12f};
  Scene alone;
  addColumn(alone, {2}, low, 1.0f);
  const Fit fit = fitted(scene), one = fitted(alone);
  EXPECT_EQ(fit.rank[0], 6);
  for (const glm::dvec3& l : scene.lights) {
    EXPECT_NEAR(predicted(fit, 0, 0, l, 2.0 / 16), predicted(one, 0, 0, l, 2.0 / 16), 1e-6);
  }
  EXPECT_LT(largestCoefficient(fit.column(0, 0)), 1.0);
}

TEST(FitDegenerate, ScalingAllWeightsChangesNothing) {
  Scene scene = randomScene(40, 16, 15, 1, 24), tiny = scene;
  for (float& a : tiny.coverage) a *= 0x1.0p-40f;
  EXPECT_EQ(fitted(scene).coefficients, fitted(tiny).coefficients);
}

TEST(FitDegenerate, ScaleOfLuminancePassesThrough) {
  const Scene scene = randomScene(40, 16, 15, 1, 25);
  for (const FitOptions options : {FitOptions{}, FitOptions{.basis = Basis::Ptm}, FitOptions{.paper = true}}) {
    const Fit reference = fitted(scene, options);
    for (const float scale : {1e-8f, 1e6f}) {
      Scene scaled = scene;
      for (auto& values : scaled.samples) {
        for (float& y : values) y *= scale;
      }
      Fit fit = fitted(scaled, options);
      for (float& b : fit.coefficients) b /= scale;
      for (int c = 0; c < 40; ++c)
        ASSERT_LT(relativeDifference(fit.column(c, 0), reference.column(c, 0)), 2e-5) << scale;
    }
  }
}

TEST(FitDegenerate, LargestFloatsStayFinite) {
  Scene scene;
  addColumn(scene, {0, 1, 2}, [](int, int layer, const glm::dvec3& l) { return (layer == 1 ? -3e38 : 3e38) * l.x; });
  for (const FitOptions options : {FitOptions{}, FitOptions{.paper = true}, FitOptions{.basis = Basis::Ptm}}) {
    for (const float b : fitted(scene, options).coefficients) EXPECT_TRUE(std::isfinite(b));
  }
}

TEST(FitDegenerate, ColumnsWithoutAFiniteSampleAreEmpty) {
  Scene scene = randomScene(3, 4, 15, 1, 26);
  for (auto& values : scene.samples) {
    for (std::size_t t = scene.columnStart[1]; t < scene.columnStart[2]; ++t) values[t] = kNan;
  }
  for (const FitOptions options : {FitOptions{}, FitOptions{.basis = Basis::Ptm}, FitOptions{.paper = true}}) {
    const Fit fit = fitted(scene, options);
    EXPECT_EQ(fit.path[1], FitPath::Empty);
    EXPECT_EQ(fit.weight[1], 0.0f);
    EXPECT_EQ(largestCoefficient(fit.column(1, 0)), 0.0);
    EXPECT_NE(fit.path[0], FitPath::Empty);
  }
}

TEST(FitDegenerate, TexelsWithoutWeightAreAbsentWhateverTheyHold) {
  Scene scene, bare;
  const auto response = [](int, int layer, const glm::dvec3& l) { return 0.1 * layer + 0.3 * l.x; };
  for (const float coverage : {0.0f, kNan, -0.5f, kInf}) {
    addColumn(scene, {1, 4, 6}, response);
    scene.coverage[scene.coverage.size() - 2] = coverage;
    for (auto& values : scene.samples) values[values.size() - 2] = kNan;
    addColumn(bare, {1, 6}, response);
  }
  const Fit fit = fitted(scene), expected = fitted(bare);
  EXPECT_EQ(fit.coefficients, expected.coefficients);
  for (const FitPath path : fit.path) EXPECT_EQ(path, FitPath::Moments);
}

TEST(FitErrors, SayWhatDoesNotMatch) {
  const Scene scene = randomScene(5, 4, 15, 1, 27);
  const auto text = [](const FitInput& in, const FitOptions& options = {}) {
    const auto result = fit(in, options, {});
    return result.ok() ? std::string("no error") : result.error().text();
  };
  FitInput in = scene.input();
  in.lights = {};
  EXPECT_NE(text(in).find("no light"), std::string::npos);
  in = scene.input();
  in.coverage = in.coverage.first(1);
  EXPECT_NE(text(in).find("1 coverages"), std::string::npos);
  in = scene.input();
  in.samples.pop_back();
  EXPECT_NE(text(in).find("14 arrays"), std::string::npos);
  in = scene.input();
  in.samples[3] = in.samples[3].first(2);
  EXPECT_NE(text(in).find("2 samples"), std::string::npos);
  in = scene.input();
  in.columns = 4;
  EXPECT_NE(text(in).find("column starts"), std::string::npos);
  in = scene.input();
  in.layers = 1;
  EXPECT_NE(text(in).find("of 1"), std::string::npos);
  EXPECT_NE(text(scene.input(), {.layerRidge = -1.0}).find("ridge"), std::string::npos);
  EXPECT_NE(text(scene.input(), {.lightRidge = std::nan("")}).find("ridge"), std::string::npos);
  std::vector<glm::dvec3> lights = scene.lights;
  lights[2].x = std::nan("");
  in = scene.input();
  in.lights = lights;
  EXPECT_NE(text(in).find("light 2"), std::string::npos);
  EXPECT_EQ(text(scene.input()), "no error");
}

TEST(FitErrors, CancelledJobsSaySo) {
  const Scene scene = randomScene(500, 4, 15, 1, 28);
  std::stop_source source;
  source.request_stop();
  JobContext job;
  job.stop = source.get_token();
  const auto result = fit(scene.input(), {}, job);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}

TEST(FitErrors, NoColumnsAreNoError) {
  Scene scene;
  scene.samples.resize(15);
  const Fit fit = fitted(scene);
  EXPECT_EQ(fit.columns, 0);
  EXPECT_TRUE(fit.coefficients.empty());
}

}  // namespace
}  // namespace sward::lpt::test
