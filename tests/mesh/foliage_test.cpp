#include "mesh/foliage.h"

#include "mesh/gltf_read.h"
#include "mesh/tree.h"

#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace sward::mesh {
namespace {

/// A square from (x, y, z) that leans by (0, 0, h), as two triangles.
void addCard(Model& model, std::uint32_t material, const glm::vec3& foot, float height) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  for (const glm::vec3& p :
       {foot, foot + glm::vec3(1, 0, 0), foot + glm::vec3(1, 0, height), foot + glm::vec3(0, 0, height)}) {
    model.positions.push_back(p);
    model.normals.emplace_back(0, -1, 0);
    model.uvs.emplace_back(0.0f);
    model.colours.emplace_back(1.0f);
  }
  model.triangles.emplace_back(first, first + 1, first + 2);
  model.triangles.emplace_back(first, first + 2, first + 3);
  model.triangleMaterial.insert(model.triangleMaterial.end(), 2, material);
}

Model twoMaterials(const char* first, const char* second) {
  Model model;
  model.materials.resize(2);
  model.materials[0].name = first;
  model.materials[1].name = second;
  addCard(model, 0, {0, 0, 0}, 4.0f);
  addCard(model, 1, {0, 0, 5}, 4.0f);
  addCard(model, 1, {3, 0, 6}, 4.0f);
  return model;
}

TEST(TreeParts, NamesDecideFirst) {
  for (const char* leaf : {"Leaves1", "OakLeaf", "pine_needles.002", "Laub", "FOLIAGE", "leef"}) {
    const auto parts = treeParts(twoMaterials(leaf, "treeBark_02"));
    EXPECT_EQ(parts[0].part, TreePart::Leaves) << leaf;
    EXPECT_EQ(parts[0].reason, "its name");
    EXPECT_EQ(parts[1].part, TreePart::Wood) << "though it stands above the foot";
  }
  // No word of these is a word of ours.
  for (const char* name : {"Cloverleafs", "Barker", "Material.001", "", "Woody"}) {
    EXPECT_NE(treeParts(twoMaterials(name, "x"))[0].reason, "its name") << name;
  }
}

TEST(TreeParts, AlphaIsOfLeavesAndTheFootIsWood) {
  Model model = twoMaterials("a", "b");
  auto parts = treeParts(model);
  EXPECT_EQ(parts[0].part, TreePart::Wood);
  EXPECT_EQ(parts[1].part, TreePart::Leaves);
  model.materials[0].alphaMode = AlphaMode::Mask;
  parts = treeParts(model);
  EXPECT_EQ(parts[0].part, TreePart::Leaves);
  EXPECT_EQ(parts[0].reason, "its alpha");
  const std::vector<TreePart> triangles = triangleParts(model, treeParts(twoMaterials("a", "b")));
  ASSERT_EQ(triangles.size(), 6u);
  EXPECT_EQ(triangles[0], TreePart::Wood);
  EXPECT_EQ(triangles[5], TreePart::Leaves);
}

TEST(TreeParts, EmptyAndUnusedMaterialsAreHarmless) {
  EXPECT_TRUE(treeParts(Model{}).empty());
  Model model = twoMaterials("a", "b");
  model.materials.emplace_back();
  EXPECT_EQ(treeParts(model).size(), 3u);
}

TEST(TreeParts, OwnTreesAreTold) {
  const Model tree = growTree(treePresets()[0].shape, 1);
  const auto parts = treeParts(tree);
  EXPECT_EQ(parts[0].part, TreePart::Wood);
  EXPECT_EQ(parts[1].part, TreePart::Leaves);
}

/// The trees of the assets, material by material: as anyone who looks at them would say.
TEST(TreeParts, TreesOfFiles) {
  const std::filesystem::path folder = std::filesystem::path(SWARD_SHARED_DIR) / "assets" / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no assets";
  constexpr TreePart W = TreePart::Wood, L = TreePart::Leaves;
  const std::map<std::string, std::map<std::string, TreePart>> expected{
      {"agargaro_tree.glb", {{"Default OBJ.002", L}, {"Default OBJ.003", W}}},
      {"quaternius_BirchTree_1.glb", {{"White", W}, {"Black", W}, {"DarkGreen", L}, {"Green", L}}},
      {"quaternius_BirchTree_Autumn_1.glb", {{"White", W}, {"Black", W}, {"LightOrange", L}, {"Orange", L}}},
      {"quaternius_CommonTree_1.glb", {{"Wood", W}, {"Green", L}}},
      {"quaternius_CommonTree_Dead_1.glb", {{"Wood", W}}},
      {"scatter_tree.glb", {{"Leaves1", L}, {"Trunk", W}}},
      {"scatter_bush.glb", {{"Bush", L}}}};
  for (const auto& [file, materials] : expected) {
    const auto model = readGltf(folder / file);
    ASSERT_TRUE(model.ok()) << model.error().text();
    const auto parts = treeParts(*model);
    ASSERT_EQ(model->materials.size(), materials.size()) << file;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string& name = model->materials[i].name;
      ASSERT_TRUE(materials.contains(name)) << file << ": " << name;
      EXPECT_EQ(parts[i].part, materials.at(name)) << file << ": " << name << ", by " << parts[i].reason;
    }
  }
}

}  // namespace
}  // namespace sward::mesh
