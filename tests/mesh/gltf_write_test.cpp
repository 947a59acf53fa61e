#include "gltf_builder.h"

#include "base/file.h"
#include "base/random.h"
#include "image/colour.h"
#include "mesh/gltf_read.h"
#include "mesh/gltf_write.h"
#include "mesh/procedural.h"

#include <algorithm>
#include <cmath>

namespace sward::mesh {
namespace {

using GltfWrite = testing::GltfTest;

/// Two crossed cards with different materials, one textured, masked and with a texture transform.
Model crossedCards() {
  Model model;
  model.name = "cards";
  model.positions = {{-0.5f, 0, 0}, {0.5f, 0, 0}, {0.5f, 0, 1}, {-0.5f, 0, 1},
                     {0, -0.5f, 0}, {0, 0.5f, 0}, {0, 0.5f, 1}};
  model.normals = {{0, -1, 0}, {0, -1, 0}, {0, -1, 0}, {0, -1, 0}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const auto f = static_cast<float>(i) / 7.0f;
    model.uvs.emplace_back(f, 1.0f - f * 0.5f);
    model.colours.emplace_back(1.0f - f, 0.5f, f, 1.0f);
  }
  model.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}};
  model.triangleMaterial = {1, 1, 0};
  Material plain;
  plain.name = "plain";
  plain.baseColour = {0.2f, 0.3f, 0.4f, 1.0f};
  plain.doubleSided = false;
  plain.optics = {0.25, {1.0, 0.9, 0.8}};
  Material leaf;
  leaf.name = "leaf";
  leaf.texture = 0;
  leaf.alphaMode = AlphaMode::Mask;
  leaf.alphaCutoff = 0.35f;
  leaf.wrapS = false;
  leaf.uvFromMesh = glm::mat3(glm::vec3(2, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.25f, 0, 1));
  model.materials = {plain, leaf};
  image::Image texture(8, 4, 4);
  base::Random random(5);
  for (std::size_t i = 0; i < texture.pixels.size(); ++i) {
    texture.pixels[i] = i % 4 == 3 ? 1.0f : static_cast<float>(random.uniform());
  }
  model.textures = {texture};
  return model;
}

TEST_F(GltfWrite, roundTripKeepsShapeMaterialsAndSurface) {
  const Model model = crossedCards();
  const auto path = m_folder / "cards.glb";
  ASSERT_TRUE(writeGlb(path, model).ok());
  const Result<Model> back = readGltf(path);
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_TRUE(back->warnings.empty());
  ASSERT_EQ(back->triangles.size(), 3u);
  ASSERT_EQ(back->materials.size(), 2u);
  EXPECT_EQ(back->materials[0].name, "plain");
  EXPECT_FALSE(back->materials[0].doubleSided);
  EXPECT_EQ(back->materials[0].optics, model.materials[0].optics);
  EXPECT_EQ(back->materials[1].alphaMode, AlphaMode::Mask);
  EXPECT_FLOAT_EQ(back->materials[1].alphaCutoff, 0.35f);
  EXPECT_FALSE(back->materials[1].wrapS);
  EXPECT_TRUE(back->materials[1].wrapT);
  // Triangles come back grouped by material: 2, 0, 1.
  const std::uint32_t original[] = {2, 0, 1};
  for (std::uint32_t t = 0; t < 3; ++t) {
    const glm::uvec3 a = back->triangles[t], b = model.triangles[original[t]];
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(glm::length(back->positions[a[i]] - model.positions[b[i]]), 1e-6f);
      EXPECT_LT(glm::length(back->normals[a[i]] - model.normals[b[i]]), 1e-6f);
      EXPECT_LT(glm::length(back->colours[a[i]] - model.colours[b[i]]), 1e-6f);
    }
    for (const auto& [u, v] : {std::pair{0.1f, 0.2f}, {0.5f, 0.25f}, {0.05f, 0.9f}}) {
      const SurfaceSample x = surfaceAt(*back, t, u, v), y = surfaceAt(model, original[t], u, v);
      // Half a code value of sRGB at its steepest (slope 2.28 at white) is 0.0045.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(x.reflectance[c], y.reflectance[c], 0.005f) << t;
      EXPECT_EQ(x.alpha, y.alpha);
    }
  }
}

TEST_F(GltfWrite, proceduralPlantsRoundTrip) {
  GrassShape grass;
  grass.seedHeadShare = 0.3;
  for (const Model& model : {growGrass(grass, 4), growFlower({}, 4), growClover({}, 4)}) {
    const auto path = m_folder / (model.name + ".glb");
    ASSERT_TRUE(writeGlb(path, model).ok());
    const Result<Model> back = readGltf(path);
    ASSERT_TRUE(back.ok()) << back.error().text();
    EXPECT_EQ(back->triangles.size(), model.triangles.size());
    const Bounds a = bounds(*back), b = bounds(model);
    EXPECT_NEAR(a.high.z - a.low.z, b.high.z - b.low.z, 1e-6f);
    EXPECT_NEAR(a.high.x - a.low.x, b.high.x - b.low.x, 1e-6f);
    EXPECT_EQ(back->materials.front().optics, model.materials.front().optics);
  }
}

TEST_F(GltfWrite, refusesAnEmptyModelAndABadPlace) {
  EXPECT_FALSE(writeGlb(m_folder / "empty.glb", Model()).ok());
  EXPECT_FALSE(std::filesystem::exists(m_folder / "empty.glb"));
  const Result<void> nowhere = writeGlb(m_folder / "no" / "where.glb", crossedCards());
  ASSERT_FALSE(nowhere.ok());
  EXPECT_NE(nowhere.error().text().find("where.glb"), std::string::npos);
}

/// Writes a fresh file: truncating an old one makes some file systems flush it to the disk each time.
void overwrite(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// The bytes of a small .glb with a texture, an index accessor and vertex colours.
std::vector<std::byte> smallGlb(const std::filesystem::path& folder) {
  Model model = crossedCards();
  model.textures[0] = image::Image(2, 2, 3, 0.5f);
  EXPECT_TRUE(writeGlb(folder / "small.glb", model).ok());
  Result<std::vector<std::byte>> bytes = base::readFile(folder / "small.glb");
  EXPECT_TRUE(bytes.ok());
  return std::move(bytes).value();
}

TEST_F(GltfWrite, everyTruncatedLengthIsRefused) {
  const std::vector<std::byte> whole = smallGlb(m_folder);
  const auto path = m_folder / "cut.glb";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    overwrite(path, std::span(whole).first(length));
    const Result<Model> model = readGltf(path);
    ASSERT_FALSE(model.ok()) << length;
    ASSERT_EQ(model.error().kind, ErrorKind::BadInput);
  }
}

TEST_F(GltfWrite, flippedBytesNeverCrashAndNeverGiveAnUnsoundModel) {
  const std::vector<std::byte> whole = smallGlb(m_folder);
  const auto path = m_folder / "flipped.glb";
  base::Random random(20260801);
  int loaded = 0, refused = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::vector<std::byte> bytes = whole;
    const std::uint32_t flips = 1 + random.index(4);
    for (std::uint32_t i = 0; i < flips; ++i) {
      // A bit or a whole byte, so that digits of the JSON turn into other digits too.
      std::byte& target = bytes[random.index(static_cast<std::uint32_t>(bytes.size()))];
      target = random.index(2) == 0 ? target ^ static_cast<std::byte>(1u << random.index(8))
                                    : static_cast<std::byte>(random.index(256));
    }
    overwrite(path, bytes);
    const Result<Model> model = readGltf(path);
    (model.ok() ? loaded : refused) += 1;
    if (!model.ok()) continue;
    for (const glm::vec3& p : model->positions) ASSERT_TRUE(std::isfinite(p.x + p.y + p.z)) << trial;
    for (const glm::vec3& n : model->normals) ASSERT_NEAR(glm::length(n), 1.0f, 1e-3f) << trial;
    for (std::uint32_t t = 0; t < model->triangles.size(); ++t) {
      const SurfaceSample sample = surfaceAt(*model, t, 0.3f, 0.3f);
      ASSERT_TRUE(sample.alpha >= 0.0f && sample.alpha <= 1.0f) << trial;
    }
  }
  EXPECT_GT(loaded, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace sward::mesh
