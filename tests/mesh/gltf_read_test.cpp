#include "gltf_builder.h"

#include "image/io.h"
#include "mesh/gltf_read.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::mesh {
namespace {

using testing::GltfBuilder;
using testing::GltfTest;

class GltfRead : public GltfTest {
 protected:
  Result<Model> read(const GltfBuilder& builder, const GltfReadOptions& options = {}) const {
    return readGltf(write("model.gltf", builder.text()), options);
  }
  void expectError(const GltfBuilder& builder, const std::string& part) const {
    const Result<Model> model = read(builder);
    ASSERT_FALSE(model.ok()) << part;
    EXPECT_NE(model.error().text().find(part), std::string::npos) << model.error().text();
    EXPECT_NE(model.error().text().find("model.gltf"), std::string::npos) << model.error().text();
    EXPECT_EQ(model.error().kind, ErrorKind::BadInput);
  }
  std::string png(const std::string& name, const glm::vec4& colour) const {
    image::Image image(2, 2, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = colour[static_cast<int>(i % 4)];
    EXPECT_TRUE(image::writePng(m_folder / name, image).ok());
    return name;
  }
  static void addTexture(GltfBuilder& builder, const std::string& uri) {
    builder.json["images"] = {{{"uri", uri}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    builder.primitive()["material"] = 0;
  }
};

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-6f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST_F(GltfRead, turnsYUpIntoZUpStandsAndCentres) {
  const Result<Model> model = read(GltfBuilder().triangle());
  ASSERT_TRUE(model.ok()) << model.error().text();
  ASSERT_EQ(model->triangles.size(), 1u);
  expectNear(model->positions[0], {-0.5f, 0.0f, 0.0f});
  expectNear(model->positions[1], {0.5f, 0.0f, 0.0f});
  expectNear(model->positions[2], {-0.5f, 0.0f, 2.0f});
  // The front of the triangle faces +z of glTF, which is -y here; a missing normal is flat.
  for (const glm::vec3& n : model->normals) expectNear(n, {0.0f, -1.0f, 0.0f});
  EXPECT_EQ(model->colours[0], glm::vec4(1.0f));
}

TEST_F(GltfRead, scalesToAHeightAndRefusesOneThatCannotBe) {
  const Result<Model> model = read(GltfBuilder().triangle(), {.heightM = 0.5, .material = {}});
  ASSERT_TRUE(model.ok());
  const Bounds box = bounds(*model);
  EXPECT_FLOAT_EQ(box.high.z, 0.5f);
  EXPECT_FLOAT_EQ(box.high.x - box.low.x, 0.25f);
  EXPECT_FALSE(read(GltfBuilder().triangle(), {.heightM = 0.0, .material = {}}).ok());
  GltfBuilder flat;
  flat.primitive()["attributes"]["POSITION"] =
      flat.accessor(std::vector<float>{0, 3, 0, 1, 3, 0, 0, 3, 1}, "VEC3", 5126, 3);
  EXPECT_TRUE(read(flat).ok());
  const Result<Model> none = read(flat, {.heightM = 1.0, .material = {}});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().text().find("no height"), std::string::npos);
}

TEST_F(GltfRead, nodeTransformsMultiplyAndMirrorsKeepTheFront) {
  GltfBuilder builder;
  builder.triangle();
  builder.json["nodes"] = {
      {{"children", {1}}, {"translation", {5, 0, 0}}, {"scale", {2, 2, 2}}},
      {{"mesh", 0}, {"scale", {-1, 1, 1}}, {"rotation", {0, 0.7071067811865476, 0, 0.7071067811865476}}}};
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok()) << model.error().text();
  const Bounds box = bounds(*model);
  EXPECT_NEAR(box.high.z, 4.0f, 1e-5f);
  EXPECT_NEAR(box.high.x - box.low.x, 0.0f, 1e-5f);  // turned by 90 degrees about glTF's y
  EXPECT_NEAR(box.high.y - box.low.y, 2.0f, 1e-5f);
  const glm::uvec3 t = model->triangles[0];
  const glm::vec3 face = glm::normalize(
      glm::cross(model->positions[t.y] - model->positions[t.x], model->positions[t.z] - model->positions[t.x]));
  // glTF's +z turns to +x by the rotation; mirroring x first leaves +z alone.
  expectNear(face, {1.0f, 0.0f, 0.0f}, 1e-5f);
  expectNear(model->normals[t.x], face, 1e-5f);
}

TEST_F(GltfRead, givenNormalsFollowNonUniformScale) {
  GltfBuilder builder;
  builder.triangle();
  const float h = std::sqrt(0.5f);
  builder.primitive()["attributes"]["NORMAL"] =
      builder.accessor(std::vector<float>{h, 0, h, h, 0, h, h, 0, h}, "VEC3", 5126, 3);
  builder.json["nodes"][0]["scale"] = {2, 1, 1};
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok());
  // The inverse transpose halves x: (0.5, 0, 1) normalised, then y up becomes z up.
  expectNear(model->normals[0], glm::normalize(glm::vec3(0.5f, -1.0f, 0.0f)));
}

TEST_F(GltfRead, sparseAccessorsReplaceElements) {
  GltfBuilder builder;
  builder.triangle();
  const int indices = builder.view(std::vector<std::uint16_t>{0, 2});
  const int values = builder.view(std::vector<float>{-1, 0, 0, 0, 4, 0});
  builder.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", values}}}};
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok()) << model.error().text();
  const Bounds box = bounds(*model);
  EXPECT_FLOAT_EQ(box.high.x - box.low.x, 2.0f);
  EXPECT_FLOAT_EQ(box.high.z, 4.0f);

  GltfBuilder zeros = builder;  // without a buffer view the base is zero
  zeros.json["accessors"][0].erase("bufferView");
  zeros.json["accessors"][0]["sparse"]["values"]["bufferView"] = zeros.view(std::vector<float>{1, 0, 0, 0, 3, 0});
  const Result<Model> fromZero = read(zeros);
  ASSERT_TRUE(fromZero.ok()) << fromZero.error().text();
  EXPECT_FLOAT_EQ(bounds(*fromZero).high.z, 3.0f);

  GltfBuilder outside = builder;
  outside.json["accessors"][0]["sparse"]["indices"]["bufferView"] = outside.view(std::vector<std::uint16_t>{0, 3});
  expectError(outside, "sparse index 3");
  GltfBuilder unordered = builder;
  unordered.json["accessors"][0]["sparse"]["indices"]["bufferView"] = unordered.view(std::vector<std::uint16_t>{2, 0});
  expectError(unordered, "out of order");
}

TEST_F(GltfRead, normalisedAndQuantisedAccessors) {
  GltfBuilder builder;
  builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  builder.primitive()["attributes"]["POSITION"] =
      builder.accessor(std::vector<std::int16_t>{-32768, 0, 0, 32767, 0, 0, 0, 32767, 0}, "VEC3", 5122, 3, true);
  builder.primitive()["attributes"]["COLOR_0"] = builder.accessor(
      std::vector<std::uint8_t>{255, 0, 51, 128, 255, 0, 51, 128, 255, 0, 51, 128}, "VEC4", 5121, 3, true);
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.accessor(std::vector<std::uint16_t>{0, 65535, 0, 65535, 0, 65535}, "VEC2", 5123, 3, true);
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok()) << model.error().text();
  const Bounds box = bounds(*model);
  EXPECT_FLOAT_EQ(box.high.x - box.low.x, 2.0f);  // -32768 clamps to -1
  EXPECT_FLOAT_EQ(model->colours[0].b, 0.2f);
  EXPECT_FLOAT_EQ(model->colours[0].a, 128.0f / 255.0f);
  EXPECT_FLOAT_EQ(model->uvs[0].y, 1.0f);
}

TEST_F(GltfRead, colourWithoutAlphaIsOpaqueInEveryComponentType) {
  GltfBuilder builder;
  builder.triangle();
  builder.primitive()["attributes"]["COLOR_0"] = builder.accessor(
      std::vector<std::uint16_t>{65535, 0, 13107, 65535, 0, 13107, 65535, 0, 13107}, "VEC3", 5123, 3, true);
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok()) << model.error().text();
  EXPECT_FLOAT_EQ(model->colours[1].r, 1.0f);
  EXPECT_NEAR(model->colours[1].b, 0.2f, 1e-6f);
  EXPECT_EQ(model->colours[1].a, 1.0f);
}

TEST_F(GltfRead, stripsAndFansKeepTheirWinding) {
  for (const int mode : {5, 6}) {
    GltfBuilder builder;
    // A unit square in the order that the mode wants, all facing +z of glTF.
    builder.primitive()["attributes"]["POSITION"] =
        mode == 5 ? builder.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 5126, 4)
                  : builder.accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 5126, 4);
    builder.primitive()["mode"] = mode;
    const Result<Model> model = read(builder);
    ASSERT_TRUE(model.ok()) << model.error().text();
    ASSERT_EQ(model->triangles.size(), 2u);
    for (const glm::vec3& n : model->normals) expectNear(n, {0.0f, -1.0f, 0.0f});
  }
}

TEST_F(GltfRead, textureTransformScalesTurnsAndMoves) {
  GltfBuilder builder;
  builder.triangle();
  addTexture(builder, png("leaf.png", glm::vec4(1.0f)));
  builder.json["extensionsRequired"] = {"KHR_texture_transform"};
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"rotation", 1.5707963267948966}};
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok()) << model.error().text();
  const glm::vec3 uv = model->materials[0].uvFromMesh * glm::vec3(0.1f, 0.2f, 1.0f);
  // Scaled (0.2, 0.6); a quarter turn counter-clockwise with v down is (v, -u); then moved.
  EXPECT_NEAR(uv.x, 0.85f, 1e-6f);
  EXPECT_NEAR(uv.y, 0.3f, 1e-6f);
}

TEST_F(GltfRead, alphaModesTexturesAndFactors) {
  GltfBuilder builder;
  builder.triangle();
  addTexture(builder, png("half.png", {1.0f, 0.5f, 0.0f, 0.4f}));
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1.0, 1.0, 0.5};
  builder.json["materials"][0]["alphaMode"] = "BLEND";
  const Result<Model> blend = read(builder);
  ASSERT_TRUE(blend.ok()) << blend.error().text();
  EXPECT_TRUE(hasAlpha(*blend));
  const SurfaceSample sample = surfaceAt(*blend, 0, 0.3f, 0.3f);
  EXPECT_NEAR(sample.alpha, 0.5f * 102.0f / 255.0f, 1e-5f);
  EXPECT_FLOAT_EQ(alphaAt(*blend, 0, 0.3f, 0.3f), sample.alpha);
  EXPECT_GT(sample.reflectance.g, 0.1f);

  builder.json["materials"][0]["alphaMode"] = "MASK";
  builder.json["materials"][0]["alphaCutoff"] = 0.1;
  const Result<Model> mask = read(builder);
  ASSERT_TRUE(mask.ok());
  EXPECT_EQ(alphaAt(*mask, 0, 0.3f, 0.3f), 1.0f);

  GltfReadOptions options;
  options.material = MaterialOverride{glm::dvec3(0.1, 0.2, 0.3), 0.9, {}};
  const Result<Model> replaced = read(builder, options);
  ASSERT_TRUE(replaced.ok());
  EXPECT_EQ(alphaAt(*replaced, 0, 0.3f, 0.3f), 0.0f);
  EXPECT_NEAR(surfaceAt(*replaced, 0, 0.3f, 0.3f).reflectance.r, 0.1f, 1e-6f);  // the texture's colour is gone

  // Brightness multiplies whichever colour counts: the override's, or the file's with its texture.
  options.material->brightness = 2.0;
  EXPECT_NEAR(surfaceAt(read(builder, options).value(), 0, 0.3f, 0.3f).reflectance.r, 0.2f, 1e-6f);
  options.material->baseColour.reset();
  options.material->brightness = 0.5;
  options.material->optics.translucency = 0.0;
  const SurfaceSample dimmed = surfaceAt(read(builder, options).value(), 0, 0.3f, 0.3f);
  options.material->brightness = 1.0;
  const SurfaceSample full = surfaceAt(read(builder, options).value(), 0, 0.3f, 0.3f);
  EXPECT_GT(full.reflectance.g, 0.1f);
  EXPECT_NEAR(dimmed.reflectance.g, 0.5f * full.reflectance.g, 1e-6f);
}

TEST_F(GltfRead, aMissingImageIsAWarningAndAMissingBufferAnError) {
  GltfBuilder builder;
  builder.triangle();
  addTexture(builder, "absent.png");
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 0.125, 1.0};
  const Result<Model> model = read(builder);
  ASSERT_TRUE(model.ok()) << model.error().text();
  ASSERT_FALSE(model->warnings.empty());
  EXPECT_NE(model->warnings[0].find("absent.png"), std::string::npos);
  EXPECT_EQ(model->materials[0].texture, -1);
  EXPECT_FLOAT_EQ(surfaceAt(*model, 0, 0.2f, 0.2f).reflectance.g, 0.25f);

  nlohmann::json json = nlohmann::json::parse(builder.text());
  json["buffers"][0]["uri"] = "absent.bin";
  const Result<Model> without = readGltf(write("model.gltf", json.dump()));
  ASSERT_FALSE(without.ok());
  EXPECT_NE(without.error().text().find("absent.bin"), std::string::npos);
}

TEST_F(GltfRead, urisDecodeAndNeverLeaveTheMachineOrTheRoot) {
  GltfBuilder builder;
  builder.triangle();
  png("a leaf #1.png", glm::vec4(1.0f));
  addTexture(builder, "a%20leaf%20%231.png");
  const Result<Model> encoded = read(builder);
  ASSERT_TRUE(encoded.ok());
  EXPECT_EQ(encoded->materials[0].texture, 0) << encoded->warnings[0];
  std::filesystem::create_directories(m_folder / "textures" / "x");
  for (const char* uri : {"a leaf #1.png", "textures/../a leaf #1.png", "textures\\x\\..\\..\\a leaf #1.png"}) {
    builder.json["images"][0]["uri"] = uri;
    const Result<Model> model = read(builder);
    ASSERT_TRUE(model.ok());
    EXPECT_EQ(model->materials[0].texture, 0) << uri;
  }
  for (const char* uri :
       {"http://127.0.0.1/leaf.png", "file:///etc/passwd", "/etc/passwd", "%2Fetc/passwd", "C:\\leaf.png"}) {
    builder.json["images"][0]["uri"] = uri;
    const Result<Model> model = read(builder);
    ASSERT_TRUE(model.ok());
    EXPECT_EQ(model->materials[0].texture, -1) << uri;
    nlohmann::json json = nlohmann::json::parse(builder.text());
    json["buffers"][0]["uri"] = uri;
    EXPECT_FALSE(readGltf(write("model.gltf", json.dump())).ok()) << uri;
  }
}

TEST_F(GltfRead, closureNamesEveryExistingFile) {
  GltfBuilder builder;
  builder.triangle();
  addTexture(builder, png("one.png", glm::vec4(1.0f)));
  builder.json["images"].push_back({{"uri", "absent.png"}});
  nlohmann::json json = nlohmann::json::parse(builder.text());
  write("data.bin", std::string(reinterpret_cast<const char*>(builder.buffer.data()), builder.buffer.size()));
  json["buffers"][0]["uri"] = "data.bin";
  const auto path = write("model.gltf", json.dump());
  ASSERT_TRUE(readGltf(path).ok());
  const Result<std::vector<std::filesystem::path>> files = gltfClosure(path);
  ASSERT_TRUE(files.ok()) << files.error().text();
  EXPECT_EQ(*files, (std::vector<std::filesystem::path>{m_folder / "data.bin", path, m_folder / "one.png"}));
  EXPECT_FALSE(gltfClosure(m_folder / "absent.gltf").ok());
}

TEST_F(GltfRead, unsupportedRequiredExtensionsAreNamedWithARemedy) {
  for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_texture_webp",
                           "KHR_texture_basisu", "VENDOR_something"}) {
    GltfBuilder builder;
    builder.triangle();
    builder.json["extensionsUsed"] = {name};
    ASSERT_TRUE(read(builder).ok()) << name;  // only used: fallbacks are there
    builder.json["extensionsRequired"] = {name};
    expectError(builder, name);
    EXPECT_FALSE(read(builder).error().remedy.empty());
  }
  GltfBuilder harmless;
  harmless.triangle();
  harmless.json["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform"};
  EXPECT_TRUE(read(harmless).ok());
}

TEST_F(GltfRead, nonFinitePositionsNameTheVertex) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    GltfBuilder builder;
    builder.json["nodes"][0]["name"] = "Tuft";
    builder.primitive()["attributes"]["POSITION"] =
        builder.accessor(std::vector<float>{0, 0, 0, 1, bad, 0, 0, 2, 0}, "VEC3", 5126, 3);
    expectError(builder, "vertex 1");
    expectError(builder, "nodes[0] \"Tuft\", meshes[0]");
  }
  GltfBuilder huge;
  huge.triangle();
  huge.json["nodes"][0]["scale"] = {1e39, 1e39, 1e39};
  expectError(huge, "too large");
}

TEST_F(GltfRead, boundsAreCheckedEverywhere) {
  const auto base = [] {
    GltfBuilder builder;
    builder.triangle();
    builder.primitive()["indices"] = builder.accessor(std::vector<std::uint8_t>{0, 1, 2}, "SCALAR", 5121, 3);
    return builder;
  };
  ASSERT_TRUE(read(base()).ok());
  GltfBuilder b = base();
  b.json["accessors"][0]["count"] = 4;
  expectError(b, "do not fit");
  b = base();
  b.json["accessors"][0]["count"] = 9007199254740992ull;
  expectError(b, "do not fit");
  b = base();
  b.json["accessors"][0]["byteOffset"] = 9007199254740992ull;
  expectError(b, "do not fit");
  b = base();
  b.json["accessors"][0]["count"] = 0;
  expectError(b, "no elements");
  b = base();
  b.json["bufferViews"][0]["byteLength"] = 9007199254740992ull;
  expectError(b, "buffer view");
  b = base();
  b.json["bufferViews"][0]["byteStride"] = 4;
  expectError(b, "stride");
  b = base();
  b.json["accessors"][1]["bufferView"] = b.view(std::vector<std::uint8_t>{0, 1, 3});
  expectError(b, "index 3");
  b = base();
  b.primitive()["indices"] = -1;
  expectError(b, "indices");
  b = base();
  b.primitive()["indices"] = 7;
  expectError(b, "out of range");
  b = base();
  b.primitive()["mode"] = 9;
  expectError(b, "mode");
  b = base();
  b.json["nodes"][0]["mesh"] = "zero";
  expectError(b, "nodes[0].mesh");
  b = base();
  b.json["nodes"][0]["rotation"] = {0, 0, 0, 0};
  expectError(b, "quaternion");
  b = base();
  b.json["accessors"][0].erase("bufferView");
  b.json["accessors"][0]["count"] = 4000000000u;
  expectError(b, "without data");
}

TEST_F(GltfRead, cyclesSharedNodesAndDeepNestingEnd) {
  GltfBuilder cycle;
  cycle.triangle();
  cycle.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
  expectError(cycle, "cycle");
  GltfBuilder deep;
  deep.triangle();
  deep.json["nodes"] = nlohmann::json::array();
  for (int i = 0; i < 50000; ++i) deep.json["nodes"].push_back({{"children", {i + 1}}});
  deep.json["nodes"].push_back({{"mesh", 0}});
  EXPECT_TRUE(read(deep).ok());  // a long chain is legal
  std::string nested(200000, '[');
  const Result<Model> brackets = readGltf(write("deep.gltf", "{\"extras\":" + nested));
  ASSERT_FALSE(brackets.ok());
  nested += std::string(200000, ']');
  const Result<Model> closed = readGltf(write("deep.gltf", "{\"extras\":" + nested + "}"));
  ASSERT_FALSE(closed.ok());
  EXPECT_NE(closed.error().text().find("nested too deeply"), std::string::npos) << closed.error().text();
}

TEST_F(GltfRead, manyInstancesOfAMeshAreLimited) {
  GltfBuilder builder;
  builder.primitive()["attributes"]["POSITION"] = 0;
  builder.json["accessors"].push_back({{"componentType", 5126}, {"count", 16000000}, {"type", "VEC3"}});
  builder.json["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", builder.view(std::vector<std::uint32_t>{1, 2})}, {"componentType", 5125}}},
      {"values", {{"bufferView", builder.view(std::vector<float>{1, 0, 0, 0, 1, 0})}}}};
  const Result<Model> model = read(builder);  // one triangle with an area among millions without
  ASSERT_TRUE(model.ok()) << model.error().text();
  EXPECT_EQ(model->triangles.size(), 1u);
}

TEST_F(GltfRead, fileTroublesAreClear) {
  EXPECT_NE(readGltf(m_folder / "absent.glb").error().text().find("absent.glb"), std::string::npos);
  EXPECT_FALSE(readGltf(m_folder).ok());
  EXPECT_FALSE(readGltf(write("empty.glb", "")).ok());
  EXPECT_FALSE(readGltf(write("text.gltf", "not JSON")).ok());
  EXPECT_FALSE(readGltf(write("array.gltf", "[]")).ok());
  EXPECT_FALSE(readGltf(write("number.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1e999,1,1]}]})")).ok());
}

}  // namespace
}  // namespace sward::mesh
