#include "image/pull_push.h"
#include "samples.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace sward::lpt::test {
namespace {

TEST(PullPush, AnyShapeIsFilledWithinTheRangeOfWhatIsKnown) {
  base::Random random(61);
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 9}, {13, 1}, {2, 2}, {7, 5}, {64, 64}, {33, 70}}) {
    for (const bool periodic : {false, true}) {
      const auto pixels = static_cast<std::size_t>(width * height);
      std::vector<float> values(pixels * 2, -99.0f), weight(pixels, 0.0f);
      for (std::size_t p = 0; p < pixels; ++p) {
        if (p != 0 && random.uniform() > 0.1) continue;
        weight[p] = static_cast<float>(std::pow(10.0, random.uniform(-30.0, 3.0)));
        values[p * 2] = static_cast<float>(random.uniform(1.0, 2.0));
        values[p * 2 + 1] = 5.0f;
      }
      const std::vector<float> before = values;
      image::pullPush(values, weight, width, height, 2, periodic);
      for (std::size_t p = 0; p < pixels; ++p) {
        ASSERT_GE(values[p * 2], 0.99999f);
        ASSERT_LE(values[p * 2], 2.00001f);
        ASSERT_NEAR(values[p * 2 + 1], 5.0f, 1e-5f);
        if (weight[p] > 0.0f) {
          ASSERT_EQ(values[p * 2], before[p * 2]);
        }
      }
    }
  }
}

TEST(PullPush, NothingKnownChangesNothing) {
  std::vector<float> values(12, 7.0f);
  const std::vector<float> weight(12, 0.0f);
  image::pullPush(values, weight, 4, 3, 1, true);
  EXPECT_EQ(values, std::vector<float>(12, 7.0f));
}

TEST(PullPush, HolesTakeWhatIsNearAndWhatWeighsMore) {
  std::vector<float> values(16, 0.0f), weight(16, 0.0f);
  values[0] = 1.0f;
  weight[0] = 1.0f;
  values[15] = 3.0f;
  weight[15] = 1.0f;
  image::pullPush(values, weight, 16, 1, 1, false);
  EXPECT_LT(values[1], values[14]);
  EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  std::vector<float> heavy{1.0f, 0.0f, 0.0f, 3.0f};
  image::pullPush(heavy, std::vector<float>{9.0f, 0.0f, 0.0f, 1.0f}, 4, 1, 1, false);
  std::vector<float> even{1.0f, 0.0f, 0.0f, 3.0f};
  image::pullPush(even, std::vector<float>{1.0f, 0.0f, 0.0f, 1.0f}, 4, 1, 1, false);
  EXPECT_LE(heavy[1], even[1]);
}

/// 8 x 8 columns; those with x >= 4 are empty.
Scene halfScene(int channels) {
  Scene scene;
  scene.layers = 3;
  scene.channels = channels;
  for (int c = 0; c < 64; ++c) {
    const bool empty = c % 8 >= 4;
    addColumn(
        scene, empty ? std::vector<int>{} : std::vector<int>{0, 2},
        [&](int channel, int layer, const glm::dvec3& l) { return 0.2 + 0.1 * channel + 0.1 * layer + 0.05 * l.x; });
  }
  return scene;
}

TEST(FillEmpty, EmptyColumnsTakeTheirNeighboursPolynomial) {
  Fit fit = fitted(halfScene(2));
  const Fit before = fit;
  fillEmpty(fit, 8, 8, true);
  for (int c = 0; c < 64; ++c) {
    if (c % 8 < 4) {
      EXPECT_TRUE(std::ranges::equal(fit.column(c, 1), before.column(c, 1)));
    } else {
      EXPECT_EQ(largestCoefficient(before.column(c, 1)), 0.0);
      EXPECT_LT(relativeDifference(fit.column(c, 1), before.column(0, 1)), 1e-5);
    }
  }
  EXPECT_EQ(fit.weight, before.weight);  // filled columns stay without weight
}

TEST(FillEmpty, PtmFillsEveryLayerByItself) {
  Scene scene = halfScene(1);
  Fit fit = fitted(scene, {.basis = Basis::Ptm});
  const Fit before = fit;
  fillEmpty(fit, 8, 8, true);
  for (const int c : {5, 63}) {
    EXPECT_LT(relativeDifference(fit.column(c, 0).subspan(0, 6), before.column(0, 0).subspan(0, 6)), 1e-5);
    EXPECT_LT(relativeDifference(fit.column(c, 0).subspan(12, 6), before.column(0, 0).subspan(12, 6)), 1e-5);
    EXPECT_EQ(largestCoefficient(fit.column(c, 0).subspan(6, 6)), 0.0);  // no texel has layer 1
  }
  EXPECT_GT(relativeDifference(fit.column(5, 0).subspan(0, 6), fit.column(5, 0).subspan(12, 6)), 0.1);
}

TEST(FillEmpty, NothingToTakeChangesNothing) {
  Scene scene;
  for (int c = 0; c < 4; ++c) addColumn(scene, {}, [](int, int, const glm::dvec3&) { return 0.0; });
  Fit fit = fitted(scene);
  fillEmpty(fit, 2, 2, false);
  EXPECT_EQ(largestCoefficient(fit.coefficients), 0.0);
}

TEST(FitPayload, SavesAndLoadsAndRefusesDamage) {
  for (const Basis basis : {Basis::Lpt, Basis::Ptm}) {
    const Fit fit = fitted(randomScene(12, 5, 15, 2, 62), {.basis = basis});
    base::ByteWriter out;
    save(out, fit);
    const auto data = out.take();
    base::ByteReader in(data);
    Fit read;
    ASSERT_TRUE(load(in, read));
    EXPECT_TRUE(in.finished());
    EXPECT_EQ(read.coefficients, fit.coefficients);
    EXPECT_EQ(read.perColumn, fit.perColumn);
    EXPECT_EQ(read.rank, fit.rank);
    EXPECT_EQ(read.condition, fit.condition);
    EXPECT_EQ(read.weight, fit.weight);
    EXPECT_EQ(read.path, fit.path);
    EXPECT_EQ(read.layerWeight, fit.layerWeight);
    for (std::size_t length = 0; length < data.size(); ++length) {
      base::ByteReader cut{std::span(data).first(length)};
      Fit other;
      other.columns = 77;
      ASSERT_FALSE(load(cut, other)) << length;
      ASSERT_EQ(other.columns, 77);
    }
    for (std::size_t i = 0; i < 1 + 3 * 4 + 8; ++i) {
      // Every byte of the shape and of the first length, turned over; nothing of an LPT depends on how many layers it
      // is for (250 instead of 5 is a sound fit).
      if (basis == Basis::Lpt && i == 5) continue;
      auto damaged = data;
      damaged[i] = ~damaged[i];
      base::ByteReader reader(damaged);
      Fit other;
      EXPECT_FALSE(load(reader, other)) << i;
    }
  }
}

}  // namespace
}  // namespace sward::lpt::test
