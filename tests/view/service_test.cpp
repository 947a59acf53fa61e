#include "view/fixture.h"

#include "image/io.h"
#include "render/frame_plan.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

namespace sward {
namespace {

using editor::Comparison;
using editor::ViewPicture;
using editor::ViewRequest;
using editor::ViewService;
using testing::smallRequest;
using testing::Viewer;

/// What `sward render` would put into its PNG for a request.
image::ByteImage rendered(const ViewRequest& request, gpu::Device device) {
  auto stage = testing::makeStage(device);
  const auto daylight = render::daylightOf(*request.project);
  EXPECT_TRUE(daylight.ok());
  EXPECT_TRUE(stage.renderer->setGround(request.ground).ok());
  stage.renderer->setDaylight(*daylight, request.project->sky.hazeKm);
  auto frame = render::planFrame(*request.project, request.view, *daylight);
  EXPECT_TRUE(frame.ok());
  frame->width = request.width;
  frame->height = request.height;
  const auto picture = stage.renderer->drawDisplay(*frame);
  EXPECT_TRUE(picture.ok());
  const auto png = image::encodePng(*picture);
  EXPECT_TRUE(png.ok());
  const auto read = image::readImage(*png, "picture", image::Encoding::Linear);
  EXPECT_TRUE(read.ok());
  image::ByteImage bytes{read->width, read->height, {}};
  for (std::size_t i = 0; i < read->pixels.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) bytes.rgba.push_back(image::toByte(read->pixels[i + c]));
    bytes.rgba.push_back(255);
  }
  return bytes;
}

class OnDevice : public ::testing::TestWithParam<gpu::Device> {};

TEST_P(OnDevice, TheFinalPictureIsWhatRenderWrites) {
  Viewer viewer(GetParam());
  for (const auto transform : {render::ViewTransform::Filmic, render::ViewTransform::Standard}) {
    ViewRequest request = smallRequest();
    auto project = testing::smallProject();
    project->render.viewTransform = transform;
    request.project = project;
    const auto picture = viewer.picture(request);
    ASSERT_TRUE(picture.has_value()) << viewer.service().error()->text();
    EXPECT_TRUE(picture->final);
    EXPECT_EQ(picture->samples, 6);
    const image::ByteImage expected = rendered(request, GetParam());
    EXPECT_EQ(picture->width, expected.width);
    EXPECT_EQ(picture->height, expected.height);
    EXPECT_EQ(picture->rgba, expected.rgba);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, OnDevice, ::testing::Values(gpu::Device::Egl, gpu::Device::OsMesa),
                         [](const auto& device) { return device.param == gpu::Device::Egl ? "egl" : "osmesa"; });

TEST(ViewService, AMovingPictureHasHalfTheSizeAndOneSample) {
  Viewer viewer;
  ViewRequest request = smallRequest();
  request.moving = true;
  request.width = 151;
  const auto picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->width, 76);
  EXPECT_EQ(picture->height, 45);
  EXPECT_EQ(picture->samples, 1);
  EXPECT_FALSE(picture->final);
}

}  // namespace
}  // namespace sward
