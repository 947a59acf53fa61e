// The viewport against the program itself: the picture of a project and a view is the one that `sward render` writes.
#include "view/fixture.h"

#include "bake/bake.h"
#include "bake/small_project.h"
#include "bake/temporary_folder.h"
#include "cli/run_program.h"
#include "image/io.h"

#include <gtest/gtest.h>

namespace sward {
namespace {

class RenderParity : public ::testing::TestWithParam<gpu::Device> {};

TEST_P(RenderParity, TheViewportsPictureIsThatOfTheCommand) {
  const test::TemporaryFolder folder(std::string("view") + (GetParam() == gpu::Device::Egl ? "egl" : "osmesa"));
  auto project = std::make_shared<project::Project>(bake::test::smallProject());
  project->render.samples = 5;
  project->sun.angles = {80.0, 20.0};
  project->views.front().exposureEv = -0.4;
  ASSERT_TRUE(project::save(*project, folder.path() / "p.sward").ok());
  const std::string cache = (folder.path() / "cache").string();
  const auto outcome =
      test::runProgram(folder.path(), {"render", "p.sward", "-o", "p.png", "--size", "161x97", "--cache", cache,
                                       "--device", GetParam() == gpu::Device::Egl ? "egl" : "osmesa"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  const auto png = image::readImage(folder.path() / "p.png", image::Encoding::Linear);
  ASSERT_TRUE(png.ok());

  auto disk = bake::DiskCache::open(cache);
  ASSERT_TRUE(disk.ok());
  bake::Baker baker(std::move(disk).value());
  auto ground = baker.ground(*project, {});
  ASSERT_TRUE(ground.ok());
  testing::Viewer viewer(GetParam());
  editor::ViewRequest request;
  request.project = project;
  request.ground = *ground;
  request.view = project->views.front();
  request.width = 161;
  request.height = 97;
  const auto picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  ASSERT_EQ(picture->width, png->width);
  ASSERT_EQ(picture->height, png->height);
  int colours = 0;
  for (std::size_t i = 0; i < png->pixels.size(); ++i) {
    const std::uint8_t written = image::toByte(png->pixels[i]);
    ASSERT_EQ(picture->rgba[i / 3 * 4 + i % 3], written) << i;
    colours += written > 20 ? 1 : 0;
  }
  EXPECT_GT(colours, 1000) << "there is something in the picture";

  // The same ground's inspection draws.
  const auto inspection = baker.inspection(*project, {});
  ASSERT_TRUE(inspection.ok());
  request.inspection = *inspection;
  for (const auto quantity : {render::ViewQuantity::Visibility, render::ViewQuantity::Condition}) {
    request.mode.quantity = quantity;
    EXPECT_TRUE(viewer.picture(request).has_value());
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, RenderParity, ::testing::Values(gpu::Device::Egl, gpu::Device::OsMesa),
                         [](const auto& device) { return device.param == gpu::Device::Egl ? "egl" : "osmesa"; });

}  // namespace
}  // namespace sward
