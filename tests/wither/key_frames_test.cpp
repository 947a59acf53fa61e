#include "wither/key_frames.h"

#include "wither/test_texels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

constexpr TexelGrid kGrid{16, 16, 1.0, 1.0};

/// A full layer of leaves that face up: opacity from above 1 - exp(-depth), from the sides nothing.
Texel layer(double depth, float green = 0.25f, int height = 3) {
  std::vector<Texel::Entry> entries;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      Voxel voxel = leafVoxel(depth * 16.0);
      voxel.normal = {0.0f, 0.0f, 1.0f};
      voxel.spread = {0, 0, 0, 0, 0, voxel.density};
      voxel.diffuse = {0.0f, green, 0.0f};
      entries.push_back({{x, y, height}, voxel});
    }
  }
  return Texel::fromEntries(kGrid, std::move(entries)).value();
}

KeyFrames chosen(const TexelAt& texelAt, const KeyFrameOptions& options = {}) {
  return chooseKeyFrames(texelAt, options, {}).value();
}

double difference(const Texel& a, const Texel& b) {
  return lookDifference(a, b).value();
}

TEST(LookDifference, IsThatOfOpacityAndColour) {
  const auto opacity = [](double depth) { return 1.0 - std::exp(-depth); };
  EXPECT_EQ(difference(layer(1.0), layer(1.0)), 0.0);
  // Green of 0.25: its root halves the opacity's difference, so opacity's own counts. Densities are single precision.
  EXPECT_NEAR(difference(layer(0.5), layer(1.5)), 1.0 - opacity(0.5) / opacity(1.5), 1e-6);
  EXPECT_NEAR(difference(layer(1.0, 0.25f), layer(1.0, 0.36f)), 0.1, 1e-6);
  EXPECT_NEAR(difference(layer(1.0), Texel::fromEntries(kGrid, {}).value()), 1.0, 1e-6);
  // Moving up is not seen from above, and leaves that face up are not seen from the side.
  EXPECT_NEAR(difference(layer(1.0), layer(1.0, 0.25f, 12)), 0.0, 1e-6);
  EXPECT_EQ(difference(Texel::fromEntries(kGrid, {}).value(), Texel::fromEntries(kGrid, {}).value()), 0.0);
  EXPECT_FALSE(lookDifference(layer(1.0), Texel::fromEntries({8, 8, 1.0, 1.0}, {}).value()).ok());
  const Texel blades = uprightBlades(30, 16, 1.0, 0.5).texel, higher = uprightBlades(30, 16, 1.0, 1.0).texel;
  EXPECT_GT(difference(blades, higher), 0.05);
}

TEST(KeyFramesTest, TwoAreEnoughForWhatChangesEvenly) {
  const KeyFrames still = chosen([](double) -> Result<Texel> { return layer(1.0); });
  EXPECT_EQ(still.frames.size(), 2u);
  EXPECT_LT(still.error, 1e-6);
  // Depth even in the degree: lerp gives the very same density.
  const KeyFrames even = chosen([](double wd) -> Result<Texel> { return layer(0.2 + wd); });
  EXPECT_EQ(even.frames.size(), 2u);
  EXPECT_LT(even.error, 1e-6);
}

TEST(KeyFramesTest, StandWhereTheTexelChanges) {
  // All of the change about 0.7.
  const auto texelAt = [](double wd) -> Result<Texel> {
    return layer(0.2 + 1.0 / (1.0 + std::exp(-40.0 * (wd - 0.7))));
  };
  const KeyFrames frames = chosen(texelAt);
  EXPECT_LE(frames.error, 0.02);
  EXPECT_EQ(frames.frames.front().weathering, 0.0);
  EXPECT_EQ(frames.frames.back().weathering, 1.0);
  int near = 0;
  for (std::size_t i = 1; i < frames.frames.size(); ++i) {
    EXPECT_GT(frames.frames[i].weathering, frames.frames[i - 1].weathering);
    near += std::abs(frames.frames[i].weathering - 0.7) < 0.15 ? 1 : 0;
  }
  EXPECT_GE(near, 3);
  // Evenly spaced frames as near as the nearest would be twice as many at least.
  double nearest = 1.0;
  for (std::size_t i = 1; i < frames.frames.size(); ++i) {
    nearest = std::min(nearest, frames.frames[i].weathering - frames.frames[i - 1].weathering);
  }
  EXPECT_LT(static_cast<double>(frames.frames.size()), 0.5 / nearest);
  // What was promised at three places of each interval holds elsewhere to twice as much.
  for (int i = 0; i <= 100; ++i) {
    EXPECT_LE(difference(frames.at(i / 100.0, {}).value(), texelAt(i / 100.0).value()), 0.04) << i;
  }
  const KeyFrames fine = chosen(texelAt, {0.002, 65, 1.0 / 256});
  EXPECT_LE(fine.error, 0.002);
  EXPECT_GT(fine.frames.size(), frames.frames.size());
}

TEST(KeyFramesTest, FindsAChangeThatIsOddAboutTheMiddle) {
  const auto texelAt = [](double wd) -> Result<Texel> { return layer(1.0 + 0.5 * std::sin(6.283185307 * wd)); };
  const KeyFrames frames = chosen(texelAt);
  EXPECT_LE(frames.error, 0.02);
  EXPECT_GE(frames.frames.size(), 5u);
}

TEST(KeyFramesTest, EndsAtJumpsAndAtTheMost) {
  const auto jump = [](double wd) -> Result<Texel> { return layer(wd < 0.3 ? 0.2 : 2.0); };
  const KeyFrames frames = chosen(jump, {0.02, 65, 1.0 / 64});
  EXPECT_GT(frames.error, 0.02);
  EXPECT_LE(frames.frames.size(), 14u);
  for (std::size_t i = 1; i < frames.frames.size(); ++i) {
    EXPECT_GE(frames.frames[i].weathering - frames.frames[i - 1].weathering, 1.0 / 64);
  }
  const auto wild = [](double wd) -> Result<Texel> { return layer(1.0 + 0.9 * std::sin(900.0 * wd)); };
  EXPECT_EQ(chosen(wild, {0.0, 9, 1e-6}).frames.size(), 9u);
  EXPECT_EQ(chosen(wild, {0.02, 0, 1.0 / 64}).frames.size(), 2u);
}

TEST(KeyFramesTest, ClampsAndReturnsFramesThemselves) {
  const KeyFrames frames = chosen([](double wd) -> Result<Texel> { return layer(0.2 + wd * wd); });
  EXPECT_TRUE(sameBytes(frames.at(-1.0, {}).value(), *frames.frames.front().texel));
  EXPECT_TRUE(sameBytes(frames.at(7.0, {}).value(), *frames.frames.back().texel));
  EXPECT_TRUE(sameBytes(frames.at(std::numeric_limits<double>::quiet_NaN(), {}).value(), *frames.frames[0].texel));
  for (const KeyFrame& frame : frames.frames) {
    EXPECT_TRUE(sameBytes(frames.at(frame.weathering, {}).value(), *frame.texel));
  }
  EXPECT_FALSE(KeyFrames{}.at(0.5, {}).ok());
}

TEST(KeyFramesTest, PassesErrorsOn) {
  const auto fails = [](double wd) -> Result<Texel> {
    if (wd == 0.5) return Error::failed("no texel today");
    return layer(1.0);
  };
  const Result<KeyFrames> failed = chooseKeyFrames(fails, {}, {});
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().what, "no texel today");
  const auto grids = [](double wd) -> Result<Texel> {
    return Texel::fromEntries(wd < 0.5 ? kGrid : TexelGrid{8, 8, 1.0, 1.0}, {});
  };
  EXPECT_FALSE(chooseKeyFrames(grids, {}, {}).ok());
  std::stop_source source;
  source.request_stop();
  JobContext job;
  job.stop = source.get_token();
  const Result<KeyFrames> stopped = chooseKeyFrames([](double) -> Result<Texel> { return layer(1.0); }, {}, job);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace sward::wither
