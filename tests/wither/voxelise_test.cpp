#include "wither/voxelise.h"

#include "mesh/gltf_read.h"
#include "mesh/procedural.h"
#include "trace/test_patches.h"
#include "wither/cones.h"
#include "wither/texel_test_help.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::wither {
namespace {

using testing::cube;
using testing::leafAreaM2;
using testing::sameBytes;
using trace::testing::addQuad;
using trace::testing::patchOf;
using trace::testing::quad;

Texel voxelised(const scene::Patch& patch, const TexelGrid& grid, int threads = 0) {
  JobContext job;
  job.threads = threads;
  auto result = voxelise(patch, grid, nullptr, job);
  EXPECT_TRUE(result.ok()) << (result.ok() ? "" : result.error().text());
  return result.ok() ? std::move(result).value().texel : Texel();
}

/// Densities are floats, each off by half an ulp at most; of positive summands the sum is off by no more.
constexpr double kRounding = 1e-6;

void expectArea(const Texel& texel, double areaM2) {
  EXPECT_NEAR(texel.areaM2() / areaM2, 1.0, kRounding);
}

double trace(const Voxel& voxel) {
  return static_cast<double>(voxel.spread[0]) + static_cast<double>(voxel.spread[3]) +
         static_cast<double>(voxel.spread[5]);
}

glm::dvec3 direction(int i, int count) {
  const double z = 1.0 - (2.0 * i + 1.0) / count, angle = 2.399963 * i, r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST(Voxelise, PlaneAtEveryOrientationKeepsAreaNormalAndSpread) {
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 n = direction(i, 60);
    const glm::dvec3 a = glm::normalize(glm::cross(n, std::abs(n.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::vec3 s(0.5 * a), t(0.4 * glm::cross(n, a));
    const auto patch = patchOf(quad(glm::vec3(0.51f, 0.47f, 0.5f) - 0.5f * (s + t), s, t), 1.0, 1.0);
    const Texel texel = voxelised(*patch, cube(32));
    expectArea(texel, leafAreaM2(*patch));
    const glm::dvec3 up = n.z < 0.0 ? -n : n;
    for (const Voxel& voxel : texel.voxels()) {
      // Vertices are floats: the plane through them turns by a few 1e-7.
      ASSERT_NEAR(glm::length(glm::dvec3(voxel.normal) - up), 0.0, 1e-5) << i;
      ASSERT_NEAR(trace(voxel) / static_cast<double>(voxel.density), 1.0, 1e-5);
      ASSERT_NEAR(static_cast<double>(voxel.spread[2]), static_cast<double>(voxel.density) * n.x * n.z,
                  1e-5 * static_cast<double>(voxel.density));
      ASSERT_NEAR(voxel.diffuse.y, 0.4f, 1e-6f);
      ASSERT_GT(voxel.transmitted.y, 0.0f);
    }
  }
}

TEST(Voxelise, EveryVoxelThatAPointOfAPlaneLiesInIsThere) {
  const glm::vec3 corner(0.13f, 0.21f, 0.17f), s(0.51f, 0.13f, 0.31f), t(-0.1f, 0.6f, 0.22f);
  const Texel texel = voxelised(*patchOf(quad(corner, s, t), 1.0, 1.0), cube(64));
  std::size_t inside = 0;
  for (int i = 1; i < 400; ++i) {
    for (int j = 1; j < 400; ++j) {
      const glm::dvec3 p = (glm::dvec3(corner) + i / 400.0 * glm::dvec3(s) + j / 400.0 * glm::dvec3(t)) * 64.0;
      if (glm::any(glm::lessThan(glm::abs(p - glm::round(p)), glm::dvec3(1e-4)))) continue;  // rounding decides there
      ASSERT_NE(texel.at(glm::ivec3(glm::floor(p))), nullptr) << p.x << ' ' << p.y << ' ' << p.z;
      ++inside;
    }
  }
  EXPECT_GT(inside, 100000u);
}

mesh::Model box(const glm::vec3& low, const glm::vec3& size) {
  const glm::vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  mesh::Model model;
  addQuad(model, low, y, x);
  addQuad(model, low + z, x, y);
  addQuad(model, low, x, z);
  addQuad(model, low + y, z, x);
  addQuad(model, low, z, y);
  addQuad(model, low + x, y, z);
  return model;
}

TEST(Voxelise, ClosedBoxCountsHalfAndPointsOutward) {
  const auto patch = patchOf(box({0.26f, 0.27f, 0.28f}, {0.4f, 0.3f, 0.2f}), 1.0, 1.0);
  const Texel texel = voxelised(*patch, cube(32));
  expectArea(texel, 0.4 * 0.3 + 0.4 * 0.2 + 0.3 * 0.2);
  const Voxel* top = texel.at({14, 13, 15});  // z = 0.48
  const Voxel* below = texel.at({14, 13, 8});
  ASSERT_NE(top, nullptr);
  ASSERT_NE(below, nullptr);
  EXPECT_NEAR(top->normal.z, 1.0f, 1e-6f);
  EXPECT_NEAR(below->normal.z, -1.0f, 1e-6f);
}

TEST(Voxelise, NormalsOfAThinSolidCancelButItsSpreadStays) {
  const auto patch = patchOf(box({0.3f, 0.3f, 0.505f}, {0.4f, 0.3f, 0.01f}), 1.0, 1.0);
  const Texel texel = voxelised(*patch, cube(32));
  const Voxel* middle = texel.at({16, 14, 16});
  ASSERT_NE(middle, nullptr);
  EXPECT_EQ(middle->normal, glm::vec3(0.0f));
  EXPECT_NEAR(middle->spread[5], middle->density, 1e-4f);
  EXPECT_NEAR(middle->density, 32.0f, 1e-3f);
}

TEST(Voxelise, AreaOfGrownPlants) {
  mesh::GrassShape grass;
  std::vector<std::shared_ptr<const mesh::Model>> models{
      std::make_shared<mesh::Model>(mesh::growGrass(grass, 3)),
      std::make_shared<mesh::Model>(mesh::growFlower(mesh::FlowerShape{}, 4)),
      std::make_shared<mesh::Model>(mesh::growClover(mesh::CloverShape{}, 5))};
  for (std::uint32_t i = 0; i < 3; ++i) {
    scene::PlantScatter plants;
    plants.count = 12.0;
    plants.tiltDeg = 0.0;
    plants.models = {i};
    const scene::Patch patch = scene::scatter(1.0, models, {plants}, 11);
    for (const int columns : {16, 128}) {
      const Texel texel = voxelised(patch, {columns, columns, 1.0, patch.heightM});
      // What stands a little under the ground is cut off: under 1 % of these plants.
      EXPECT_NEAR(texel.areaM2() / leafAreaM2(patch), 1.0, 0.01) << "plant " << i << ", " << columns;
    }
  }
}

TEST(Voxelise, AreaOfPlantsOfFiles) {
  const std::filesystem::path folder = std::filesystem::path(SWARD_SHARED_DIR) / "assets/meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no assets";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const auto type = entry.path().extension();
    if ((type != ".glb" && type != ".gltf") || files >= 6) continue;
    mesh::GltfReadOptions options;
    options.heightM = 0.4;
    auto model = mesh::readGltf(entry.path(), options);
    if (!model.ok() || model.value().triangles.size() > 200000) continue;
    const mesh::Bounds bounds = mesh::bounds(*model);
    const double side = std::ceil(10.0 * static_cast<double>(glm::length(bounds.high - bounds.low))) / 10.0;
    const auto patch = patchOf(*model, side, 0.41, {glm::vec3(0.3f * static_cast<float>(side))});
    patch->instances[0].worldFromModel[3].z = 0.0f;
    const Texel texel = voxelised(*patch, {128, 128, side, 0.41});
    EXPECT_NEAR(texel.areaM2() / leafAreaM2(*patch), 1.0, 0.01) << entry.path().filename();
    ++files;
  }
  if (files == 0) GTEST_SKIP() << "no plants of files";
}

TEST(Voxelise, FlatBladesOnTheGroundAndAtTheTopBelongToTheTexel) {
  mesh::Model model = quad({0.2f, 0.2f, 0.0f}, {0.3f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.0f});
  addQuad(model, {0.2f, 0.2f, 0.3f}, {0.3f, 0.0f, 0.0f}, {0.0f, 0.3f, 0.0f});  // 0.3 as a float is above 0.3
  const Texel texel = voxelised(*patchOf(model, 1.0, 0.3), {32, 16, 1.0, 0.3});
  expectArea(texel, 0.18);
  for (const glm::u16vec3& at : texel.places()) EXPECT_TRUE(at.z == 0 || at.z == 15);
}

TEST(Voxelise, WhatLiesUnderTheGroundOrAboveIsLeftOut) {
  const auto patch = patchOf(quad({0.2f, 0.5f, -0.25f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0f, 2.0f}), 1.0, 2.0);
  // A ten-thousandth of a voxel beyond either end counts as rounding, and so as inside.
  EXPECT_NEAR(voxelised(*patch, cube(16)).areaM2() / 0.5, 1.0, 2e-4 / 16.0 + kRounding);
}

TEST(Voxelise, ABladeThatLeavesTheBlockComesBackAtTheOtherSide) {
  const auto inside = patchOf(quad({0.1f, 0.2f, 0.3f}, {0.25f, 0.0f, 0.0f}, {0.0f, 0.125f, 0.25f}), 1.0, 1.0);
  for (const glm::vec3& shift : {glm::vec3(0.75f, 0.0f, 0.0f), glm::vec3(-0.25f, -0.5f, 0.0f)}) {
    const auto moved = patchOf(*inside->models[0], 1.0, 1.0, {shift});
    const Texel a = voxelised(*inside, cube(32)), b = voxelised(*moved, cube(32));
    ASSERT_EQ(a.size(), b.size());
    expectArea(b, a.areaM2());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const glm::ivec3 at = (glm::ivec3(a.places()[i]) + glm::ivec3(shift * 32.0f) + 32) % glm::ivec3(32, 32, 32);
      const Voxel* other = b.at({at.x, at.y, a.places()[i].z});
      ASSERT_NE(other, nullptr);
      ASSERT_NEAR(other->density, a.voxels()[i].density, 1e-4f);
    }
  }
}

TEST(Voxelise, DegenerateTrianglesAndEmptyPatchesHoldNothing) {
  EXPECT_TRUE(voxelised(*patchOf({}, 1.0, 1.0), cube(16)).empty());
  EXPECT_TRUE(voxelised(*patchOf(quad({0.5f, 0.5f, 0.5f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f}), 1.0, 1.0), cube(16))
                  .empty());
  scene::Patch none;
  none.heightM = 1.0;
  EXPECT_TRUE(voxelised(none, cube(16)).empty());
}

TEST(Voxelise, AlphaCountsByItsMean) {
  mesh::Model leaf = quad({0.2f, 0.3f, 0.5f}, {0.4f, 0.0f, 0.1f}, {0.0f, 0.4f, 0.0f});
  leaf.materials[0].alphaMode = mesh::AlphaMode::Blend;
  leaf.materials[0].baseColour.a = 0.25f;
  const auto patch = patchOf(leaf, 1.0, 1.0);
  const Texel texel = voxelised(*patch, cube(32));
  expectArea(texel, 0.25 * 0.4 * std::hypot(0.4, 0.1));
  for (const Voxel& voxel : texel.voxels()) EXPECT_NEAR(voxel.diffuse.x, 0.2f, 1e-6f);
}

TEST(Voxelise, ErrorsNameWhatIsWrong) {
  mesh::Model broken = quad({0.2f, 0.3f, 0.5f}, {0.4f, 0.0f, 0.1f}, {0.0f, 0.4f, 0.0f});
  broken.positions[1].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(voxelise(*patchOf(broken, 1.0, 1.0), cube(16), nullptr, {}).ok());
  broken.positions[1].y = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(voxelise(*patchOf(broken, 1.0, 1.0), cube(16), nullptr, {}).ok());
  const auto patch = patchOf(quad({0.2f, 0.3f, 0.5f}, {0.4f, 0.0f, 0.1f}, {0.0f, 0.4f, 0.0f}), 1.0, 1.0);
  EXPECT_FALSE(voxelise(*patch, cube(16, 2.0), nullptr, {}).ok());
  EXPECT_FALSE(voxelise(*patch, cube(17), nullptr, {}).ok());
  std::stop_source stop;
  stop.request_stop();
  JobContext job;
  job.stop = stop.get_token();
  const auto cancelled = voxelise(*patch, cube(16), nullptr, job);
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(Voxelise, ThreadsGiveTheSameBytes) {
  const scene::Patch patch = growCones({}, 5);
  const Texel one = voxelised(patch, {128, 128, 1.0, 0.3}, 1);
  EXPECT_GT(one.size(), 1000u);
  for (const int threads : {2, 4}) EXPECT_TRUE(sameBytes(one, voxelised(patch, {128, 128, 1.0, 0.3}, threads)));
}

/// Two open tubes and a leaf with strands made by hand: s rises with z along straight veins.
PatchStrands handMade(const scene::Patch& patch) {
  PatchStrands strands;
  for (std::size_t m = 0; m < patch.models.size(); ++m) {
    Strand strand;
    strand.vein = {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 0.25), glm::dvec3(0.0, 0.0, 0.5)};
    strand.lengthM = 0.5;
    Strands model{{strand}, {}};
    for (const glm::vec3& p : patch.models[m]->positions) model.attachments.push_back({0, p.z / 0.5f});
    strands.models.push_back(model);
  }
  for (const scene::Instance& instance : patch.instances) {
    strands.firstStrand.push_back(static_cast<std::uint32_t>(strands.strands.size()));
    Strand strand = strands.models[instance.model].strands[0];
    for (glm::dvec3& p : strand.vein) p += glm::dvec3(instance.worldFromModel[3]);
    strands.strands.push_back(strand);
  }
  return strands;
}

TEST(Voxelise, NormalsOfOpenTubesPointAwayFromTheVeinAndTangentsFollowS) {
  mesh::Model tube;
  for (int i = 0; i < 12; ++i) {
    const auto at = [&](int k) {
      const double angle = 2.0 * std::numbers::pi * k / 12.0;
      return glm::vec3(0.15 * std::cos(angle), 0.15 * std::sin(angle), 0.0);
    };
    addQuad(tube, at(i), {0.0f, 0.0f, 0.5f}, at(i + 1) - at(i));  // wound inward
  }
  const auto patch = patchOf(tube, 1.0, 0.5, {{0.3f, 0.3f, 0.0f}, {0.7f, 0.7f, 0.0f}});
  const PatchStrands strands = handMade(*patch);
  auto result = voxelise(*patch, {64, 32, 1.0, 0.5}, &strands, {});
  ASSERT_TRUE(result.ok());
  const Texel& texel = result->texel;
  ASSERT_EQ(result->attachments.size(), texel.size());
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const glm::dvec3 at = (glm::dvec3(texel.places()[i]) + 0.5) * texel.grid().voxelM();
    const Attachment& hook = result->attachments[i];
    ASSERT_EQ(hook.strand, at.x < 0.5 ? 0 : 1);
    EXPECT_NEAR(static_cast<double>(hook.s), at.z / 0.5, 0.02);  // half a voxel is 1/64
    EXPECT_NEAR(texel.voxels()[i].tangent.z, 1.0f, 1e-5f);
    const glm::dvec3 axis = strands.strands[static_cast<std::size_t>(hook.strand)].vein[0];
    EXPECT_GT(glm::dot(glm::dvec3(texel.voxels()[i].normal), glm::normalize((at - axis) * glm::dvec3(1, 1, 0))), 0.9);
  }
}

TEST(Voxelise, NormalsOfALeafAreOnItsOuterSideAllAlong) {
  // Upright: the outer side of a leaf that bends to +x faces -x, however its triangles wind.
  for (const bool turned : {false, true}) {
    const glm::vec3 up(0.0f, 0.0f, 0.5f), across(0.0f, turned ? -0.1f : 0.1f, 0.0f);
    const auto patch = patchOf(quad(-0.5f * across, up, across), 1.0, 0.5, {{0.5f, 0.5f, 0.0f}});
    const PatchStrands strands = handMade(*patch);
    auto result = voxelise(*patch, {64, 32, 1.0, 0.5}, &strands, {});
    ASSERT_TRUE(result.ok());
    for (const Voxel& voxel : result->texel.voxels()) EXPECT_NEAR(voxel.normal.x, -1.0f, 1e-5f);
  }
}

TEST(Cones, GiveThePapersNumberOfPoints) {
  const scene::Patch patch = growCones({}, 1);
  const TexelGrid grid{256, 256, 1.0, 0.3};
  const Texel texel = voxelised(patch, grid);
  // The cones' floats, 6e-8 at 1 m, against their widths of 1.5e-4: 4e-4 a vertex, at random.
  EXPECT_NEAR(texel.areaM2() / leafAreaM2(patch), 1.0, 4e-4);
  // Six for a voxel whose leaf area is that of its face, of the square of its mean edge.
  const double points = 6.0 * texel.areaM2() / std::pow(grid.voxelVolumeM3(), 2.0 / 3.0);
  EXPECT_GT(points, 3000.0);
  EXPECT_LT(points, 8000.0);
  // A hexagonal cone: half of six triangles of height h and base r, and of the foot.
  ConeOptions one;
  one.count = 1;
  one.variation = one.leanDeg = 0.0;
  one.radiusM = 0.01;
  const double slant = std::hypot(0.3, 0.01 * std::cos(std::numbers::pi / 6.0));
  const double foot = 6.0 * 0.5 * 0.01 * 0.01 * std::sin(std::numbers::pi / 3.0);
  EXPECT_NEAR(leafAreaM2(growCones(one, 2)), 0.5 * (6.0 * 0.5 * 0.01 * slant + foot), 1e-8);
}

}  // namespace
}  // namespace sward::wither
