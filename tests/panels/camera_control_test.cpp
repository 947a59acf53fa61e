#include "panels/camera_control.h"

#include "scene/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sward::editor {
namespace {

double distanceOf(const scene::View& view) {
  return glm::length(view.position - view.target);
}

TEST(CameraControl, OrbitKeepsTargetAndDistance) {
  scene::View view;
  const glm::dvec3 target = view.target;
  const double distance = distanceOf(view);
  orbit(view, 0.25, 0.1);
  EXPECT_NEAR(distanceOf(view), distance, 1e-9);
  EXPECT_EQ(view.target, target);
  // A whole turn returns; half a turn stands opposite.
  const glm::dvec3 before = view.position;
  orbit(view, 1.0, 0.0);
  EXPECT_NEAR(view.position.x - target.x, target.x - before.x, 1e-9);
  EXPECT_NEAR(view.position.y - target.y, target.y - before.y, 1e-9);
  orbit(view, 1.0, 0.0);
  EXPECT_NEAR(glm::length(view.position - before), 0.0, 1e-9);
}

TEST(CameraControl, NothingTurnsThePictureOver) {
  scene::View view;
  orbit(view, 0.0, 5.0);
  const auto above = scene::cameraFromView(view);
  ASSERT_TRUE(above.ok());
  EXPECT_GT(above->up.z, 0.0);
  EXPECT_LT(above->forward.z, -0.99);
  lookAround(view, 0.0, 5.0);
  ASSERT_TRUE(scene::cameraFromView(view).ok());
  EXPECT_GT(scene::cameraFromView(view)->up.z, 0.0);
}

TEST(CameraControl, TheEyeStaysAboveTheGround) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  scene::View view;
  for (int i = 0; i < 5000; ++i) {
    switch (i % 5) {
      case 0:
        orbit(view, any(random), any(random));
        break;
      case 1:
        pan(view, any(random), any(random), 1.6);
        break;
      case 2:
        dolly(view, 20.0 * any(random));
        break;
      case 3:
        fly(view, any(random), any(random), any(random));
        break;
      default:
        lookAround(view, any(random), any(random));
        break;
    }
    ASSERT_GE(view.position.z, kLeastEyeM - 1e-12) << "step " << i;
    ASSERT_TRUE(scene::cameraFromView(view).ok()) << "step " << i;
  }
}

TEST(CameraControl, PanKeepsTheTargetUnderTheMouse) {
  scene::View view;
  view.position = {0.0, -3.0, 2.0};
  view.target = {0.0, 0.0, 0.0};
  const double aspect = 1.5;
  // The picture's point that showed the target before now lies a tenth of the height to the right and above.
  scene::View moved = view;
  pan(moved, 0.1, -0.1, aspect);
  const auto camera = scene::cameraFromView(moved);
  ASSERT_TRUE(camera.ok());
  const glm::dvec3 toOld = view.target - moved.position;
  const double depth = glm::dot(toOld, camera->forward);
  const double x = glm::dot(toOld, camera->right) / depth / camera->tanHalfWidth * aspect / 2.0;
  const double y = glm::dot(toOld, camera->up) / depth / camera->tanHalfWidth * aspect / 2.0;
  EXPECT_NEAR(x, 0.1, 1e-9);
  EXPECT_NEAR(y, 0.1, 1e-9);
}

TEST(CameraControl, DollyNeverPassesTheTarget) {
  scene::View view;
  dolly(view, 1000.0);
  EXPECT_GT(distanceOf(view), 0.04);
  dolly(view, -1e6);
  EXPECT_LT(distanceOf(view), 3e4);
}

TEST(CameraControl, FrameFillsThePicture) {
  scene::View view;
  view.focalLengthMm = 36.0;
  frame(view, {5.0, 5.0, 0.0}, 1.0, 1.0);
  // A sphere of radius 1 touches the edges of the picture: sin(half angle) = 1 / distance.
  EXPECT_NEAR(1.0 / distanceOf(view), std::sin(std::atan(0.5)), 1e-9);
  EXPECT_EQ(view.target, glm::dvec3(5.0, 5.0, 0.0));
}

TEST(CameraControl, GroundPointIsWhereTheRayMeetsTheGround) {
  scene::View view;
  view.position = {1.0, 2.0, 4.0};
  view.target = {1.0, 6.0, 0.0};
  const auto middle = groundPoint(view, 0.5, 0.5, 1.7);
  ASSERT_TRUE(middle.has_value());
  EXPECT_NEAR(middle->x, 1.0, 1e-9);
  EXPECT_NEAR(middle->y, 6.0, 1e-9);
  EXPECT_NEAR(middle->z, 0.0, 1e-9);
  view.target = {1.0, 6.0, 8.0};
  EXPECT_FALSE(groundPoint(view, 0.5, 0.5, 1.7).has_value());
}

TEST(CameraControl, StandardViewsLookWhereTheySay) {
  scene::View view;
  view.target = {0.0, 0.0, 0.0};
  look(view, StandardView::Front, 2.0);
  EXPECT_LT(view.position.y, -1.9);
  look(view, StandardView::Side, 2.0);
  EXPECT_GT(view.position.x, 1.9);
  look(view, StandardView::Top, 2.0);
  EXPECT_GT(view.position.z, 1.99);
  const auto camera = scene::cameraFromView(view);
  ASSERT_TRUE(camera.ok());
  EXPECT_GT(camera->up.y, 0.99);  // north is up
}

}  // namespace
}  // namespace sward::editor
