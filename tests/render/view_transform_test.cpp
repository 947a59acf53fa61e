#include "image/colour.h"
#include "render/renderer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward::render {
namespace {

float shown(float linear, ViewTransform transform) {
  image::Image pixel(1, 1, 3, linear);
  return toDisplay(pixel, transform).at(0, 0, 1);
}

TEST(ViewTransform, StandardIsSrgbAndClamps) {
  for (const float v : {0.0f, 0.002f, 0.18f, 0.7f, 1.0f})
    EXPECT_NEAR(shown(v, ViewTransform::Standard), image::srgbFromLinear(v), 1e-6f);
  EXPECT_FLOAT_EQ(shown(5.0f, ViewTransform::Standard), 1.0f);
  EXPECT_EQ(shown(-1.0f, ViewTransform::Standard), 0.0f);
}

TEST(ViewTransform, FilmicRisesAndNeverLeavesTheRange) {
  float last = -1.0f;
  for (int i = -40; i <= 40; ++i) {
    const float value = shown(std::exp2(static_cast<float>(i) * 0.25f), ViewTransform::Filmic);
    EXPECT_GE(value, last);
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 1.0f);
    last = value;
  }
  EXPECT_EQ(shown(0.0f, ViewTransform::Filmic), 0.0f);
}

TEST(ViewTransform, FilmicKeepsMidGreyNearMidGreyAndNeutral) {
  EXPECT_NEAR(shown(0.18f, ViewTransform::Filmic), image::srgbFromLinear(0.18f), 0.05f);
  const auto grey = toDisplay(image::Image(1, 1, 3, 0.4f), ViewTransform::Filmic).rgb(0, 0);
  EXPECT_NEAR(grey.r, grey.g, 2e-3f);
  EXPECT_NEAR(grey.b, grey.g, 2e-3f);
}

TEST(ViewTransform, FilmicRollsHighlightsOffWhereStandardClips) {
  EXPECT_LT(shown(1.0f, ViewTransform::Filmic), 0.97f);
  EXPECT_GT(shown(8.0f, ViewTransform::Filmic), shown(1.0f, ViewTransform::Filmic));
}

}  // namespace
}  // namespace sward::render
