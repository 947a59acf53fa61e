// The reference as an estimate: the same bytes however it is run, and an error that it knows.
#include "trace/reference_fixture.h"

#include "trace/sample_sequence.h"

#include <atomic>
#include <set>
#include <stop_token>

namespace sward::trace {
namespace {

using testing::cameraAt;
using testing::Stage;
using testing::stageOf;

Stage meadow() {
  Stage stage = stageOf(testing::smallMeadow(), 16, {0.2f, 0.15f, 0.1f});
  stage.daylight = testing::sunAt(240.0, 25.0);
  return stage;
}
const scene::Camera& meadowCamera() {
  static const scene::Camera camera = cameraAt({0.7, -2.5, 1.2}, {0.4, 0.3, 0.1}, 0.5);
  return camera;
}
ReferenceOptions meadowPicture() {
  ReferenceOptions options;
  options.width = 36;
  options.height = 22;
  options.bounces = 1;
  return options;
}

JobContext onThreads(int threads) {
  JobContext job;
  job.threads = threads;
  return job;
}

TEST(ReferenceDeterminism, TheSameBytesOnAnyNumberOfThreadsAndInAnyPortions) {
  const Stage stage = meadow();
  const auto picture = [&](int threads, const std::vector<int>& portions) {
    const auto reference = stage.reference(meadowCamera(), meadowPicture());
    for (const int portion : portions) EXPECT_TRUE(reference->addSamples(portion, onThreads(threads)).ok());
    EXPECT_EQ(reference->samples(), 8);
    return std::pair(reference->mean().pixels, reference->variance().pixels);
  };
  const auto expected = picture(1, {8});
  EXPECT_EQ(picture(2, {8}), expected);
  EXPECT_EQ(picture(3, {4, 4}), expected);
  EXPECT_EQ(picture(2, {1, 0, 5, 2}), expected);
}

TEST(ReferenceDeterminism, AnotherSeedGivesOtherSamples) {
  const Stage stage = meadow();
  ReferenceOptions other = meadowPicture();
  other.seed = 2;
  EXPECT_NE(stage.picture(meadowCamera(), meadowPicture(), 2).pixels, stage.picture(meadowCamera(), other, 2).pixels);
}

TEST(ReferenceDeterminism, CancelledItIsAsBefore) {
  const Stage stage = meadow();
  const auto reference = stage.reference(meadowCamera(), meadowPicture());
  ASSERT_TRUE(reference->addSamples(4, {}).ok());
  const auto mean = reference->mean().pixels, variance = reference->variance().pixels;
  const std::uint64_t rays = reference->rays();
  std::stop_source stop;
  JobContext job;
  job.stop = stop.get_token();
  job.threads = 1;
  job.onProgress = [&](const std::string&, double) { stop.request_stop(); };  // after the first part of the picture
  const Result<void> outcome = reference->addSamples(4, job);
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(reference->samples(), 4);
  EXPECT_EQ(reference->rays(), rays);
  EXPECT_EQ(reference->mean().pixels, mean);
  EXPECT_EQ(reference->variance().pixels, variance);
  ASSERT_TRUE(reference->addSamples(4, {}).ok());
  EXPECT_EQ(reference->mean().pixels, stage.picture(meadowCamera(), meadowPicture(), 8).pixels);
}

/// Of the squared differences of two pictures and of the variances that they state.
struct Spread {
  double squares = 0.0, predicted = 0.0, effective = 0.0;
};
Spread spreadOf(const Reference& estimate, const image::Image& truth, const image::Image& truthVariance) {
  const image::Image mean = estimate.mean(), variance = estimate.variance();
  Spread out;
  double weights = 0.0;
  for (std::size_t pixel = 0; pixel < mean.pixels.size() / 3; ++pixel) {
    // One channel: the three are the same samples.
    const std::size_t i = 3 * pixel + 1;
    const double difference = static_cast<double>(mean.pixels[i]) - static_cast<double>(truth.pixels[i]);
    const double stated = static_cast<double>(variance.pixels[i]) + static_cast<double>(truthVariance.pixels[i]);
    out.squares += difference * difference;
    out.predicted += stated;
    weights += stated * stated;
  }
  out.effective = out.predicted * out.predicted / weights;
  return out;
}

TEST(ReferenceNoise, TheVarianceSaysHowFarTheTruthIs) {
  const Stage stage = meadow();
  ReferenceOptions options = meadowPicture();
  const auto truth = stage.reference(meadowCamera(), options);
  ASSERT_TRUE(truth->addSamples(1024, {}).ok());
  const image::Image mean = truth->mean(), variance = truth->variance();
  options.seed = 2;
  const auto estimate = stage.reference(meadowCamera(), options);
  ASSERT_TRUE(estimate->addSamples(32, {}).ok());
  const Spread few = spreadOf(*estimate, mean, variance);
  ASSERT_TRUE(estimate->addSamples(96, {}).ok());
  const Spread many = spreadOf(*estimate, mean, variance);
  // A squared normal deviate has the relative variance 2, a variance of three degrees of freedom 2/3, and both are
  // summed over as many pixels as `effective` says (fewer than there are, since bright ones weigh more).
  for (const Spread& spread : {few, many}) {
    ASSERT_GT(spread.effective, 50.0);
    EXPECT_NEAR(spread.squares / spread.predicted, 1.0, 4.0 * std::sqrt((2.0 + 2.0 / 3.0) / spread.effective));
  }
  // Four times the samples: half the error, or less as far as stratification helps, never below the rate n^-3/2 of
  // (0, 2)-sequences and smooth integrands, an eighth.
  const double error = std::sqrt(2.0 / few.effective + 2.0 / many.effective);  // relative, of the ratio of squares
  EXPECT_LT(many.squares / few.squares, 0.25 * (1.0 + 4.0 * error));
  EXPECT_GT(many.squares / few.squares, 1.0 / 64.0);
}

TEST(ReferenceNoise, WithoutChanceThereIsNoVariance) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 8, glm::vec3(0.25f));
  const auto reference = stage.reference(cameraAt({0.3, 0.4, 4.0}, {0.3, 0.4, 0.0}, 0.3), testing::smallPicture());
  for (const int more : {1, 1, 5}) {
    ASSERT_TRUE(reference->addSamples(more, {}).ok());
    for (const float value : reference->variance().pixels) ASSERT_LT(std::abs(value), 1e-12f);
  }
}

TEST(SampleSequence, EveryPairIsStratified) {
  // Of any aligned 16 points one lies in each cell of a grid of 1 x 16, 2 x 8, 4 x 4, 8 x 2 and 16 x 1.
  for (const std::uint32_t dimension : {0u, 1u, 7u}) {
    for (const std::uint32_t first : {0u, 16u, 64u}) {
      for (int across = 1; across <= 16; across *= 2) {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = 0; i < 16; ++i) {
          const glm::dvec2 p = SampleSequence(99, first + i).pair(dimension);
          ASSERT_TRUE(p.x >= 0.0 && p.x < 1.0 && p.y >= 0.0 && p.y < 1.0);
          cells.emplace(static_cast<int>(p.x * across), static_cast<int>(p.y * (16 / across)));
        }
        EXPECT_EQ(cells.size(), 16u) << dimension << ' ' << first << ' ' << across;
      }
    }
  }
}

TEST(SampleSequence, PairsAndSeedsAreIndependent) {
  // Correlation of n uniform pairs has the deviation 1 / sqrt(n); of stratified ones no more.
  constexpr int kCount = 4096;
  const auto correlation = [&](auto one, auto two) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) sum += 12.0 * (one(i) - 0.5) * (two(i) - 0.5);
    return sum / kCount;
  };
  const auto at = [](std::uint64_t seed, std::uint32_t dimension) {
    return [=](std::uint32_t i) { return SampleSequence(seed, i).pair(dimension).x; };
  };
  const double bound = 5.0 / std::sqrt(kCount);
  EXPECT_LT(std::abs(correlation(at(1, 0), at(1, 1))), bound);
  EXPECT_LT(std::abs(correlation(at(1, 3), at(2, 3))), bound);
  EXPECT_GT(correlation(at(1, 3), at(1, 3)), 0.9);
}

}  // namespace
}  // namespace sward::trace
