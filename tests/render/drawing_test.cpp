// Pictures that grow sample by sample, and their 8-bit values.
#include "render/fixture.h"

#include "image/io.h"

#include <gtest/gtest.h>

namespace sward {
namespace {

using testing::frameOf;
using testing::makeGround;
using testing::makeStage;
using testing::smallOptions;

testing::Stage litStage() {
  auto stage = makeStage();
  EXPECT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  stage.renderer->setDaylight(testing::daylightAt(140.0, 35.0));
  return stage;
}

render::Frame slanted(int samples) {
  return frameOf({0.2, -2.5, 1.1}, {0.2, 0.5, 0.1}, 97, 61, samples);
}

TEST(Drawing, WholePicturesAreTheSameInOneGoAndBySamples) {
  auto stage = litStage();
  const render::Frame frame = slanted(5);
  const auto whole = stage.renderer->drawDisplay(frame);
  ASSERT_TRUE(whole.ok());
  render::Drawing drawing;
  ASSERT_TRUE(stage.renderer->begin(drawing, frame).ok());
  for (int sample = 0; sample < 5; ++sample) {
    EXPECT_FALSE(drawing.complete());
    EXPECT_EQ(drawing.samples(), sample);
    ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
    // Reading in between disturbs nothing.
    image::ByteImage bytes;
    ASSERT_TRUE(stage.renderer->readBytes(drawing, bytes).ok());
  }
  EXPECT_TRUE(drawing.complete());
  const auto grown = stage.renderer->readDisplay(drawing);
  ASSERT_TRUE(grown.ok());
  EXPECT_EQ(grown->pixels, whole->pixels);
}

TEST(Drawing, WhatIsDrawnSoFarIsTheMeanOfItsSamples) {
  auto stage = litStage();
  render::Drawing drawing;
  ASSERT_TRUE(stage.renderer->begin(drawing, slanted(8)).ok());
  for (int sample = 0; sample < 3; ++sample) ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
  const auto part = stage.renderer->readLinear(drawing);
  // Samples take the same places whatever their number is.
  const auto expected = stage.renderer->drawLinear(slanted(3));
  ASSERT_TRUE(part.ok() && expected.ok());
  for (std::size_t i = 0; i < part->pixels.size(); ++i)
    ASSERT_NEAR(part->pixels[i], expected->pixels[i], 2e-6f * (1.0f + expected->pixels[i])) << i;
}

TEST(Drawing, BytesAreThoseOfThePng) {
  auto stage = litStage();
  for (const auto transform : {render::ViewTransform::Filmic, render::ViewTransform::Standard}) {
    render::Frame frame = slanted(4);
    frame.options.viewTransform = transform;
    frame.exposure = 3.0;
    render::Drawing drawing;
    ASSERT_TRUE(stage.renderer->begin(drawing, frame).ok());
    ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
    ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
    image::ByteImage bytes;
    ASSERT_TRUE(stage.renderer->readBytes(drawing, bytes).ok());
    const auto display = stage.renderer->readDisplay(drawing);
    ASSERT_TRUE(display.ok());
    ASSERT_EQ(bytes.rgba.size() / 4, display->pixels.size() / 3);
    for (std::size_t i = 0; i < display->pixels.size(); ++i)
      ASSERT_EQ(bytes.rgba[i / 3 * 4 + i % 3], image::toByte(display->pixels[i])) << i;
  }
}

TEST(Drawing, ColumnsAloneAreThoseOfTheWholePicture) {
  auto stage = litStage();
  render::Frame frame = slanted(3);
  render::Drawing whole, left, right;
  image::ByteImage expected, joined;
  const auto draw = [&](render::Drawing& drawing, image::ByteImage& out) {
    ASSERT_TRUE(stage.renderer->begin(drawing, frame).ok());
    while (!drawing.complete()) ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
    ASSERT_TRUE(stage.renderer->readBytes(drawing, out).ok());
  };
  draw(whole, expected);
  frame.columns = render::Columns{0, 41};
  draw(left, joined);
  EXPECT_NE(joined.rgba, expected.rgba);
  frame.columns = render::Columns{41, 97};
  draw(right, joined);
  EXPECT_EQ(joined.rgba, expected.rgba);
}

TEST(Drawing, TwoPicturesOfOneRendererDoNotDisturbEachOther) {
  auto stage = litStage();
  render::Frame march = slanted(3), blended = slanted(3);
  blended.options.method = render::GroundMethod::BlendedNormalised;
  blended.mode.quantity = render::ViewQuantity::Albedo;
  render::Drawing a, b;
  ASSERT_TRUE(stage.renderer->begin(a, march).ok());
  ASSERT_TRUE(stage.renderer->begin(b, blended).ok());
  while (!a.complete()) {
    ASSERT_TRUE(stage.renderer->addSample(a).ok());
    ASSERT_TRUE(stage.renderer->addSample(b).ok());
  }
  const auto first = stage.renderer->readDisplay(a), second = stage.renderer->readDisplay(b);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first->pixels, stage.renderer->drawDisplay(march)->pixels);
  EXPECT_EQ(second->pixels, stage.renderer->drawDisplay(blended)->pixels);
}

TEST(Drawing, RefusesWhatWouldMixPictures) {
  auto stage = litStage();
  render::Drawing drawing;
  image::ByteImage bytes;
  EXPECT_FALSE(stage.renderer->addSample(drawing).ok()) << "never begun";
  EXPECT_FALSE(stage.renderer->readBytes(drawing, bytes).ok());
  ASSERT_TRUE(stage.renderer->begin(drawing, slanted(2)).ok());
  EXPECT_FALSE(stage.renderer->readBytes(drawing, bytes).ok()) << "nothing drawn yet";
  ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
  stage.renderer->setDaylight(testing::daylightAt(20.0, 10.0));
  EXPECT_FALSE(stage.renderer->addSample(drawing).ok()) << "another light within a picture";
  ASSERT_TRUE(stage.renderer->begin(drawing, slanted(2)).ok());
  ASSERT_TRUE(stage.renderer->setGround(makeGround(smallOptions())).ok());
  EXPECT_FALSE(stage.renderer->addSample(drawing).ok()) << "another ground within a picture";
  ASSERT_TRUE(stage.renderer->begin(drawing, slanted(1)).ok());
  ASSERT_TRUE(stage.renderer->addSample(drawing).ok());
  EXPECT_FALSE(stage.renderer->addSample(drawing).ok()) << "complete";
}

}  // namespace
}  // namespace sward
