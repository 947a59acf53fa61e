#pragma once

#include "scene/patch.h"
#include "trace/layers.h"
#include "trace/patch_scene.h"

#include <array>
#include <memory>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

/// Hand-made patches: every expected value in the tests follows from a few rectangles.
namespace sward::trace::testing {

inline mesh::Material plainMaterial() {
  mesh::Material material;
  material.baseColour = {0.2f, 0.4f, 0.1f, 1.0f};
  return material;
}

/// The parallelogram corner + s * a + t * b, its normal along a x b.
inline void addQuad(mesh::Model& model, const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
  if (model.materials.empty()) model.materials.push_back(plainMaterial());
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(a, b));
  for (const glm::vec2 st : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
    model.positions.push_back(corner + st.x * a + st.y * b);
    model.normals.push_back(normal);
    model.uvs.push_back(st);
    model.colours.emplace_back(1.0f);
  }
  model.triangles.emplace_back(first, first + 1, first + 2);
  model.triangles.emplace_back(first, first + 2, first + 3);
  model.triangleMaterial.insert(model.triangleMaterial.end(), 2, 0u);
}

inline mesh::Model quad(const glm::vec3& corner, const glm::vec3& a, const glm::vec3& b) {
  mesh::Model model;
  addQuad(model, corner, a, b);
  return model;
}

/// A patch of one model standing at each of `feet`.
inline std::shared_ptr<scene::Patch> patchOf(mesh::Model model, double sideM, double heightM,
                                             const std::vector<glm::vec3>& feet = {glm::vec3(0.0f)}) {
  auto patch = std::make_shared<scene::Patch>();
  patch->sideM = sideM;
  patch->heightM = heightM;
  patch->models.push_back(std::make_shared<mesh::Model>(std::move(model)));
  for (const glm::vec3& foot : feet) {
    scene::Instance instance;
    instance.worldFromModel[3] = foot;
    patch->instances.push_back(instance);
  }
  return patch;
}

inline std::unique_ptr<PatchScene> sceneOf(const std::shared_ptr<scene::Patch>& patch) {
  auto scene = PatchScene::create(patch);
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().text());
  return scene.ok() ? std::move(scene).value() : nullptr;
}

/// Small enough for hundreds of tests.
inline SamplingOptions smallOptions() {
  SamplingOptions options;
  options.sliceResolution = 16;
  options.slices = 4;
  options.bladeWidth = 16;
  options.bladeHeight = 8;
  options.blades = 4;
  options.sliceSubSamples = 4;
  options.bladeSubSamples = 2;
  options.visibilityDirections = 16;
  return options;
}

inline LayerHits hitsOf(const PatchScene& scene, LayerSet set, const SamplingOptions& options) {
  auto hits = sampleHits(scene, set, options, {});
  EXPECT_TRUE(hits.ok());
  return std::move(hits).value();
}

inline LayerLuminance lightOn(const PatchScene& scene, const LayerHits& hits, const glm::dvec3& light) {
  auto luminance = sampleLuminance(scene, hits, glm::normalize(light), {});
  EXPECT_TRUE(luminance.ok());
  return std::move(luminance).value();
}

/// Coverage of one layer of one column, 0 where it has no texel.
inline float coverageAt(const LayerHits& hits, int x, int y, int layer) {
  const auto column = static_cast<std::size_t>(y * hits.shape.width + x);
  for (std::uint32_t t = hits.columnStart[column]; t < hits.columnStart[column + 1]; ++t) {
    if (hits.layer[t] == layer) return hits.coverage(t);
  }
  return 0.0f;
}

/// A few bent blades and a half-transparent leaf on a square metre: something of everything, for determinism.
inline std::shared_ptr<scene::Patch> smallMeadow() {
  mesh::Model tuft;
  for (int blade = 0; blade < 5; ++blade) {
    const float angle = 1.3f * static_cast<float>(blade);
    const glm::vec3 out(std::cos(angle), std::sin(angle), 0.0f), across(-out.y, out.x, 0.0f);
    glm::vec3 foot = 0.02f * out - 0.01f * across;
    for (int segment = 0; segment < 3; ++segment) {
      const float lean = 0.15f + 0.3f * static_cast<float>(segment);
      const glm::vec3 up = 0.1f * (std::sin(lean) * out + std::cos(lean) * glm::vec3(0.0f, 0.0f, 1.0f));
      addQuad(tuft, foot, 0.02f * across, up);
      foot += up;
    }
  }
  mesh::Model leaf = quad({-0.05f, -0.05f, 0.12f}, {0.1f, 0.0f, 0.02f}, {0.0f, 0.1f, 0.0f});
  leaf.materials[0].alphaMode = mesh::AlphaMode::Blend;
  leaf.materials[0].baseColour.a = 0.5f;
  scene::PlantScatter grass, leaves;
  grass.count = 60.0;
  grass.models = {0};
  leaves.count = 15.5;
  leaves.clumping = 0.7;
  leaves.models = {1};
  std::vector<std::shared_ptr<const mesh::Model>> models{std::make_shared<mesh::Model>(std::move(tuft)),
                                                         std::make_shared<mesh::Model>(std::move(leaf))};
  return std::make_shared<scene::Patch>(scene::scatter(1.0, std::move(models), {grass, leaves}, 7));
}

/// A closed box. Sizes that are exact in float, so that its corners meet.
inline void addBox(mesh::Model& model, const glm::vec3& low, const glm::vec3& size) {
  const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z), high = low + size;
  for (const auto& [corner, a, b] :
       {std::array{low, y, x}, {low, x, z}, {low, z, y}, {high, -x, -y}, {high, -z, -x}, {high, -y, -z}}) {
    addQuad(model, corner, a, b);
  }
}

}  // namespace sward::trace::testing
