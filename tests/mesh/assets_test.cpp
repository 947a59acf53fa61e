#include "mesh/gltf_read.h"

#include "base/file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace sward::mesh {
namespace {

namespace fs = std::filesystem;

fs::path assets() {
  return fs::path(SWARD_SHARED_DIR) / "assets";
}

std::vector<fs::path> gltfFilesUnder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path extension = entry.path().extension();
    if (extension == ".glb" || extension == ".gltf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

void expectSound(const Model& model, const fs::path& file) {
  ASSERT_FALSE(model.empty()) << file;
  ASSERT_EQ(model.normals.size(), model.positions.size());
  ASSERT_EQ(model.uvs.size(), model.positions.size());
  ASSERT_EQ(model.colours.size(), model.positions.size());
  ASSERT_EQ(model.triangleMaterial.size(), model.triangles.size());
  for (const glm::vec3& n : model.normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-4f) << file;
  for (const glm::uvec3& t : model.triangles) {
    for (int i = 0; i < 3; ++i) ASSERT_LT(t[i], model.positions.size()) << file;
  }
  for (const std::uint32_t m : model.triangleMaterial) ASSERT_LT(m, model.materials.size());
  for (const Material& m : model.materials) ASSERT_LT(m.texture, static_cast<int>(model.textures.size()));
  const Bounds box = bounds(model);
  EXPECT_NEAR(box.low.z, 0.0f, 1e-6f * std::max(1.0f, box.high.z)) << file;
  EXPECT_NEAR(box.low.x, -box.high.x, 1e-4f * std::max(1.0f, box.high.x)) << file;
}

TEST(Assets, everyMeshLoadsOrSaysWhyNot) {
  if (!fs::exists(assets() / "meshes"))
    GTEST_SKIP() << assets() / "meshes"
                 << " is absent";
  const std::map<std::string, std::size_t> triangles = {{"agargaro_tree.glb", 5354},
                                                        {"eztree_flower_blue.glb", 788},
                                                        {"grass-trees.glb", 380},
                                                        {"grass.glb", 30},
                                                        {"polyhaven_moss_01.glb", 204},
                                                        {"quaternius_BirchTree_1.glb", 1704},
                                                        {"quaternius_CommonTree_1.glb", 2888},
                                                        {"quaternius_Grass.glb", 192},
                                                        {"quaternius_Plant_1.glb", 295},
                                                        {"quaternius_Plant_3.glb", 600},
                                                        {"quaternius_Wheat.glb", 408},
                                                        {"scatter_bush.glb", 42},
                                                        {"scatter_grass.glb", 10},
                                                        {"scatter_grass_2.glb", 6},
                                                        {"scatter_tree.glb", 4538}};
  std::size_t counted = 0;
  for (const fs::path& file : gltfFilesUnder(assets() / "meshes")) {
    const Result<Model> model = readGltf(file);
    if (file.filename() == "eztree_grass.glb") {
      ASSERT_FALSE(model.ok());
      EXPECT_NE(model.error().text().find("EXT_texture_webp"), std::string::npos);
      EXPECT_NE(model.error().remedy.find("PNG"), std::string::npos);
      continue;
    }
    ASSERT_TRUE(model.ok()) << model.error().text();
    expectSound(*model, file);
    EXPECT_TRUE(model->warnings.empty()) << file << ": " << model->warnings.front();
    const auto expected = triangles.find(file.filename().string());
    if (expected == triangles.end()) continue;
    EXPECT_EQ(model->triangles.size(), expected->second) << file;
    ++counted;
  }
  EXPECT_EQ(counted, triangles.size());
}

TEST(Assets, primitiveModes) {
  const fs::path folder = assets() / "gltf-edge/assimp/glTF-Asset-Generator/Mesh_PrimitiveMode";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const fs::path& file : gltfFilesUnder(folder)) {
    const Result<std::string> text = base::readTextFile(file);
    ASSERT_TRUE(text.ok());
    const nlohmann::json json = nlohmann::json::parse(*text);
    const int mode = json["meshes"][0]["primitives"][0].value("mode", 4);
    const Result<Model> model = readGltf(file);
    if (mode < 4) {
      ASSERT_FALSE(model.ok()) << file;
      EXPECT_NE(model.error().text().find("no triangles"), std::string::npos);
      continue;
    }
    ASSERT_TRUE(model.ok()) << model.error().text();
    EXPECT_EQ(model->triangles.size(), 2u) << file;
    // Both triangles of the square face the same way.
    for (const glm::vec3& n : model->normals) EXPECT_GT(glm::dot(n, model->normals[0]), 0.99f) << file;
  }
}

/// 'E' when the validator's report beside the file holds an error, 'W' otherwise, '?' without a report.
char verdictOf(const fs::path& file) {
  fs::path report = file;
  report += ".report.json";
  const Result<std::string> text = base::readTextFile(report);
  if (!text.ok()) return '?';
  const nlohmann::json json = nlohmann::json::parse(*text);
  return json["issues"]["numErrors"].get<int>() > 0 ? 'E' : 'W';
}

TEST(Assets, everyEdgeCaseEndsAsTheValidatorSays) {
  if (!fs::exists(assets() / "gltf-edge"))
    GTEST_SKIP() << assets() / "gltf-edge"
                 << " is absent";
  std::size_t files = 0, loaded = 0, sound = 0;
  for (const fs::path& file : gltfFilesUnder(assets() / "gltf-edge")) {
    ++files;
    const Result<Model> model = readGltf(file);
    if (model.ok()) {
      ++loaded;
      expectSound(*model, file);
      continue;
    }
    const std::string text = model.error().text();
    EXPECT_NE(text.find(file.filename().string()), std::string::npos) << text;
    EXPECT_FALSE(model.error().remedy.empty()) << text;
    if (verdictOf(file) != 'W') continue;
    // Nothing is wrong with these but that there is no triangle to draw; one has an accessor type that nobody knows.
    ++sound;
    const bool nothingToDraw = text.find("no triangle") != std::string::npos;
    EXPECT_TRUE(nothingToDraw || file.filename() == "unknown_type.gltf") << text;
  }
  EXPECT_EQ(files, 59u);
  EXPECT_GE(loaded, 14u);
  EXPECT_GT(sound, 3u);
}

TEST(Assets, knownEdgeCases) {
  const fs::path edge = assets() / "gltf-edge";
  if (!fs::exists(edge)) GTEST_SKIP() << edge << " is absent";
  const auto errorOf = [&](const char* name) {
    const Result<Model> model = readGltf(edge / name);
    return model.ok() ? std::string("loaded") : model.error().text();
  };
  EXPECT_NE(errorOf("assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb").find("not a finite number"),
            std::string::npos);
  EXPECT_NE(errorOf("assimp/MissingBin/BoxTextured.gltf").find("BoxTextured0.bin"), std::string::npos);
  EXPECT_NE(errorOf("assimp/RecursiveNodes/RecursiveNodes.gltf").find("cycle"), std::string::npos);
  EXPECT_NE(errorOf("required_draco/bruno_birchTreesVisual.glb").find("KHR_draco_mesh_compression"), std::string::npos);
  EXPECT_NE(errorOf("validator/asset/1_0_version.gltf").find("1.0"), std::string::npos);
  for (const char* name : {"CubeImageUriSpaces.gltf", "CubeImageUriMultipleSpaces.gltf"}) {
    const Result<Model> cube = readGltf(edge / "tinygltf/CubeImageUriSpaces" / name);
    ASSERT_TRUE(cube.ok()) << cube.error().text();
    EXPECT_TRUE(cube->warnings.empty()) << cube->warnings.front();
    EXPECT_EQ(cube->textures.size(), 1u);
  }
  const Result<Model> pine = readGltf(edge / "missing_normal_texture/Pine_5.gltf");
  ASSERT_TRUE(pine.ok()) << pine.error().text();
  EXPECT_EQ(pine->triangles.size(), 1646u);
  EXPECT_TRUE(hasAlpha(*pine));
  EXPECT_EQ(pine->textures.size(), 2u);  // the absent normal map is never asked for
}

}  // namespace
}  // namespace sward::mesh
