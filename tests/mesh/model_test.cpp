#include "mesh/model.h"

#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::mesh {
namespace {

/// One triangle whose uv equal its barycentric (u, v).
Model unitTriangle(const image::Image& texture) {
  Model model;
  model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  model.normals.assign(3, {0, 0, 1});
  model.uvs = {{0, 0}, {1, 0}, {0, 1}};
  model.colours.assign(3, glm::vec4(1.0f));
  model.triangles = {{0, 1, 2}};
  model.triangleMaterial = {0};
  Material material;
  material.texture = texture.empty() ? -1 : 0;
  material.optics.translucency = 0.0;
  model.materials = {material};
  if (!texture.empty()) model.textures = {texture};
  return model;
}

image::Image fourTexels() {
  image::Image image(2, 2, 3);
  const float values[4] = {0.0f, 0.2f, 0.4f, 0.8f};  // left to right, top to bottom
  for (int i = 0; i < 4; ++i) {
    for (int c = 0; c < 3; ++c) image.at(i % 2, i / 2, c) = values[i];
  }
  return image;
}

TEST(Surface, bilinearHitsTexelCentresAndBlendsBetween) {
  const Model model = unitTriangle(fourTexels());
  EXPECT_FLOAT_EQ(surfaceAt(model, 0, 0.25f, 0.25f).reflectance.r, 0.0f);
  EXPECT_FLOAT_EQ(surfaceAt(model, 0, 0.75f, 0.25f).reflectance.r, 0.2f);
  EXPECT_FLOAT_EQ(surfaceAt(model, 0, 0.25f, 0.75f).reflectance.r, 0.4f);
  EXPECT_NEAR(surfaceAt(model, 0, 0.5f, 0.5f).reflectance.r, 0.35f, 1e-6f);
}

TEST(Surface, wrapRepeatsOrClamps) {
  Model model = unitTriangle(fourTexels());
  // At the corner (0, 0) repeating mixes all four texels, clamping shows the first alone.
  EXPECT_NEAR(surfaceAt(model, 0, 0.0f, 0.0f).reflectance.r, 0.35f, 1e-6f);
  model.materials[0].wrapS = model.materials[0].wrapT = false;
  EXPECT_FLOAT_EQ(surfaceAt(model, 0, 0.0f, 0.0f).reflectance.r, 0.0f);
  model.materials[0].wrapS = true;
  for (glm::vec2& uv : model.uvs) uv.x -= 1000.0f;
  EXPECT_NEAR(surfaceAt(model, 0, 0.75f, 0.25f).reflectance.r, 0.2f, 1e-3f);
  for (glm::vec2& uv : model.uvs) uv.x = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(std::isfinite(surfaceAt(model, 0, 0.3f, 0.3f).reflectance.r));
}

TEST(Surface, uvTransformIsApplied) {
  Model model = unitTriangle(fourTexels());
  model.materials[0].uvFromMesh = glm::mat3(glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.5f, 0.0f, 1));
  EXPECT_NEAR(surfaceAt(model, 0, 0.25f, 0.25f).reflectance.r, 0.2f, 1e-6f);
}

TEST(Surface, transparentTexelsDoNotBleedIntoTheColour) {
  image::Image image(2, 1, 4);
  for (int c = 0; c < 3; ++c) image.at(0, 0, c) = 0.5f;  // opaque grey beside a transparent black
  image.at(0, 0, 3) = 1.0f;
  Model model = unitTriangle(image);
  model.materials[0].alphaMode = AlphaMode::Blend;
  model.materials[0].wrapS = false;
  const SurfaceSample sample = surfaceAt(model, 0, 0.5f, 0.2f);
  EXPECT_NEAR(sample.alpha, 0.5f, 1e-6f);
  EXPECT_NEAR(sample.reflectance.r, 0.5f, 1e-6f);
}

TEST(Surface, reflectanceAndTransmittanceNeverPassOne) {
  Model model = unitTriangle({});
  base::Random random(9);
  for (int i = 0; i < 1000; ++i) {
    Material& material = model.materials[0];
    material.baseColour = glm::vec4(random.uniform(0, 2), random.uniform(), random.uniform(), 1.0);
    material.optics.translucency = random.uniform();
    material.optics.transmissionTint = {random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3)};
    const SurfaceSample sample = surfaceAt(model, 0, 0.2f, 0.3f);
    for (int c = 0; c < 3; ++c) {
      ASSERT_LE(sample.reflectance[c] + sample.transmittance[c], 1.0f + 1e-6f);
      const float wanted = static_cast<float>(material.optics.translucency * material.optics.transmissionTint[c]);
      // The ratio of the two is kept where both are scaled down.
      ASSERT_NEAR(sample.transmittance[c], wanted * sample.reflectance[c], 1e-5f);
    }
  }
}

TEST(Surface, vertexColoursInterpolate) {
  Model model = unitTriangle({});
  model.colours = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  const SurfaceSample sample = surfaceAt(model, 0, 0.25f, 0.5f);
  EXPECT_FLOAT_EQ(sample.reflectance.r, 0.25f);
  EXPECT_FLOAT_EQ(sample.reflectance.g, 0.25f);
  EXPECT_FLOAT_EQ(sample.reflectance.b, 0.5f);
}

TEST(Surface, opaqueIgnoresAlphaAndMaskCuts) {
  Model model = unitTriangle({});
  model.materials[0].baseColour.a = 0.4f;
  EXPECT_FALSE(hasAlpha(model));
  EXPECT_EQ(alphaAt(model, 0, 0.2f, 0.2f), 1.0f);
  model.materials[0].alphaMode = AlphaMode::Mask;
  EXPECT_TRUE(hasAlpha(model));
  EXPECT_EQ(alphaAt(model, 0, 0.2f, 0.2f), 0.0f);
  model.materials[0].alphaCutoff = 0.4f;
  EXPECT_EQ(surfaceAt(model, 0, 0.2f, 0.2f).alpha, 1.0f);
}

TEST(Bounds, coverUsedVerticesOnly) {
  Model model = unitTriangle({});
  model.positions.emplace_back(50.0f, 50.0f, 50.0f);
  EXPECT_EQ(bounds(model).high, glm::vec3(1, 1, 0));
  EXPECT_EQ(bounds(Model()).high, glm::vec3(0.0f));
}

}  // namespace
}  // namespace sward::mesh
