#include "trace/thumbnail.h"

#include "trace/test_patches.h"

#include "mesh/procedural.h"

#include <algorithm>
#include <cmath>

namespace sward::trace {
namespace {

using namespace testing;

const std::uint8_t* pixel(const Thumbnail& picture, int x, int y) {
  return &picture.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size) +
                            static_cast<std::size_t>(x))];
}

Thumbnail drawn(const mesh::Model& model, const ThumbnailOptions& options = {}, const JobContext& job = {}) {
  auto picture = drawThumbnail(model, options, job);
  EXPECT_TRUE(picture.ok()) << (picture.ok() ? "" : picture.error().text());
  return picture.ok() ? std::move(picture).value() : Thumbnail{};
}

/// An upright square metre that faces the viewer of a level view from the south.
mesh::Model board(const glm::vec4& colour) {
  mesh::Model model = quad({-0.5f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
  model.materials[0].baseColour = colour;
  return model;
}

ThumbnailOptions level() {
  ThumbnailOptions options;
  options.turnDeg = 0.0;
  options.aboveDeg = 0.0;
  options.size = 64;
  return options;
}

TEST(Thumbnail, ShowsThePlantsColourAndNothingBesideIt) {
  const Thumbnail picture = drawn(board({0.6f, 0.05f, 0.02f, 1.0f}), level());
  const std::uint8_t* middle = pixel(picture, 32, 32);
  EXPECT_EQ(middle[3], 255);
  EXPECT_GT(middle[0], 120);
  EXPECT_LT(middle[1], middle[0] / 2);
  for (const auto& [x, y] : {std::pair(0, 0), {63, 0}, {0, 63}, {63, 63}}) EXPECT_EQ(pixel(picture, x, y)[3], 0);
}

TEST(Thumbnail, FramesWhatItShows) {
  const ThumbnailOptions options = level();
  const Thumbnail picture = drawn(board({0.5f, 0.5f, 0.5f, 1.0f}), options);
  int rows = 0;
  for (int y = 0; y < options.size; ++y) rows += pixel(picture, 32, y)[3] == 255 ? 1 : 0;
  EXPECT_NEAR(rows, options.size * (1.0 - 2.0 * options.marginShare), 2.0);
}

TEST(Thumbnail, OutlinesAreSmooth) {
  mesh::Model slanted = quad({-0.4f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.31f}, {-0.31f, 0.0f, 0.5f});
  const Thumbnail picture = drawn(slanted, level());
  int between = 0;
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) between += picture.rgba[i] > 20 && picture.rgba[i] < 235;
  EXPECT_GT(between, 60);
}

TEST(Thumbnail, SeesThroughMasksAndBlendsTheRest) {
  mesh::Model masked = board({0.5f, 0.5f, 0.5f, 0.2f});
  masked.materials[0].alphaMode = mesh::AlphaMode::Mask;
  const Thumbnail nothing = drawn(masked, level());
  EXPECT_EQ(pixel(nothing, 32, 32)[3], 0);
  masked.materials[0].alphaMode = mesh::AlphaMode::Blend;
  masked.materials[0].baseColour.a = 0.5f;
  const Thumbnail half = drawn(masked, level());
  double mean = 0.0;
  for (int x = 20; x < 44; ++x) mean += pixel(half, x, 32)[3] / 24.0;
  EXPECT_NEAR(mean, 127.0, 25.0);
}

TEST(Thumbnail, CastsAShadowOnTheGround) {
  ThumbnailOptions options;
  options.turnDeg = 0.0;
  options.aboveDeg = 40.0;
  const Thumbnail picture = drawn(board({0.5f, 0.5f, 0.5f, 1.0f}), options);
  int shadow = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    shadow += picture.rgba[i + 3] > 40 && picture.rgba[i + 3] < 200 && picture.rgba[i] == 0 ? 1 : 0;
  }
  EXPECT_GT(shadow, 100);
  options.aboveDeg = -10.0;  // from below the ground nothing of it is seen
  const Thumbnail below = drawn(board({0.5f, 0.5f, 0.5f, 1.0f}), options);
  for (std::size_t i = 0; i < below.rgba.size(); i += 4) {
    ASSERT_TRUE(below.rgba[i] != 0 || below.rgba[i + 3] == 0);
  }
}

TEST(Thumbnail, IsTheSameOnAnyNumberOfThreads) {
  const mesh::Model grass = mesh::growGrass({}, 3);
  const Thumbnail one = drawn(grass, {}, {{}, {}, 1});
  EXPECT_EQ(drawn(grass, {}, {{}, {}, 3}).rgba, one.rgba);
  EXPECT_NE(drawn(mesh::growGrass({}, 4)).rgba, one.rgba);
}

TEST(Thumbnail, NothingIsTransparentAndRubbishIsAnError) {
  const Thumbnail empty = drawn(mesh::Model{});
  EXPECT_EQ(empty.rgba.size(), 128u * 128u * 4u);
  EXPECT_TRUE(std::all_of(empty.rgba.begin(), empty.rgba.end(), [](std::uint8_t v) { return v == 0; }));
  mesh::Model broken = board({0.5f, 0.5f, 0.5f, 1.0f});
  broken.positions[2].x = NAN;
  EXPECT_FALSE(drawThumbnail(broken, {}, {}).ok());
  ThumbnailOptions huge;
  huge.size = 100000;
  EXPECT_FALSE(drawThumbnail(board({1, 1, 1, 1}), huge, {}).ok());
}

}  // namespace
}  // namespace sward::trace
