#pragma once

#include "scene/lights.h"
#include "trace/reference.h"

#include "trace/test_patches.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace sward::trace::testing {

inline constexpr double kPi = std::numbers::pi;

/// The patch laid beside itself: one tile of one piece, as large as the patch.
inline GroundPlan plainPlan(double sideM, int texels) {
  GroundPlan plan;
  plan.patchSideM = sideM;
  plan.patchTexels = plan.tileTexels = texels;
  plan.offsets.push_back({glm::ivec2(0), glm::ivec2(0), glm::ivec2(0), glm::ivec2(0)});
  plan.owner.assign(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels), 0);
  plan.map.assign(1, 0);
  return plan;
}

/// A sun alone, of intensity 1.
inline scene::Daylight sunAt(double azimuthDeg, double elevationDeg, double intensity = 1.0) {
  scene::SunOptions sun;
  sun.intensity = intensity;
  return scene::Daylight(scene::directionFromAngles({azimuthDeg, elevationDeg}), sun, scene::SkyOptions{});
}

/// From `position` toward `target`, `tanHalfWidth` the tangent of half the width of the picture.
inline scene::Camera cameraAt(const glm::dvec3& position, const glm::dvec3& target, double tanHalfWidth) {
  scene::View view;
  view.position = position;
  view.target = target;
  scene::Camera camera = scene::cameraFromView(view).value();
  camera.tanHalfWidth = tanHalfWidth;
  return camera;
}

/// A scene with what it points to.
struct Stage {
  std::shared_ptr<scene::Patch> patch;
  std::unique_ptr<PatchScene> traced;
  GroundPlan plan;
  std::vector<glm::vec3> soil;
  scene::Daylight daylight = sunAt(0.0, 90.0);
  double hazeKm = 0.0;
  std::optional<glm::dvec3> uniformSky;

  std::unique_ptr<Reference> reference(const scene::Camera& camera, const ReferenceOptions& options) const {
    auto made = Reference::create({traced.get(), &plan, soil, daylight, hazeKm, uniformSky, {}}, camera, options);
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().text());
    return made.ok() ? std::move(made).value() : nullptr;
  }
  image::Image picture(const scene::Camera& camera, const ReferenceOptions& options, int samples) const {
    const auto made = reference(camera, options);
    EXPECT_TRUE(made->addSamples(samples, {}).ok());
    return made->mean();
  }
};

inline Stage stageOf(std::shared_ptr<scene::Patch> patch, int texels, const glm::vec3& soil) {
  Stage stage;
  stage.plan = plainPlan(patch->sideM, texels);
  stage.soil.assign(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels), soil);
  stage.traced = sceneOf(patch);
  stage.patch = std::move(patch);
  return stage;
}

/// A leaf over the whole square metre at a height, of reflectance r and transmittance t.
inline std::shared_ptr<scene::Patch> slabAt(float heightM, float reflectance, float transmittance) {
  mesh::Model slab = quad({0.0f, 0.0f, heightM}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  slab.materials[0].baseColour = {reflectance, reflectance, reflectance, 1.0f};
  slab.materials[0].optics.translucency = static_cast<double>(transmittance / reflectance);
  slab.materials[0].optics.transmissionTint = glm::dvec3(1.0);
  return patchOf(std::move(slab), 1.0, static_cast<double>(heightM));
}

inline ReferenceOptions smallPicture(int width = 24, int height = 16) {
  ReferenceOptions options;
  options.width = width;
  options.height = height;
  options.sky = false;
  options.sunRadiusDeg = 0.0;
  return options;
}

/// Mean of a channel over a picture.
inline double meanOf(const image::Image& picture, int channel = 1) {
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) sum += static_cast<double>(picture.at(x, y, channel));
  }
  return sum / (picture.width * picture.height);
}
/// Standard deviation of that mean, as the variance image has it.
inline double deviationOf(const image::Image& variance, int channel = 1) {
  return std::sqrt(meanOf(variance, channel) / (variance.width * variance.height));
}

}  // namespace sward::trace::testing
