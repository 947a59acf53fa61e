#include "report/light_truth.h"

#include "bake/plants.h"
#include "bake/small_project.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <stop_token>
#include <vector>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

/// The small patch in layers of 32^2 texels.
struct Traced {
  Traced() {
    const project::Project project = bake::test::smallProject();
    auto grown = bake::growPatch(project);
    if (!grown) throw std::runtime_error(grown.error().text());
    auto made = trace::PatchScene::create(std::make_shared<const scene::Patch>(std::move(grown).value()), {});
    if (!made) throw std::runtime_error(made.error().text());
    scene = std::move(made).value();
    options = project.sampling;
    options.sliceResolution = 32;
    options.sliceSubSamples = 4;
  }
  HeldOutTruth truth(const trace::LayerHits& texels, std::uint64_t seed) const {
    trace::SamplingOptions seeded = options;
    seeded.seed = seed;
    auto result = sampleTruth(*scene, seeded, texels, lights, {});
    if (!result) throw std::runtime_error(result.error().text());
    return std::move(result).value();
  }
  trace::LayerHits hits() const {
    auto result = trace::sampleHits(*scene, trace::LayerSet::Slices, options, {});
    if (!result) throw std::runtime_error(result.error().text());
    return std::move(result).value();
  }

  std::unique_ptr<const trace::PatchScene> scene;
  trace::SamplingOptions options;
  const std::vector<glm::dvec3> lights{{0.0, 0.0, 1.0}, glm::normalize(glm::dvec3(0.7, 0.3, 0.8))};
};

/// Of each texel, whether its column has a truth.
std::vector<bool> known(const trace::LayerHits& texels) {
  std::vector<bool> out(texels.texels(), false);
  for (int column = 0; column < texels.shape.columns(); ++column) {
    const auto c = static_cast<std::size_t>(column);
    for (std::uint32_t t = texels.columnStart[c]; t < texels.columnStart[c + 1]; ++t) {
      out[t] = hasTruth(column, texels.shape);
    }
  }
  return out;
}

TEST(LightTruth, HalfTheColumnsHaveOne) {
  const trace::LayerShape shape{128, 128, 16};
  int count = 0;
  for (int column = 0; column < shape.columns(); ++column) count += hasTruth(column, shape) ? 1 : 0;
  EXPECT_EQ(count, shape.columns() / 2);
  EXPECT_TRUE(hasTruth(0, shape));
  EXPECT_FALSE(hasTruth(8, shape));
  EXPECT_FALSE(hasTruth(8 * 128, shape));
  EXPECT_TRUE(hasTruth(8 * 128 + 8, shape));
}

TEST(LightTruth, ItsNoiseIsWhatTwoTruthsDifferBy) {
  const Traced traced;
  const trace::LayerHits texels = traced.hits();
  const HeldOutTruth a = traced.truth(texels, 11), b = traced.truth(texels, 12);
  double squares = 0.0, weights = 0.0;
  for (std::size_t k = 0; k < traced.lights.size(); ++k) {
    for (std::size_t t = 0; t < texels.texels(); ++t) {
      const double w = std::min(a.coverage[t], b.coverage[t]);
      const double r = a.response[k].reflected[t] - b.response[k].reflected[t];
      const double s = a.response[k].transmitted[t] - b.response[k].transmitted[t];
      squares += w * (r * r + s * s);
      weights += 2.0 * w;
    }
  }
  ASSERT_GT(weights, 0.0);
  // Half of the mean square that two independent truths differ by. Stratified rays make the true noise smaller than
  // that of independent hits, of which the estimate is; thousands of texels leave a few per cent of chance.
  const double differ = 0.5 * squares / weights, estimate = 0.5 * (a.noiseVariance + b.noiseVariance);
  EXPECT_GT(estimate, 0.9 * differ);
  EXPECT_LT(estimate, 1.6 * differ);
}

TEST(LightTruth, HasRaysOfItsOwnAndTheSameMeans) {
  const Traced traced;
  const trace::LayerHits texels = traced.hits();
  const HeldOutTruth truth = traced.truth(texels, traced.options.seed);
  const std::vector<bool> has = known(texels);
  double covered = 0.0, sampledOnes = 0.0;
  std::size_t same = 0;
  for (std::size_t t = 0; t < texels.texels(); ++t) {
    if (!has[t]) {
      EXPECT_EQ(truth.coverage[t], 0.0f);
      continue;
    }
    EXPECT_GE(truth.coverage[t], 0.0f);
    EXPECT_LE(truth.coverage[t], 1.0f);
    covered += double{truth.coverage[t]};
    sampledOnes += double{texels.coverage(t)};
    same += truth.coverage[t] == texels.coverage(t) ? 1 : 0;
  }
  // The texels are those that few rays met, so that more rays find less in them: a bias of choice, under a third.
  EXPECT_LT(covered, sampledOnes);
  EXPECT_GT(covered, 0.66 * sampledOnes);
  EXPECT_LT(same, texels.texels() / 2);
  auto sampled = trace::sampleLuminance(*traced.scene, texels, traced.lights[0], {});
  ASSERT_TRUE(sampled.ok());
  double trained = 0.0, held = 0.0, coverage = 0.0, heldCoverage = 0.0;
  for (std::size_t t = 0; t < texels.texels(); ++t) {
    if (!has[t]) continue;
    trained += double{texels.coverage(t)} * double{sampled->reflected[t]};
    coverage += double{texels.coverage(t)};
    held += double{truth.coverage[t]} * double{truth.response[0].reflected[t]};
    heldCoverage += double{truth.coverage[t]};
  }
  EXPECT_NEAR(held / heldCoverage, trained / coverage, 0.05 * trained / coverage);
}

TEST(LightTruth, TexelsThatNoRayMetHaveNoWeight) {
  const Traced traced;
  trace::LayerHits texels = traced.hits();
  // A patch of which the first column holds one texel more than can be hit: above all grass.
  trace::LayerHits sky = texels;
  sky.layer.assign(1, 0);
  sky.hitStart.assign(1, 0);
  const auto first = texels.columnStart[1] - texels.columnStart[0];
  ASSERT_FALSE(first > 0 && texels.layer[0] == 0) << "this seed's first column reaches the top: choose another";
  for (const std::uint8_t layer : texels.layer) sky.layer.push_back(layer);
  for (const std::uint32_t start : texels.hitStart) sky.hitStart.push_back(start);
  for (std::size_t c = 1; c < sky.columnStart.size(); ++c) ++sky.columnStart[c];
  const HeldOutTruth truth = traced.truth(sky, 3);
  EXPECT_EQ(truth.coverage[0], 0.0f);
  EXPECT_EQ(truth.response[0].reflected[0], 0.0f);
  EXPECT_GT(*std::max_element(truth.coverage.begin(), truth.coverage.end()), 0.0f);
}

TEST(LightTruth, CanBeCancelled) {
  const Traced traced;
  JobContext job;
  std::stop_source stop;
  stop.request_stop();
  job.stop = stop.get_token();
  EXPECT_FALSE(sampleTruth(*traced.scene, traced.options, traced.hits(), traced.lights, job).ok());
}

}  // namespace
}  // namespace sward::report
